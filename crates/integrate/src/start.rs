//! The start of a motion: the stepper of a method.

use crate::diffsol_methods;
use crate::dynamics::Dynamics;
use crate::failure::Failure;
use crate::method::{Family, Method};
use crate::runge_kutta::RungeKutta;
use crate::stepper::Stepper;
use crate::tolerances::Tolerances;

/// Run `then` with the stepper of a method, at the start of a motion that ends at `end`.
pub fn start<R>(
    method: Method,
    dynamics: &Dynamics,
    (t, end): (f64, f64),
    state: &[f64],
    tolerances: Tolerances,
    then: impl FnOnce(&mut dyn Stepper) -> R,
) -> Result<R, Failure> {
    match method.family() {
        Family::RungeKutta(tableau) => {
            Ok(then(&mut RungeKutta::new(tableau, dynamics, (t, end), state, tolerances)))
        }
        Family::Diffsol(formula) => diffsol_methods::start(formula, dynamics, t, state, tolerances, then),
    }
}
