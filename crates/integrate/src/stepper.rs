//! The interface of a method of integration, which advances a state step by step.

use crate::failure::Failure;

/// The cost of an integration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Steps that were accepted.
    pub steps: usize,
    /// Steps that were rejected and repeated with a shorter length.
    pub rejected: usize,
    /// The sum of the errors of the accepted steps, in tolerances; an unknown error counts as one.
    pub errors: f64,
    /// Evaluations of the rates.
    pub evaluations: usize,
    /// Evaluations of the Jacobian.
    pub jacobians: usize,
    /// The first start of a step of an explicit method at which rounding errors decide on the branch of the
    /// constraints.
    pub uncertain: Option<f64>,
    /// Whether stability, not accuracy, bounds the steps of an explicit method.
    pub stiff: bool,
}

/// How many steps a motion takes until it looks at them.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// It looks at the first step that reaches this instant.
    pub until: f64,
    /// The most steps.
    pub steps: usize,
}

/// The last of several steps, each of which ends on the constraints.
#[derive(Clone, Copy, Debug)]
pub struct Landing {
    /// Where it starts.
    pub start: f64,
    /// The largest speed at the ends of all steps so far.
    pub largest_speed: f64,
}

/// What is known of events in the last step.
#[derive(Clone, Copy, Debug)]
pub enum Sight {
    /// Nobody has looked.
    Unknown,
    /// No function passes zero in it, nor in those that were taken with it.
    Nothing,
    /// Some function passes zero in it, and in none of those that were taken with it; it starts here.
    Crossing { t: f64 },
}

/// A method of integration, with the state that it has reached.
pub trait Stepper {
    /// Whether a step can start at the state: its rates agree with those of a neighbouring state.
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

    /// Advance by one accepted step, not beyond `end`.
    fn step(&mut self, end: f64) -> Result<(), Failure>;

    /// Advance by accepted steps, one at least. Nothing happens between them, and only the last one can be read.
    fn advance(&mut self, end: f64, _stretch: Stretch) -> Result<(), Failure> {
        self.step(end)
    }

    /// Take steps that end on the constraints, as long as they are accepted at once and nothing points to a singular
    /// position; `None` if the next step is not of this kind. Write the state at the start of the last one, and the state
    /// on the constraints at its end. `largest_speed` is that of the motion so far.
    fn advance_on_constraints(
        &mut self,
        _end: f64,
        _stretch: Stretch,
        _largest_speed: f64,
        _states: (&mut [f64], &mut [f64]),
    ) -> Option<Landing> {
        None
    }

    /// Whether steps that are taken together end at the first in which an event may happen.
    fn looks_for_events(&self) -> bool {
        false
    }

    /// What is known of events in the last step.
    fn sight(&self) -> Sight {
        Sight::Unknown
    }

    /// Write the values of the functions of the events at the start of the last step and at the ends of its parts, if
    /// some function passes zero in it.
    fn read_event_values(&self, _start: &mut [f64], _ends: &mut [f64]) {}

    /// Write the values of these functions at the end of the last step, if none passes zero in it.
    fn read_event_values_at_end(&self, _values: &mut [f64]) {}

    /// The instant of the state.
    fn t(&self) -> f64;

    /// The state.
    fn state(&self) -> &[f64];

    /// Write the state at an instant of the last step, from the dense output. Call it before [`Self::replace`].
    fn interpolate(&mut self, t: f64, out: &mut [f64]) -> Result<(), Failure>;

    /// Continue from another state at the same instant.
    fn replace(&mut self, state: &[f64]);

    /// Go back to the start of the last step. The next step has this fraction of its length, even if that exceeds the
    /// longest step. Return whether that is possible.
    fn retract(&mut self, part: f64) -> bool;

    /// The cost so far.
    fn statistics(&self) -> Statistics;
}
