"""Derivation: what a stepper computes, recovered from the outside, whether or not the catalogue has it.

- `small_fractions`: the simplest fraction near a number, and whether chance would give one as simple
- `formula`: a rational function of a = h^2 k/m, b = h c/m, d = h Cd/m, and how it is written
- `fit`: the formula that values follow
- `oscillators`: damped oscillators to step, and the step matrices that come out
- `step_matrix`: a stepper's step matrix as formulas
- `swings`: that of rods, by their small swings
- `substeps`: that of a step that is made of several
- `consequences`: what follows from it: stability, order, symplectic, reversible, period, what is implicit
- `recording`: answers to a stepper that asks for slopes, independent of one another
- `updates`: what such a stepper makes of them: the update formulas
- `tableau`: Butcher tableaux, read off update formulas
- `order_conditions`: up to which order a tableau's conditions hold
- `of_schemes`: the same of catalogued schemes
- `implicit`: tableaux of steppers that solve equations
- `force_jumps`: where a stepper that only steps takes forces, and with which weights
- `stages`: its tableau, from these
- `difference_equation`: what positions obey step after step, of methods with a memory
- `multistep`: coefficients of multistep methods, implicit ones too
- `irrational`: numbers with roots
- `seen`: all of what a stepper does with slopes and forces
- `pasts`: whether a step depends on more than the state
- `over_dts`: at which other dt a name holds
- `nonlinear_order`: the order on a spring that turns
- `explanation`: all of it together
"""
