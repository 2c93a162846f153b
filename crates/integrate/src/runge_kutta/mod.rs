//! Explicit Runge–Kutta methods with step control and dense output. A `tableau` has the coefficients of each.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., 1993: the first step and
//! the choice of steps in II.4, the dense output in II.6, the recognition of stiff problems in IV.2 of volume II.

mod control;
mod dense;
mod dop853;
mod error;
mod first_step;
mod in_lane;
mod near_singular;
mod stages;
mod tableau;
mod tsit5;

use crate::dynamics::Dynamics;
use crate::failure::Failure;
use crate::machine_code::BoundCode;
use crate::projection::{Projection, Tangent};
use crate::stepper::{Landing, Sight, Statistics, Stepper, Stretch};
use crate::tolerances::Tolerances;
pub(crate) use control::{
    LEAST_ERROR, error_of_step, factor_after, factor_after_rejection, in_tolerances, is_last, is_too_short,
    note_stiffness, steepness, tolerance_of_integral, weight,
};
pub(crate) use dense::{between, hermite_terms, slope_between, terms};
pub use dop853::DOP853;
pub(crate) use near_singular::{HELD_BACK, NOISE, SLOW, has_small_defect, has_smooth_defect};
pub use stages::Stages;
pub use tableau::{Row, Tableau};
pub use tsit5::TSIT5;

/// The place of the rates at the state, which are those of the first stage.
#[derive(Clone, Copy)]
enum First {
    Unknown,
    /// Among the stages, as the rates at the end of the last step.
    AtEnd,
    InPlace,
}

/// Who takes the next step of a motion with constraints in a lane.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Turn {
    /// The lane doesn't know where the motion is.
    Unknown,
    Lane,
    /// The lane leaves it to the motion.
    Motion,
}

/// A method during an integration.
pub struct RungeKutta<'a> {
    tableau: &'static Tableau,
    rates: &'a BoundCode,
    /// The directions of the speeds that the constraints allow, if they are kept by projection.
    tangent: Option<Tangent<'a>>,
    projection: Projection<'a>,
    /// Whether states are put onto the constraints before their rates are evaluated.
    ///
    /// Motions on the constraints are the same with and without it. Near a singular position the rates off the
    /// constraints are large and are not part of the motion. Elsewhere the projection only costs time.
    is_careful: bool,
    tolerances: Tolerances,
    t: f64,
    state: Vec<f64>,
    /// The next step to try.
    step: f64,
    /// The step to continue with after one that was shortened for errors off the constraints.
    regular: f64,
    /// The same for the previous step.
    last_regular: f64,
    /// A step up to this length is allowed beyond `max_step`, so that it crosses a singular position.
    crossing: f64,
    /// The instant up to which a step across a singular position has been tried.
    looked_until: f64,
    /// The instant up to which it has been checked whether rounding errors decide on the branch.
    checked_until: f64,
    /// The largest magnitude or change of each entry of the state so far.
    sizes: Vec<f64>,
    origin: Vec<f64>,
    /// The rates at the stages.
    stages: Stages,
    /// Whether those of the last step are among them: a lane has them until they are needed.
    are_rates_here: bool,
    first: First,
    /// The last step: its start, its length, and its states at both ends.
    last: (f64, f64),
    before: Vec<f64>,
    after: Vec<f64>,
    /// The terms of the dense output, if they have been computed for the last step.
    dense: Vec<Vec<f64>>,
    is_dense: bool,
    scratch: Vec<f64>,
    /// The estimates of the error.
    errors: Vec<Vec<f64>>,
    /// The state at which the last stage of the step before was evaluated.
    last_stage: Vec<f64>,
    /// The logarithm of the error of the step before, in units of the tolerance.
    last_error: f64,
    stiff_steps: u32,
    statistics: Statistics,
    /// Why the step after the last one failed, if several were taken at once.
    failure: Option<Failure>,
    turn: Turn,
    /// Whether an event may happen in the last step, if the crew has taken it and looked for events.
    has_crossing: Option<bool>,
}

impl<'a> RungeKutta<'a> {
    /// The method at the start of a motion that ends at `end`.
    pub fn new(
        tableau: &'static Tableau,
        dynamics: &'a Dynamics,
        (t, end): (f64, f64),
        state: &[f64],
        tolerances: Tolerances,
    ) -> Self {
        let n = state.len();
        let mut new = Self {
            tableau,
            rates: &dynamics.rates,
            tangent: Tangent::of(dynamics),
            projection: Projection::new(dynamics),
            is_careful: false,
            tolerances,
            t,
            state: state.to_vec(),
            step: 0.0,
            regular: 0.0,
            last_regular: 0.0,
            crossing: 0.0,
            looked_until: t,
            checked_until: t,
            sizes: state.iter().map(|x| x.abs()).collect(),
            origin: state.to_vec(),
            stages: Stages::new(tableau.c.len(), n),
            are_rates_here: true,
            first: First::Unknown,
            last: (t, 0.0),
            before: state.to_vec(),
            after: state.to_vec(),
            dense: vec![vec![0.0; n]; terms(tableau)],
            is_dense: false,
            scratch: vec![0.0; n],
            errors: vec![vec![0.0; n]; tableau.errors.len()],
            last_stage: vec![0.0; n],
            last_error: LEAST_ERROR.ln(),
            stiff_steps: 0,
            statistics: Statistics::default(),
            failure: None,
            turn: Turn::Unknown,
            has_crossing: None,
        };
        new.step = new.first_step(end);
        if let Some(lane) = new.free_lane() {
            new.begin_in_lane(&lane, end);
        }
        new
    }

