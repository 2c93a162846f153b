//! The control of the steps of a motion in a lane: the same choices as those of a motion alone.

use crate::failure::Failure;
use crate::lane::Beginning;
use crate::runge_kutta::{factor_after, factor_after_rejection, is_last, is_too_short, note_stiffness};
use crate::stepper::{Statistics, Stretch};

/// What became of the step before the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Attempt {
    Accepted,
    Rejected,
    NotFinite,
}

/// The control of the steps of a motion, other than vectors.
#[derive(Clone, Debug)]
pub(super) struct Control {
    pub t: f64,
    pub end: f64,
    pub exponent: f64,
    pub stretch: Stretch,
    /// The next step to try.
    pub step: f64,
    pub is_last: bool,
    before: Attempt,
    pub last: (f64, f64),
    pub last_error: f64,
    pub stiff_steps: u32,
    /// The largest speed so far, of a motion with constraints.
    pub largest_speed: f64,
    /// Whether the motion takes the next step itself, and no lane.
    pub is_own_turn: bool,
    /// How many of the last steps stability bounded, and whether the problem is stiff, at the start of the next step.
    before_note: (u32, bool),
    pub statistics: Statistics,
    /// The number of steps when the motion asked for more.
    steps_before: usize,
    pub failure: Option<Failure>,
}

impl Control {
    pub fn new(beginning: &Beginning<'_>) -> Self {
        let &Beginning { t, end, step, exponent, last, last_error, stiff_steps, .. } = beginning;
        Self {
            t,
            end,
            exponent,
            stretch: Stretch { until: t, steps: 0 },
            step,
            is_last: false,
            before: Attempt::Accepted,
            last,
            last_error,
            stiff_steps,
            largest_speed: 0.0,
            is_own_turn: false,
            before_note: (stiff_steps, false),
            statistics: Statistics::default(),
            steps_before: 0,
            failure: None,
        }
    }

    /// Go on from here until the motion looks at a step.
    pub fn put(&mut self, stretch: Stretch, statistics: Statistics, largest_speed: f64) {
        (self.stretch, self.statistics, self.largest_speed) = (stretch, statistics, largest_speed);
        self.before_note = (self.stiff_steps, statistics.stiff);
        self.steps_before = statistics.steps;
    }

    /// Whether a step was accepted since the motion asked for more.
    pub fn has_advanced(&self) -> bool {
        self.statistics.steps > self.steps_before
    }

    /// The next step to try; `None` if it is too short.
    pub fn length(&mut self, longest: f64) -> Option<f64> {
        let h = self.step.min(longest);
        if is_too_short(self.t, h) {
            let t = self.t;
            self.failure = Some(if self.before == Attempt::NotFinite {
                Failure::NotFinite { t }
            } else {
                Failure::StepCollapse { t, step: h }
            });
            return None;
        }
        self.is_last = is_last(self.t, h, self.end);
        Some(if self.is_last { self.end - self.t } else { h })
    }

    /// Count the steps that stability bounds.
    pub fn note_stiffness(&mut self, is_at_bound: bool) {
        self.before_note = (self.stiff_steps, self.statistics.stiff);
        self.statistics.stiff |= note_stiffness(&mut self.stiff_steps, is_at_bound);
    }

    /// Leave the step to the motion, which looks at its start again.
    pub fn leave(&mut self) {
        self.is_own_turn = true;
        (self.stiff_steps, self.statistics.stiff) = self.before_note;
    }

    /// Where the step that was chosen ends.
    pub fn end_of_step(&self, h: f64) -> f64 {
        if self.is_last { self.end } else { self.t + h }
    }

    pub fn accept(&mut self, h: f64, error: f64) {
        let factor;
        (factor, self.last_error) = factor_after(error, self.last_error, self.exponent, self.was_rejected());
        let next = h * factor;
        // The end of the motion does not limit the step that accuracy allows.
        self.step = if self.is_last { next.max(self.step) } else { next };
        self.last = (self.t, h);
        self.t = self.end_of_step(h);
        self.before_note = (self.stiff_steps, self.statistics.stiff);
        self.statistics.errors += error;
        self.statistics.steps += 1;
        self.stretch.steps -= 1;
        self.before = Attempt::Accepted;
    }

    pub fn reject(&mut self, h: f64, error: f64) {
        self.before = if error.is_finite() { Attempt::Rejected } else { Attempt::NotFinite };
        self.step = h * factor_after_rejection(error, self.exponent);
        self.statistics.rejected += 1;
    }

    /// Whether the step before the next one was rejected, so that the next one starts there as well.
    pub fn was_rejected(&self) -> bool {
        self.before != Attempt::Accepted
    }

    /// Whether a step of a lane is possible.
    pub fn goes_on(&self) -> bool {
        self.failure.is_none() && !self.is_own_turn
    }

    /// Whether the motion looks at the last step.
    pub fn is_over(&self) -> bool {
        !self.goes_on() || self.stretch.steps == 0 || self.t >= self.stretch.until.min(self.end)
    }
}
