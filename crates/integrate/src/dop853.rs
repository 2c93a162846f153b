//! The explicit Runge–Kutta method of order 8(5, 3) by Dormand and Prince, with dense output of order 7.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., 1993: the method and its
//! error estimate in II.5, the first step and the choice of steps in II.4, the dense output in II.6, the recognition of
//! stiff problems in IV.2 of volume II.

mod coefficients;
mod stages;

use crate::dynamics::Dynamics;
use crate::failure::Failure;
use crate::function::Function;
use crate::method::Tolerances;
use crate::projection::{Projection, Tangent};
use crate::stepper::{Statistics, Stepper};
use coefficients::{A, C, DENSE, ERRORS};
use stages::Stages;

const STAGES: usize = 12;
const ORDER: i32 = 8;
/// Steps are chosen by the error of the last one and, a little, by that of the one before, so that few are rejected; these
/// two take a sixth fewer evaluations than 0.9 and 0 on a double pendulum and on Andrews' mechanism.
const SAFETY: f64 = 0.8;
const MEMORY: f64 = 0.04;
/// Smaller errors are remembered as this one.
const LEAST_ERROR: f64 = 1e-4;
/// Where so little of an error is along the constraints, stages are better put onto them.
const BESIDE: f64 = 0.01;
const SHRINK: f64 = 0.333;
const GROW: f64 = 6.0;

/// The method in the midst of its work.
pub struct Dop853<'a> {
    rates: &'a Function,
    /// Where constraints let the speeds go, if they are kept by projection.
    tangent: Option<Tangent<'a>>,
    projection: Projection<'a>,
    /// Whether states are put onto the constraints before their rates are evaluated.
    ///
    /// Motions on the constraints are the same with and without. Near a singular position the rates beside them are
    /// large, and what the stages hold of these is no part of the motion; away from there it takes time for nothing.
    is_careful: bool,
    tolerances: Tolerances,
    t: f64,
    state: Vec<f64>,
    /// The next step to try.
    step: f64,
    /// The rates at the stages; the first are those at the state if `is_fresh`.
    stages: Stages,
    is_fresh: bool,
    /// The step before: its begin, its length, and its states at both ends.
    last: (f64, f64),
    before: Vec<f64>,
    after: Vec<f64>,
    /// The terms of the dense output, if they are those of the last step.
    dense: [Vec<f64>; 7],
    is_dense: bool,
    scratch: Vec<f64>,
    /// Both estimates of the error.
    errors: [Vec<f64>; 2],
    /// The state at which the last stage of the step before was evaluated.
    last_stage: Vec<f64>,
    /// The logarithm of the error of the step before, in units of the tolerance.
    last_error: f64,
    stiff_steps: u32,
    statistics: Statistics,
}

impl<'a> Dop853<'a> {
    pub fn new(dynamics: &'a Dynamics, (t, end): (f64, f64), state: &[f64], tolerances: Tolerances) -> Self {
        let n = state.len();
        let mut new = Self {
            rates: &dynamics.rates,
            tangent: Tangent::of(dynamics),
            projection: Projection::new(dynamics),
            is_careful: false,
            tolerances,
            t,
            state: state.to_vec(),
            step: 0.0,
            stages: Stages::new(C.len(), n),
            is_fresh: false,
            last: (t, 0.0),
            before: state.to_vec(),
            after: state.to_vec(),
            dense: std::array::from_fn(|_| vec![0.0; n]),
            is_dense: false,
            scratch: vec![0.0; n],
            errors: [vec![0.0; n], vec![0.0; n]],
            last_stage: vec![0.0; n],
            last_error: LEAST_ERROR.ln(),
            stiff_steps: 0,
            statistics: Statistics::default(),
        };
        new.step = new.first_step(end);
        new
    }