    /// The power of an error that is proportional to the step.
    fn exponent(&self) -> f64 {
        1.0 / f64::from(self.tableau.order)
    }

    fn evaluate_first(&mut self) {
        match self.first {
            First::InPlace => {}
            First::AtEnd => self.stages.copy(self.tableau.stages, 0),
            First::Unknown => {
                self.rates.call(self.t, &self.state, self.stages.row_mut(0));
                self.statistics.evaluations += 1;
            }
        }
        self.first = First::InPlace;
    }

    /// Evaluate a stage at an instant and at a combination of earlier ones, in steps.
    fn stage(&mut self, place: usize, (t, h): (f64, f64), (c, weights): (f64, &[(usize, f64)])) {
        self.stages.step(&mut self.scratch, &self.state, h, weights);
        self.evaluate(place, t + c * h);
    }

    /// Evaluate the rates at the state in `scratch`; they are NaN if the projection onto the constraints fails.
    fn evaluate(&mut self, place: usize, t: f64) {
        let rates = self.stages.row_mut(place);
        if self.is_careful && self.projection.project(t, &mut self.scratch).is_err() {
            rates.fill(f64::NAN);
        } else {
            self.rates.call(t, &self.scratch, rates);
        }
        self.statistics.evaluations += 1;
    }

    /// Evaluate the stages of a step, and write the state at its end to `after`, and the estimates of its error.
    fn try_step(&mut self, h: f64) -> Result<(), Failure> {
        let &Tableau { stages, c, a, evaluates_end, errors, .. } = self.tableau;
        if let Some(lane) = self.lane() {
            return self.try_step_in_lane(&lane, h);
        }
        self.are_rates_here = true;
        for place in 1..stages {
            self.stage(place, (self.t, h), (c[place], a[place]));
        }
        std::mem::swap(&mut self.last_stage, &mut self.scratch);
        self.stages.step(&mut self.after, &self.state, h, a[stages]);
        if evaluates_end {
            self.scratch.copy_from_slice(&self.after);
            self.evaluate(stages, self.t + h);
        }
        for (error, weights) in self.errors.iter_mut().zip(errors) {
            self.stages.sum(error, weights);
        }
        Ok(())
    }

    /// Check the rates at the start of a step, while those of the step before it are known.
    fn begin(&mut self) -> Result<(), Failure> {
        if !is_finite(self.stages.row(0)) {
            return Err(Failure::NotFinite { t: self.t });
        }
        if self.statistics.steps > 0 {
            self.note_stiffness();
        }
        Ok(())
    }

    /// Choose the next step after one that was accepted; reasons other than its error do not shorten it.
    fn choose_next(&mut self, h: f64, next: f64, is_last: bool) {
        // The end of the motion does not limit the step that accuracy allows.
        let next = next.max(self.regular);
        self.step = if is_last { next.max(self.step) } else { next };
        self.last_regular = std::mem::take(&mut self.regular).max(h);
    }

    fn accept(&mut self, h: f64, t: f64) {
        self.last = (self.t, h);
        std::mem::swap(&mut self.before, &mut self.state);
        self.state.copy_from_slice(&self.after);
        for (size, (x, origin)) in self.sizes.iter_mut().zip(self.state.iter().zip(&self.origin)) {
            *size = size.max(x.abs()).max((x - origin).abs());
        }
        self.t = t;
        self.first = if self.tableau.evaluates_end { First::AtEnd } else { First::Unknown };
        self.is_dense = false;
        self.crossing = 0.0;
        self.statistics.steps += 1;
    }

    fn steepness(&self) -> f64 {
        let rates = squared_distance(self.stages.row(0), self.stages.row(self.tableau.stages - 1));
        steepness(self.last.1, rates, squared_distance(&self.state, &self.last_stage))
    }

    /// If the largest eigenvalue bounds many steps of an explicit method, the problem is stiff.
    fn note_stiffness(&mut self) {
        let is_at_bound = self.steepness() > self.tableau.stability;
        self.statistics.stiff |= note_stiffness(&mut self.stiff_steps, is_at_bound);
    }
}

