//! The control of the steps of a motion in a lane: the same choices as those of a motion alone.

use crate::failure::Failure;
use crate::lane::Beginning;
use crate::runge_kutta::{LEAST_ERROR, factor_after, factor_after_rejection, is_last, is_too_short};
use crate::stepper::{Statistics, Stretch};

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
    /// Whether the step before the next one was rejected, so that the next one starts there as well.
    pub was_rejected: bool,
    pub is_finite: bool,
    pub last: (f64, f64),
    pub last_error: f64,
    pub stiff_steps: u32,
    pub statistics: Statistics,
    pub failure: Option<Failure>,
}

impl Control {
    pub fn new(beginning: &Beginning<'_>) -> Self {
        let &Beginning { t, end, step, exponent, .. } = beginning;
        Self {
            t,
            end,
            exponent,
            stretch: Stretch { until: t, steps: 0 },
            step,
            is_last: false,
            was_rejected: false,
            is_finite: true,
            last: (t, 0.0),
            last_error: LEAST_ERROR.ln(),
            stiff_steps: 0,
            statistics: Statistics::default(),
            failure: None,
        }
    }

    /// The next step to try; `None` if it is too short.
    pub fn length(&mut self, longest: f64) -> Option<f64> {
        let h = self.step.min(longest);
        if is_too_short(self.t, h) {
            let t = self.t;
            self.failure = Some(if self.is_finite {
                Failure::StepCollapse { t, step: h }
            } else {
                Failure::NotFinite { t }
            });
            return None;
        }
        self.is_last = is_last(self.t, h, self.end);
        Some(if self.is_last { self.end - self.t } else { h })
    }

    pub fn accept(&mut self, h: f64, error: f64) {
        let factor;
        (factor, self.last_error) = factor_after(error, self.last_error, self.exponent, self.was_rejected);
        let next = h * factor;
        // The end of the motion does not limit the step that accuracy allows.
        self.step = if self.is_last { next.max(self.step) } else { next };
        self.last = (self.t, h);
        self.t = if self.is_last { self.end } else { self.t + h };
        self.statistics.errors += error;
        self.statistics.steps += 1;
        self.stretch.steps -= 1;
        (self.was_rejected, self.is_finite) = (false, true);
    }

    pub fn reject(&mut self, h: f64, error: f64) {
        self.is_finite = error.is_finite();
        self.step = h * factor_after_rejection(error, self.exponent);
        self.statistics.rejected += 1;
        self.was_rejected = true;
    }

    /// Whether the motion looks at the last step.
    pub fn is_over(&self) -> bool {
        self.failure.is_some() || self.stretch.steps == 0 || self.t >= self.stretch.until.min(self.end)
    }
}
