//! Noise near a singular position: its effects, and how they are detected.
//!
//! If a constraint nearly follows from others, rounding errors of the positions turn the direction that it forbids, and
//! the rates contain parts that do not belong to the motion. Steps should start, and states be read, elsewhere.

use crate::failure::Failure;
use crate::projection::Tangent;
use crate::stepper::Stepper;
use crate::tolerances::Tolerances;

use super::error::{BESIDE, difference};
use super::{First, RungeKutta};

/// If the estimate of the step times the largest eigenvalue exceeds this, the rates at the end of the step are noise,
/// provided that their change leads off the constraints.
pub(crate) const NOISE: f64 = 30.0;
/// A dense output whose slope in the middle is off by more than the first number of tolerances is noise if most of
/// the defect leads off the constraints. Otherwise smooth motions have about ten, and more than the second number is
/// an error.
const DEFECT: (f64, f64) = (3.0, 30.0);
/// No step should start where rounding errors of the coordinates change a speed by more than this many tolerances, at
/// the largest value of any speed so far.
const UNCERTAIN: f64 = 1.0;
/// The same bound if `max_step` holds steps back: they stop well before the position, and one long step crosses it.
const BEFORE: f64 = 0.01;
/// Rounding errors that change a speed by more than this fraction of it decide on the branch.
const UNDECIDED: f64 = 1e-6;
/// A motion whose speeds are below this fraction of the largest so far may turn back.
pub(crate) const SLOW: f64 = 0.01;
/// A step is held back by `max_step` if accuracy allows a step at least this many times longer.
pub(crate) const HELD_BACK: f64 = 2.0;

impl RungeKutta<'_> {
    /// Whether the rates at the state agree with those of the neighbouring state at which the last stage was evaluated,
    /// except for differences that an explicit method can integrate.
    pub(super) fn is_start_certain(&mut self) -> bool {
        let is_known = self.statistics.steps == 0 || matches!(self.first, First::InPlace);
        if is_known || self.tangent.is_none() {
            return true;
        }
        self.note_turning();
        if self.is_held_back() && self.t > self.looked_until && self.uncertainty() > BEFORE {
            self.looked_until = self.t;
            return false;
        }
        self.evaluate_first();
        if self.steepness() <= NOISE {
            return true;
        }
        let change = difference(self.stages.row(0), self.stages.row(self.tableau.stages - 1));
        let size = self.weighted(&change);
        let along = |tangent: &Tangent<'_>| self.weighted(&tangent.part(self.t, &self.state, change));
        size * self.last.1 <= 1.0
            || self.tangent.as_ref().is_none_or(|tangent| along(tangent) > BESIDE * size)
    }

    /// Fail where rounding errors decide which speeds the constraints allow: steps from such a state are rejected
    /// until they are so short that they follow the errors onto another branch.
    ///
    /// It fails only once per instant: if no other step helps, the motion continues and is recorded as uncertain.
    pub(super) fn check_start(&mut self) -> Result<(), Failure> {
        let (change, bound) = self.noise();
        if change <= UNCERTAIN * bound {
            return Ok(());
        }
        if self.t > self.checked_until {
            self.checked_until = self.t;
            return Err(Failure::Singular { t: self.t, change, bound });
        }
        if change > UNDECIDED / self.tolerances.relative * bound {
            self.statistics.uncertain.get_or_insert(self.t);
        }
        Ok(())
    }

    /// Record that a motion turns back where rounding errors decide on its directions: the test by tolerances does
    /// not see how small its speeds are.
    fn note_turning(&mut self) {
        let Some(tangent) = &self.tangent else { return };
        let fastest = |entries: &[f64]| entries.iter().fold(0.0_f64, |most, speed| most.max(speed.abs()));
        let (now, ever) = (fastest(&self.state[tangent.speeds()]), fastest(&self.sizes[tangent.speeds()]));
        if now < SLOW * ever && tangent.noise(self.t, &self.state, &self.sizes) > UNDECIDED * now {
            self.statistics.uncertain.get_or_insert(self.t);
        }
    }

    /// Whether `max_step` holds steps back.
    pub(super) fn is_held_back(&self) -> bool {
        self.step > HELD_BACK * self.tolerances.max_step
    }

    /// By how much rounding errors of the coordinates change the speeds, in tolerances.
    fn uncertainty(&self) -> f64 {
        let (change, bound) = self.noise();
        change / bound
    }

    /// By how much rounding errors of the coordinates change the speeds, and the tolerance.
    fn noise(&self) -> (f64, f64) {
        let Some(tangent) = &self.tangent else { return (0.0, f64::INFINITY) };
        let fastest = self.sizes[tangent.speeds()].iter().fold(0.0_f64, |most, &speed| most.max(speed));
        let Tolerances { relative, absolute, .. } = self.tolerances;
        (tangent.noise(self.t, &self.state, &self.sizes), absolute + relative * fastest)
    }

    /// Whether the dense output of the last step satisfies the equations in the middle of the step.
    ///
    /// No error estimate covers the stages of the dense output itself. A crew that looks for events has checked that.
    pub(super) fn is_dense_output_certain(&mut self) -> bool {
        let has_own_stages = self.tableau.c.len() > self.tableau.stages + 1;
        if !has_own_stages || self.tangent.is_none() || self.has_crossing.is_some() {
            return true;
        }
        let (t, h) = self.last;
        let middle = t + 0.5 * h;
        let mut state = self.after.clone();
        if self.interpolate(middle, &mut state).is_err()
            || self.projection.project(middle, &mut state).is_err()
        {
            return false;
        }
        let mut rates = vec![0.0; state.len()];
        self.rates.call(middle, &state, &mut rates);
        self.statistics.evaluations += 1;
        let defect = difference(&rates, &self.slopes(0.5));
        let size = h * self.weighted(&defect);
        has_small_defect(size)
            || self.tangent.as_ref().is_none_or(|tangent| {
                has_smooth_defect(size, h * self.weighted(&tangent.part(middle, &state, defect)))
            })
    }
}

/// Whether a defect of a dense output, in tolerances, is small.
#[inline]
pub(crate) fn has_small_defect(size: f64) -> bool {
    size <= DEFECT.0
}

/// Whether a defect is that of a smooth motion, by its part along the constraints.
#[inline]
pub(crate) fn has_smooth_defect(size: f64, along: f64) -> bool {
    along <= if size > 2.0 * along { DEFECT.0 } else { DEFECT.1 }
}
