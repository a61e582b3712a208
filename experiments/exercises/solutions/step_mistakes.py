"""Mistakes in a step, and other steps than the one asked for, with their words and hints; exercises pick theirs."""

from __future__ import annotations

from experiments.exercises.exercise import Mistake, mistake


def _another(name: str, words: str, **parameters: object) -> Mistake:
    return Mistake(name, words, "It is a scheme in its own right; read again which one is asked for.", parameters, True)


#: Between a force and a step.
OF_INERTIA = [
    mistake(
        "mass_forgotten",
        "You take the force for the acceleration: the mass is forgotten.",
        "What does Newton say of F, m and a?",
        inertia="forgotten",
    ),
    mistake(
        "mass_multiplied",
        "You multiply by the mass where you should divide.",
        "What does a heavier mass do, at the same force?",
        inertia="multiplied",
    ),
]

#: In any step.
OF_A_STEP = [
    mistake(
        "dt_twice", "Your step has dt in it twice.", "What is the unit of velocity times dt times dt?", clock="twice"
    ),
    mistake("dt_missing", "Your step has no dt in it.", "What must happen to the step if dt is halved?", clock="none"),
    mistake("half_a_step", "Your step advances by half of dt only.", "Count the factors 1/2.", clock="half"),
    mistake(
        "positions_stay",
        "Your positions never move.",
        "What do you return for the positions?",
        scheme="still_positions",
    ),
    mistake(
        "velocities_stay",
        "Your velocities never change.",
        "What do you return for the velocities?",
        scheme="still_velocities",
    ),
    mistake(
        "velocity_replaced",
        "Your new velocity is dt a: the one before is lost.",
        "What is the new velocity of a mass on which no force acts?",
        scheme="velocity_replaced",
    ),
    mistake("nothing_moves", "Your step returns the state as it was.", "What do you return?", scheme="nothing"),
]

#: In Euler's.
OF_EULER = [
    mistake(
        "dt_missing_in_velocity",
        "Your velocity takes the whole acceleration: there is no dt with it.",
        "What is the unit of an acceleration times dt?",
        scheme="velocities_without_dt",
    ),
    mistake(
        "dt_missing_in_position",
        "Your position takes the whole velocity: there is no dt with it.",
        "What is the unit of a velocity times dt?",
        scheme="positions_without_dt",
    ),
    mistake(
        "half_a_dt_squared",
        "Your position has dt^2 a / 2 in it, the formula for a constant force: that is more than Euler does.",
        "By which velocity does Euler move the position, and by nothing else?",
        scheme="velocities_by_euler",
    ),
]

#: Right, but to be named.
OTHERS = [
    _another("euler", "This is Euler's step: one slope, taken at the beginning.", scheme="euler"),
    _another(
        "kick_drift",
        "Your positions move with the new velocities: semi-implicit Euler, velocities first (kick_drift).",
        scheme="kick_drift",
    ),
    _another(
        "drift_kick",
        "Your forces are taken at the new positions: semi-implicit Euler, positions first (drift_kick).",
        scheme="drift_kick",
    ),
    _another("heun", "This is Heun's step: the average of two slopes.", scheme="heun"),
    _another("velocity_verlet", "This is velocity Verlet.", scheme="velocity_verlet"),
    _another("midpoint", "This is the midpoint rule: the slope half-way, no average.", scheme="midpoint"),
    _another("ralston", "This is Ralston's step: two slopes, the second at two thirds.", scheme="ralston"),
    _another("rk4", "This is the classic Runge-Kutta step: four slopes.", scheme="rk4"),
]

#: In Heun's step.
OF_HEUN = [
    mistake(
        "half_missing",
        "You add the two slopes and do not halve the sum: every step advances 2 dt, like two steps of Euler.",
        "What is the average of two numbers?",
        scheme="without_half",
    ),
    mistake(
        "half_of_one_slope",
        "Only your second slope is halved.",
        "In which order are + and / done? Look at your brackets.",
        scheme="half_of_one",
    ),
    mistake(
        "wrong_pair",
        "You average the slope here with the one half-way.",
        "How far does Euler's guess go?",
        scheme="wrong_pair",
    ),
    mistake(
        "corrected_velocity_averaged",
        "Your positions move by the average of the old and the corrected velocity.",
        "Which two velocities are in Heun's average? One of them is that of the guess.",
        scheme="crossed_pair",
    ),
    mistake(
        "second_slope_only",
        "You step along the slope at the guess alone: the first one is not in your average.",
        "How many slopes are averaged?",
        scheme="end_slope",
    ),
    mistake(
        "from_the_guess",
        "Your corrector adds to the guess, not to the state that the step began with.",
        "From where does the corrected step begin? Is that state still what it was?",
        scheme="from_guess",
    ),
    mistake(
        "positions_not_corrected",
        "Your corrector corrects the velocities, not the positions.",
        "Which parts of a state does the average slope advance?",
        scheme="positions_by_euler",
    ),
    mistake(
        "velocities_not_corrected",
        "Your corrector corrects the positions, not the velocities.",
        "Which parts of a state does the average slope advance?",
        scheme="velocities_by_euler",
    ),
    mistake(
        "position_with_new_velocity",
        "Your velocities are Heun's, but your positions move with the new ones.",
        "By which velocity does Heun move the positions?",
        scheme="new_velocity",
    ),
    mistake(
        "guess_keeps_velocities",
        "Your guess moves the positions, but keeps the old velocities.",
        "A guess of what? A state is more than positions.",
        scheme="guess_of_positions",
    ),
    mistake(
        "guess_keeps_positions",
        "Your guess moves the velocities, but keeps the old positions.",
        "A guess of what? A state is more than velocities.",
        scheme="guess_of_velocities",
    ),
    mistake(
        "guess_by_kick_drift",
        "Your guess moves its positions with its own new velocities: that is not Euler's.",
        "By which velocity does Euler move the positions?",
        scheme="guess_by_kick_drift",
    ),
    mistake(
        "guess_damped_by_old_velocity",
        "In the forces at your guess the damping still has the old velocities.",
        "A guess has velocities of its own. Which forces hang on them?",
        scheme="old_velocity_in_force",
    ),
]

#: What writes into the state it still reads: the catalogue's in-place family.
IN_PLACE = [
    mistake(
        "euler_in_place",
        "You advance each mass before the next has looked at it, by Euler's step.",
        "When mass 1 asks where mass 0 is: which mass 0 does it see?",
        scheme="euler_in_place",
    ),
    mistake(
        "heun_link_by_link",
        "Link by link: one mass is done before the next begins, whose predictor so sees it advanced already.",
        "When mass 1 asks where mass 0 is: which mass 0 does it see?",
        scheme="heun_link_by_link",
    ),
    mistake(
        "heun_aliased",
        "Your guess is no copy: in both loops, later masses already see earlier ones advanced.",
        "How many states are there in your program while a step is made? Which of your names mean the same array?",
        scheme="heun_aliased",
    ),
]
