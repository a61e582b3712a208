"""Mistakes in the forces of links, with their words and hints; exercises pick theirs from here."""

from __future__ import annotations

from experiments.exercises.exercise import mistake, mistakes

#: Of gravity, wherever it is asked for.
EXAMPLE_GRAVITY = (
    "numbers_of_the_example",
    "Your gravity is always 9.81 m/s^2.",
    "From where do you have it? The Moon has another.",
)

#: In one dimension as in two.
OF_A_SPRING = [
    mistake(
        "spring_sign",
        "Your springs push where they should pull.",
        "A spring that is too long: which way must its force point?",
        elastic=-1.0,
    ),
    mistake(
        "spring_missing",
        "There is no spring in your forces, or it comes out as 0.",
        "Print what the spring pulls with. Is it ever anything but 0?",
        elastic=0.0,
    ),
    mistake(
        "gravity_sign",
        "Your gravity points upwards.",
        "Let go of a mass without a spring: which way does its velocity change?",
        gravity=-1.0,
    ),
    mistake(
        "gravity_missing",
        "There is no weight in your forces.",
        "What pulls on a mass when all springs are cut?",
        weight="none",
    ),
    mistake(
        "weight_without_mass",
        "Your weight is g, as if every mass were 1 kg.",
        "What is the unit of g, and what that of a force?",
        weight="g",
    ),
    mistake(
        "damping_sign",
        "Your damping drives the motion in place of slowing it.",
        "Which way must the force of damping point, seen from the velocity?",
        drag=-1.0,
    ),
    mistake(
        "damping_missing",
        "There is no damping in your forces.",
        "Which of the given numbers have you not used?",
        drag=0.0,
    ),
    mistake(
        "rest_length_added",
        "You add the rest length where it is to be taken off.",
        "How large is the force of a spring at its rest length?",
        rest=-1.0,
    ),
    mistake(
        "rest_length_missing",
        "Your springs have no rest length: they pull until they are 0 m long.",
        "How large is the force of a spring at its rest length?",
        rest=0.0,
    ),
    mistake(
        "not_normalised",
        "Your direction is not of length 1: long springs pull too much.",
        "How long is the vector that gives the direction?",
        direction="sloppy",
    ),
    mistake(
        "spring_cannot_push",
        "Your springs only pull: when they are too short they do nothing, like a rope.",
        "What does a spring do that is shorter than at rest?",
        slack=True,
    ),
    mistake(
        "damping_with_the_mass",
        "The mass is in your damping: it is multiplied by it, or taken off the acceleration without being divided.",
        "What is the unit of the damping times a velocity? Is that a force, or an acceleration?",
        friction="m c v",
    ),
    mistake(
        "damping_one_way",
        "Your damping always pulls the same way: the sign of the velocity is lost in it.",
        "Which way does damping pull a mass that falls, and which way one that rises?",
        friction="c |v|",
    ),
    mistake(
        "damping_of_the_square",
        "Your damping grows with the square of the speed.",
        "What is the unit of the damping that you are given?",
        friction="c v^2",
    ),
]

#: Only in two.
OF_A_STRING = [
    mistake(
        "length_without_root",
        "Your lengths of springs are squares of lengths.",
        "What is the unit of dx*dx + dy*dy?",
        length="square",
    ),
    mistake(
        "length_as_sum",
        "Your lengths are |dx| + |dy|.",
        "What does Pythagoras say of a spring that hangs aslant?",
        length="sum",
    ),
    mistake(
        "x_and_y_swapped",
        "The x and the y of your directions are swapped.",
        "Let a spring hang straight down: which part of its force is not zero?",
        direction="swapped",
    ),
    *mistakes(
        "degrees",
        "You take cos and sin of an angle in degrees.",
        "In which unit do cos and sin expect an angle?",
        {"direction": "degrees"},
        {"direction": "degrees", "below": "own side"},
    ),
    mistake(
        "anchor_missing",
        "Nothing holds your first mass: its spring to the anchor gives no force.",
        "What is above mass 0?",
        anchor="missing",
    ),
    mistake(
        "anchor_at_origin", "You take the anchor for the origin.", "Where is the anchor? It is given.", anchor="origin"
    ),
    *mistakes(
        "anchor_off_by_one",
        "Your second mass hangs on the anchor too, in place of on the first.",
        "At which number does your loop turn from the anchor to its neighbours?",
        {"anchor": "second"},
        {"anchor": "second, from above"},
    ),
    *mistakes(
        "last_link_wraps",
        "Your last mass gets the force of a spring that does not hold it: below it there is none.",
        "Which neighbours has the last mass? What does np.roll, or index -1, give you?",
        {"last": "wraps"},
        {"last": "ring"},
        {"last": "rolls"},
    ),
    mistake(
        "last_link_skipped",
        "Your last mass gets no force at all.",
        "Up to which number does your loop run?",
        skipped=-1,
    ),
    mistake(
        "first_mass_skipped",
        "Your first mass gets no force at all.",
        "At which number does your loop begin? What is above mass 0?",
        skipped=0,
    ),
    mistake(
        "spring_above_only",
        "Your masses feel the spring above them, not the one below.",
        "How many springs hold a mass in the middle?",
        sides="above",
    ),
    mistake(
        "spring_below_only",
        "Your masses feel the spring below them, not the one above.",
        "How many springs hold a mass in the middle?",
        sides="below",
    ),
    mistake(
        "same_side",
        "The spring below pushes your mass the way it should pull the next one.",
        "Action and reaction: what does one spring do to its two masses?",
        sides="same",
    ),
    mistake(
        "neighbours_spring",
        "For the spring below mass i you take the stiffness and rest length of the spring above it.",
        "Which number has the spring between mass i and mass i + 1?",
        below="above",
    ),
    mistake(
        "neighbours_stiffness",
        "For the spring below mass i you take the stiffness of the spring above it.",
        "Which number has the spring between mass i and mass i + 1?",
        below="stiffness of above",
    ),
    mistake(
        "neighbours_rest_length",
        "For the spring below mass i you take the rest length of the spring above it.",
        "Which number has the spring between mass i and mass i + 1?",
        below="rest length of above",
    ),
    mistake(
        "divided_by_the_rest_length",
        "You divide your direction by the rest length: it is of length 1 only while the spring is at rest.",
        "How long is the vector that you divide? And by what?",
        direction="rest length",
    ),
    mistake(
        "axis_by_axis",
        "You treat x and y as two springs: each part of the vector is compared with the rest length by itself.",
        "How long is a spring that hangs aslant? Which one number is compared with the rest length?",
        direction="each axis",
    ),
    mistake(
        "weight_on_both_axes",
        "Your weight also pulls sideways.",
        "Print the force on a mass without springs. Which of its two parts is the weight?",
        weight="both axes",
    ),
    mistake(
        *EXAMPLE_GRAVITY,
        weight="m 9.81",
    ),
    mistake("weight_along_x", "Your weight pulls along x.", "Which column of an array is y?", weight="along x"),
]

#: Where forces are asked for, and not a step.
OF_FORCES = [
    mistake(
        "nothing_computed",
        "All your forces are zero: nothing is added to what you return.",
        "What do you compute in your loop, and into which array do you write it?",
        elastic=0.0,
        weight="none",
        drag=0.0,
    ),
    mistake(
        "accelerations_returned",
        "You give back accelerations: your forces are divided by the masses.",
        "In which unit is your answer, and in which is a force?",
        divided=True,
    ),
]
