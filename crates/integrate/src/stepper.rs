//! What carries a state on, one step at a time.

use crate::failure::Failure;

/// What an integration took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Steps that were accepted.
    pub steps: usize,
    /// Steps that were tried again, shorter.
    pub rejected: usize,
    /// The errors of the accepted steps, in tolerances, one added to the other; one each where nobody knows them.
    pub errors: f64,
    /// Evaluations of the rates.
    pub evaluations: usize,
    /// Evaluations of the Jacobian.
    pub jacobians: usize,
    /// Where a step of an explicit method first began although rounding errors decide on its branch of the constraints.
    pub uncertain: Option<f64>,
    /// Whether stability, not accuracy, bounds the steps of an explicit method.
    pub stiff: bool,
}

/// A method of integration in the midst of its work.
pub trait Stepper {
    /// Whether a step can begin at the state: its rates are those of a neighbouring state.
    fn starts_well(&mut self) -> bool {
        true
    }

    /// Whether the dense output of the last step is as accurate as its end.
    fn reads_well(&mut self) -> bool {
        true
    }

    /// Whether steps could be much longer if they were allowed to.
    fn is_held_back(&self) -> bool {
        false
    }

    /// Take a step that is accepted, and not beyond `end`.
    fn step(&mut self, end: f64) -> Result<(), Failure>;

    /// The instant of the state.
    fn t(&self) -> f64;

    /// The state.
    fn state(&self) -> &[f64];

    /// Write the state at an instant of the last step, from the dense output; before the state is replaced.
    fn interpolate(&mut self, t: f64, out: &mut [f64]) -> Result<(), Failure>;

    /// Go on from another state at the same instant.
    fn replace(&mut self, state: &[f64]);

    /// Go back to the begin of the last step; the next try is this part of the last one from there, also where that is more
    /// than the longest step. Whether there is one.
    fn retract(&mut self, part: f64) -> bool;

    /// What it took so far.
    fn statistics(&self) -> Statistics;
}
