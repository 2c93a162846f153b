//! The begin of a motion: each method is a stepper of its own type.

use crate::dop853::Dop853;
use crate::dynamics::Dynamics;
use crate::failure::Failure;
use crate::library;
use crate::method::{Method, Tolerances};
use crate::stepper::Stepper;

/// Do something with a stepper of a method, at the begin of a motion that goes on to `end`.
pub fn start<R>(
    method: Method,
    dynamics: &Dynamics,
    (t, end): (f64, f64),
    state: &[f64],
    tolerances: Tolerances,
    then: impl FnOnce(&mut dyn Stepper) -> R,
) -> Result<R, Failure> {
    if method == Method::Dop853 {
        return Ok(then(&mut Dop853::new(dynamics, (t, end), state, tolerances)));
    }
    library::start(method, dynamics, t, state, tolerances, then)
}
