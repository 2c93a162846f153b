//! The start of a motion: the stepper of a method.

use crate::diffsol_methods;
use crate::dynamics::Dynamics;
use crate::failure::Failure;
use crate::method::{Method, Tolerances};
use crate::runge_kutta::RungeKutta;
use crate::stepper::Stepper;

/// Run `then` with the stepper of a method, at the start of a motion that ends at `end`.
pub fn start<R>(
    method: Method,
    dynamics: &Dynamics,
    (t, end): (f64, f64),
    state: &[f64],
    tolerances: Tolerances,
    then: impl FnOnce(&mut dyn Stepper) -> R,
) -> Result<R, Failure> {
    if let Some(mut stepper) = RungeKutta::new(method, dynamics, (t, end), state, tolerances) {
        return Ok(then(&mut stepper));
    }
    diffsol_methods::start(method, dynamics, t, state, tolerances, then)
}