impl Stepper for RungeKutta<'_> {
    fn starts_well(&mut self) -> bool {
        self.is_start_certain()
    }

    fn reads_well(&mut self) -> bool {
        self.is_dense_output_certain()
    }

    fn is_held_back(&self) -> bool {
        self.is_held_back()
    }

    fn step(&mut self, end: f64) -> Result<(), Failure> {
        if self.free_lane().is_some() {
            return self.advance(end, Stretch { until: f64::NEG_INFINITY, steps: 1 });
        }
        (self.is_careful, self.turn, self.has_crossing) = (false, Turn::Unknown, None);
        // In a lane, unknown rates are evaluated with the step.
        if !matches!(self.first, First::Unknown) || self.lane().is_none() {
            self.evaluate_first();
            self.begin()?;
        }
        let (mut is_finite, mut was_rejected) = (true, false);
        loop {
            let mut h = self.step.min(self.tolerances.max_step.max(self.crossing));
            if is_too_short(self.t, h) {
                return Err(if is_finite {
                    Failure::StepCollapse { t: self.t, step: h }
                } else {
                    Failure::NotFinite { t: self.t }
                });
            }
            let is_last = is_last(self.t, h, end);
            if is_last {
                h = end - self.t;
            }
            self.try_step(h)?;
            let error = self.error_that_counts(h, was_rejected);
            if error <= 1.0 {
                let factor;
                (factor, self.last_error) =
                    factor_after(error, self.last_error, self.exponent(), was_rejected);
                self.statistics.errors += error;
                self.accept(h, if is_last { end } else { self.t + h });
                self.choose_next(h, h * factor, is_last);
                return Ok(());
            }
            is_finite = error.is_finite();
            self.step = h * factor_after_rejection(error, self.exponent());
            self.statistics.rejected += 1;
            if was_rejected {
                self.check_start()?;
            }
            was_rejected = true;
        }
    }

    fn advance(&mut self, end: f64, stretch: Stretch) -> Result<(), Failure> {
        match self.free_lane() {
            Some(lane) => self.advance_in_lane(&lane, stretch),
            None => self.step(end),
        }
    }

    fn advance_on_constraints(
        &mut self,
        end: f64,
        stretch: Stretch,
        largest_speed: f64,
        states: (&mut [f64], &mut [f64]),
    ) -> Option<Landing> {
        let lane = self.lane_on_constraints()?;
        self.land_in_lane(&lane, end, (stretch, largest_speed), states)
    }

    fn looks_for_events(&self) -> bool {
        self.free_lane().or(self.lane_on_constraints()).is_some_and(|lane| lane.looks_for_events())
    }

    fn sight(&self) -> Sight {
        match self.has_crossing {
            None => Sight::Unknown,
            Some(false) => Sight::Nothing,
            Some(true) => Sight::Crossing { t: self.last.0 },
        }
    }

    fn read_event_values(&self, start: &mut [f64], ends: &mut [f64]) {
        if let Some(lane) = self.rates.lane() {
            lane.read_event_values(start, ends);
        }
    }

    fn read_event_values_at_end(&self, values: &mut [f64]) {
        if let Some(lane) = self.rates.lane() {
            lane.read_event_values_at_end(values);
        }
    }

    fn t(&self) -> f64 {
        self.t
    }

    fn state(&self) -> &[f64] {
        &self.state
    }

    fn interpolate(&mut self, t: f64, out: &mut [f64]) -> Result<(), Failure> {
        let (start, h) = self.last;
        if t >= self.t || t >= start + h {
            out.copy_from_slice(&self.after);
            return Ok(());
        }
        if !self.is_dense {
            self.prepare_dense();
        }
        self.value((t - start) / h, out);
        Ok(())
    }

    fn replace(&mut self, state: &[f64]) {
        self.state.copy_from_slice(state);
        self.first = First::Unknown;
    }

    fn retract(&mut self, part: f64) -> bool {
        let (t, h) = self.last;
        self.last.1 = part * h;
        self.step = part * h;
        self.crossing = if part > 1.0 { self.step } else { 0.0 };
        self.regular = self.regular.max(self.last_regular);
        if self.t > t {
            self.t = t;
            self.state.copy_from_slice(&self.before);
            if !self.are_rates_here {
                // They were in a lane.
                self.rates.call(self.t, &self.state, self.stages.row_mut(0));
            }
            // The first stage still holds the rates at the start, unless the rates at the end have been evaluated.
            self.first = if matches!(self.first, First::InPlace) { First::Unknown } else { First::InPlace };
            self.statistics.steps -= 1;
            self.statistics.rejected += 1;
        }
        h > 0.0
    }

    fn statistics(&self) -> Statistics {
        self.statistics
    }
}

#[allow(clippy::cast_precision_loss, reason = "no state has 2^53 numbers")]
fn count(n: usize) -> f64 {
    n as f64
}

fn is_finite(rates: &[f64]) -> bool {
    rates.iter().all(|rate| rate.is_finite())
}

fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum()
}