    /// Guess the first step from the rates and their change.
    fn first_step(&mut self, end: f64) -> f64 {
        let longest = self.tolerances.max_step.min(end - self.t);
        self.evaluate_first();
        let (size, rate) = (self.weighted(&self.state), self.weighted(self.stages.row(0)));
        let trial = if size < 1e-5 || rate < 1e-5 { 1e-6 } else { 0.01 * size / rate }.min(longest);
        self.stage(1, (self.t, trial), (1.0, &[(0, 1.0)]));
        let change: Vec<f64> =
            self.stages.row(1).iter().zip(self.stages.row(0)).map(|(a, b)| a - b).collect();
        let steepest = rate.max(self.weighted(&change) / trial);
        let step = if steepest <= 1e-15 {
            (trial * 1e-3).max(1e-6)
        } else {
            (0.01 / steepest).powf(1.0 / f64::from(ORDER))
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

    fn evaluate_first(&mut self) {
        if !self.is_fresh {
            self.rates.call(self.t, &self.state, self.stages.row_mut(0));
            self.statistics.evaluations += 1;
            self.is_fresh = true;
        }
    }

    /// Evaluate a stage at an instant and at a combination of earlier ones, in steps.
    fn stage(&mut self, place: usize, (t, h): (f64, f64), (c, weights): (f64, &[(usize, f64)])) {
        self.stages.step(&mut self.scratch, &self.state, h, weights);
        self.evaluate(place, t + c * h);
    }

    /// Evaluate the rates at the state in `scratch`; there are none where no way leads onto the constraints.
    fn evaluate(&mut self, place: usize, t: f64) {
        let rates = self.stages.row_mut(place);
        if self.is_careful && self.projection.project(t, &mut self.scratch).is_err() {
            rates.fill(f64::NAN);
        } else {
            self.rates.call(t, &self.scratch, rates);
        }
        self.statistics.evaluations += 1;
    }

    /// Evaluate the stages of a step, and write the state at its end to `after`.
    fn try_step(&mut self, h: f64) {
        for place in 1..STAGES {
            self.stage(place, (self.t, h), (C[place], A[place]));
        }
        self.stages.step(&mut self.after, &self.state, h, A[STAGES]);
    }

    /// The error of the step in units of the tolerance; NaN if some stage has no finite rate.
    fn error(&mut self, h: f64) -> f64 {
        for (error, weights) in self.errors.iter_mut().zip(ERRORS) {
            self.stages.sum(error, weights);
        }
        let [fifth, third] = &self.errors;
        self.weighted_error(h, fifth, third)
    }

    /// The error without the part that the projection onto the constraints takes away after the step.
    ///
    /// Near a singular position, where a constraint nearly follows from others, rounding errors along it are large in
    /// the accelerations: they would let no step pass.
    fn error_along(&self, h: f64, tangent: &Tangent<'_>) -> f64 {
        let [fifth, third] =
            self.errors.each_ref().map(|error| tangent.part(self.t + h, &self.after, error.clone()));
        self.weighted_error(h, &fifth, &third)
    }

    /// Both estimates of an error together, in units of the tolerance.
    fn weighted_error(&self, h: f64, fifth: &[f64], third: &[f64]) -> f64 {
        let Tolerances { relative, absolute, controlled, .. } = self.tolerances;
        let (mut sum5, mut sum3) = (0.0, 0.0);
        let estimates = fifth.iter().zip(third).take(controlled);
        for ((e5, e3), (before, after)) in estimates.zip(self.state.iter().zip(&self.after)) {
            let weight = 1.0 / (absolute + relative * before.abs().max(after.abs()));
            sum5 += (e5 * weight).powi(2);
            sum3 += (e3 * weight).powi(2);
        }
        let both = sum5 + 0.01 * sum3;
        if both <= 0.0 { 0.0 } else { h.abs() * sum5 / (both * count(controlled)).sqrt() }
    }

    /// The factor to the next step after one that is accepted, by proportional and integral control
    /// [Hairer & Wanner, volume II, IV.2].
    fn factor(&mut self, error: f64) -> f64 {
        let (now, before) = (error.max(f64::MIN_POSITIVE).ln(), self.last_error);
        self.last_error = now.max(LEAST_ERROR.ln());
        SAFETY * ((0.2 * MEMORY - 1.0 / f64::from(ORDER)) * now + MEMORY * before).exp()
    }

    fn accept(&mut self, h: f64, t: f64) {
        std::mem::swap(&mut self.last_stage, &mut self.scratch);
        self.last = (self.t, h);
        std::mem::swap(&mut self.before, &mut self.state);
        self.state.copy_from_slice(&self.after);
        self.t = t;
        self.is_fresh = false;
        self.is_dense = false;
        self.statistics.steps += 1;
    }

    /// The last stage of a step and its end are at the same instant: how far apart their rates and their states are
    /// estimates the largest eigenvalue. An explicit method that is bound by it for many steps is the wrong one.
    fn note_stiffness(&mut self) {
        const BOUND: f64 = 5.0;
        const STEPS: u32 = 15;
        let rates = squared_distance(self.stages.row(0), self.stages.row(STAGES - 1));
        let states = squared_distance(&self.state, &self.last_stage);
        let is_at_bound = states > 0.0 && self.last.1 * (rates / states).sqrt() > BOUND;
        self.stiff_steps =
            if is_at_bound { self.stiff_steps + 1 } else { self.stiff_steps.saturating_sub(1) };
        self.statistics.stiff |= self.stiff_steps >= STEPS;
    }

    /// Evaluate the stages of the dense output of the last step.
    fn add_stages(&mut self) {
        let (t, h) = self.last;
        self.scratch.copy_from_slice(&self.after);
        self.evaluate(STAGES, t + h);
        for place in STAGES + 1..C.len() {
            self.stages.step(&mut self.scratch, &self.before, h, A[place]);
            self.evaluate(place, t + C[place] * h);
        }
    }

    /// Compute the terms of the dense output of the last step.
    fn prepare_dense(&mut self) {
        self.is_careful = self.projection.is_needed();
        self.add_stages();
        if self.is_careful && (STAGES..C.len()).any(|stage| !is_finite(self.stages.row(stage))) {
            self.is_careful = false;
            self.add_stages();
        }
        let (_, h) = self.last;
        let [change, first, second, higher @ ..] = &mut self.dense;
        for i in 0..self.after.len() {
            let (start, end) = (h * self.stages.row(0)[i], h * self.stages.row(STAGES)[i]);
            change[i] = self.after[i] - self.before[i];
            first[i] = start - change[i];
            second[i] = 2.0 * change[i] - start - end;
        }
        for (terms, weights) in higher.iter_mut().zip(DENSE) {
            self.stages.sum(terms, weights);
            for term in terms {
                *term *= h;
            }
        }
        self.is_dense = true;
    }
}

impl Stepper for Dop853<'_> {
    fn step(&mut self, end: f64) -> Result<(), Failure> {
        self.evaluate_first();
        if !is_finite(self.stages.row(0)) {
            return Err(Failure::NotFinite { t: self.t });
        }
        if self.statistics.steps > 0 {
            self.note_stiffness();
        }
        let (mut is_finite, mut was_rejected) = (true, false);
        self.is_careful = false;
        loop {
            let mut h = self.step.min(self.tolerances.max_step);
            if h <= 4.0 * f64::EPSILON * self.t.abs() || h < f64::MIN_POSITIVE {
                return Err(if is_finite {
                    Failure::StepCollapse { t: self.t, step: h }
                } else {
                    Failure::NotFinite { t: self.t }
                });
            }
            // A last step that would leave a sliver is made a little longer.
            let is_last = self.t + 1.01 * h >= end;
            if is_last {
                h = end - self.t;
            }
            self.try_step(h);
            let mut error = self.error(h);
            is_finite = error.is_finite();
            if let Some(tangent) = self.tangent.as_ref().filter(|_| error > 1.0) {
                let along = self.error_along(h, tangent);
                self.is_careful |= along < BESIDE * error;
                // Not before it has been rejected once: away from singular positions all errors say how accurate it is.
                error = if was_rejected { error.min(along) } else { error };
            }
            if error <= 1.0 {
                let factor = self.factor(error).clamp(SHRINK, GROW);
                self.accept(h, if is_last { end } else { self.t + h });
                // The end of the motion says nothing about the step that accuracy allows.
                let next = h * if was_rejected { factor.min(1.0) } else { factor };
                self.step = if is_last { next.max(self.step) } else { next };
                return Ok(());
            }
            let factor = if is_finite { SAFETY * error.powf(-1.0 / f64::from(ORDER)) } else { 0.1 };
            self.step = h * factor.clamp(if is_finite { SHRINK } else { 0.1 }, 1.0);
            self.statistics.rejected += 1;
            was_rejected = true;
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
        let x = (t - start) / h;
        for (i, y) in out.iter_mut().enumerate() {
            let term = |k: usize| self.dense[k][i];
            let sum = (0..7).rev().fold(0.0, |sum, k| (sum + term(k)) * if k % 2 == 0 { x } else { 1.0 - x });
            *y = self.before[i] + sum;
        }
        Ok(())
    }

    fn replace(&mut self, state: &[f64]) {
        self.state.copy_from_slice(state);
        self.is_fresh = false;
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
