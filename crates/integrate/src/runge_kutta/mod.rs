//! Explicit Runge–Kutta methods with step control and dense output. A `tableau` has the coefficients of each.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., 1993: the first step and
//! the choice of steps in II.4, the dense output in II.6, the recognition of stiff problems in IV.2 of volume II.

mod control;
mod dense;
mod dop853;
mod near_singular;
mod stages;
mod tableau;
mod tsit5;

use crate::dynamics::Dynamics;
use crate::failure::Failure;
use crate::lane::{Beginning, Lane, StepResults};
use crate::machine_code::BoundCode;
use crate::projection::{Projection, Tangent};
use crate::stepper::{Statistics, Stepper, Stretch};
use crate::tolerances::Tolerances;
pub(crate) use control::{
    LEAST_ERROR, error_of_step, factor_after, factor_after_rejection, is_last, is_too_short, note_stiffness,
    steepness, tolerance_of_integral, weight,
};
pub use dop853::DOP853;
pub use stages::Stages;
pub use tableau::{Row, Tableau};
pub use tsit5::TSIT5;

/// If at most this fraction of an error is along the constraints, stages are projected onto them.
const BESIDE: f64 = 0.01;

/// The place of the rates at the state, which are those of the first stage.
#[derive(Clone, Copy)]
enum First {
    Unknown,
    /// Among the stages, as the rates at the end of the last step.
    AtEnd,
    InPlace,
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
            dense: vec![vec![0.0; n]; dense::terms(tableau)],
            is_dense: false,
            scratch: vec![0.0; n],
            errors: vec![vec![0.0; n]; tableau.errors.len()],
            last_stage: vec![0.0; n],
            last_error: LEAST_ERROR.ln(),
            stiff_steps: 0,
            statistics: Statistics::default(),
            failure: None,
        };
        new.step = new.first_step(end);
        if let Some(lane) = new.lane_of_stretches() {
            let (state, rates) = (&new.state, new.stages.row(0));
            let (step, exponent) = (new.step, new.exponent());
            lane.begin(&Beginning { t, end, state, rates, step, exponent });
        }
        new
    }

    /// Guess the first step from the rates and their change.
    fn first_step(&mut self, end: f64) -> f64 {
        let longest = self.tolerances.max_step.min(end - self.t);
        self.evaluate_first();
        let (size, rate) = (self.weighted(&self.state), self.weighted(self.stages.row(0)));
        let trial = if size < 1e-5 || rate < 1e-5 { 1e-6 } else { 0.01 * size / rate }.min(longest);
        self.stage(1, (self.t, trial), (1.0, &[(0, 1.0)]));
        let change = difference(self.stages.row(1), self.stages.row(0));
        let steepest = rate.max(self.weighted(&change) / trial);
        let step = if steepest <= 1e-15 {
            (trial * 1e-3).max(1e-6)
        } else {
            (0.01 / steepest).powf(self.exponent())
        };
        let step = step.min(100.0 * trial).min(longest);
        if step.is_finite() { step } else { trial }
    }

    /// The root mean square of a vector in units of the tolerance.
    fn weighted(&self, vector: &[f64]) -> f64 {
        let Tolerances { relative, absolute, .. } = self.tolerances;
        let controlled = self.tolerances.controlled;
        let states = vector.iter().zip(&self.state).take(controlled);
        let sum: f64 = states.map(|(v, y)| (v / (absolute + relative * y.abs())).powi(2)).sum();
        (sum / count(controlled)).sqrt()
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

    /// The lane in which the next step is taken, if it is.
    fn lane(&self) -> Option<Lane> {
        self.rates.lane().filter(|_| !self.is_careful).cloned()
    }

    /// The lane in which several steps are taken at a time: without constraints, nothing happens between them.
    fn lane_of_stretches(&self) -> Option<Lane> {
        self.rates.lane().filter(|_| !self.projection.is_needed()).cloned()
    }

    /// The same step, together with those of other motions. The rates at its start are evaluated with it.
    fn try_step_in_lane(&mut self, lane: &Lane, h: f64) -> Result<(), Failure> {
        lane.take_step((self.t, h), &self.state, self.stages.row_mut(0));
        if matches!(self.first, First::Unknown) {
            self.statistics.evaluations += 1;
            self.first = First::InPlace;
            self.begin()?;
        }
        let &Tableau { stages, evaluates_end, .. } = self.tableau;
        self.statistics.evaluations += stages - usize::from(!evaluates_end);
        lane.read_step(StepResults {
            after: &mut self.after,
            last_stage: &mut self.last_stage,
            errors: &mut self.errors,
        });
        for stage in stages - 1..stages + usize::from(evaluates_end) {
            lane.read_rates(stage, self.stages.row_mut(stage));
        }
        self.are_rates_here = false;
        if self.state.len() > self.tolerances.controlled {
            self.fetch_rates();
        }
        Ok(())
    }

    /// Read the rates at all stages of the last step from its lane, if it was taken in one.
    fn fetch_rates(&mut self) {
        if let Some(lane) = self.rates.lane().filter(|_| !self.are_rates_here) {
            let has_first = self.lane_of_stretches().is_none();
            for stage in usize::from(has_first)..self.tableau.stages + usize::from(self.tableau.evaluates_end)
            {
                lane.read_rates(stage, self.stages.row_mut(stage));
            }
            self.are_rates_here = true;
        }
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

    /// The error of the step in units of the tolerance; NaN if some stage has no finite rate.
    fn error(&self, h: f64) -> f64 {
        self.weighted_error(h, &self.errors)
    }

    /// The error without the part that the projection onto the constraints takes away after the step.
    ///
    /// Near a singular position, where a constraint nearly follows from others, rounding errors along it are large in
    /// the accelerations, so that no step would be accepted.
    fn error_along(&self, h: f64, tangent: &Tangent<'_>) -> f64 {
        let along = self
            .errors
            .iter()
            .map(|error| tangent.part(self.t + h, &self.after, error.clone()))
            .collect::<Vec<_>>();
        self.weighted_error(h, &along)
    }

    /// The error by which a step is accepted or rejected.
    ///
    /// If nearly all of it leads off the constraints, the step is repeated with stages on them, and the remaining
    /// part off the constraints is left to the projection, whose corrections are bounded. That happens only after the
    /// step has been rejected once: away from singular positions, all errors measure its accuracy.
    fn error_that_counts(&mut self, h: f64, was_rejected: bool) -> f64 {
        let error = self.error(h);
        let Some(tangent) = self.tangent.as_ref().filter(|_| error > 1.0) else { return error };
        let along = self.error_along(h, tangent);
        if along < BESIDE * error {
            self.is_careful = true;
            self.regular = self.regular.max(h);
        }
        if was_rejected { error.min(along) } else { error }
    }

    /// Choose the next step after one that was accepted; reasons other than its error do not shorten it.
    fn choose_next(&mut self, h: f64, next: f64, is_last: bool) {
        // The end of the motion does not limit the step that accuracy allows.
        let next = next.max(self.regular);
        self.step = if is_last { next.max(self.step) } else { next };
        self.last_regular = std::mem::take(&mut self.regular).max(h);
    }

    /// The estimates of an error together, in units of the tolerance.
    fn weighted_error(&self, h: f64, estimates: &[Vec<f64>]) -> f64 {
        let square = |error: &Vec<f64>| self.weighted_square(error, h);
        let squares = (estimates.first().map_or(0.0, square), estimates.get(1).map(square));
        error_of_step(h, squares, count(self.tolerances.controlled))
    }

    /// The sum of the squares of an error in units of the tolerance.
    fn weighted_square(&self, error: &[f64], h: f64) -> f64 {
        let controlled = self.tolerances.controlled;
        let ends = self.state.iter().zip(&self.after);
        let weights = ends.map(|(before, after)| weight(&self.tolerances, *before, *after));
        let states: f64 =
            error.iter().zip(weights).take(controlled).map(|(e, weight)| (e * weight).powi(2)).sum();
        let integrals = error.iter().enumerate().skip(controlled);
        states + integrals.map(|(i, e)| (e / self.tolerance_of_integral(i, h)).powi(2)).sum::<f64>()
    }

    fn tolerance_of_integral(&self, i: usize, h: f64) -> f64 {
        let steepest =
            (0..self.tableau.stages).map(|stage| self.stages.row(stage)[i].abs()).fold(0.0, f64::max);
        tolerance_of_integral(&self.tolerances, self.sizes[i], self.after[i], h.abs() * steepest)
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
        if self.lane_of_stretches().is_some() {
            return self.advance(end, Stretch { until: f64::NEG_INFINITY, steps: 1 });
        }
        self.is_careful = false;
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
        let Some(lane) = self.lane_of_stretches() else { return self.step(end) };
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        let steps = self.statistics.steps;
        let arrival = lane.advance(stretch, self.statistics, (&mut self.before, &mut self.after));
        self.state.copy_from_slice(&self.after);
        (self.t, self.last, self.statistics) = (arrival.t, arrival.last, arrival.statistics);
        (self.is_dense, self.are_rates_here) = (false, false);
        match arrival.failure {
            Some(failure) if self.statistics.steps == steps => Err(failure),
            later => {
                self.failure = later;
                Ok(())
            }
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

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x - y).collect()
}

fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum()
}
