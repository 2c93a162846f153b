//! The explicit Runge–Kutta method of order 8(5, 3) by Dormand and Prince, with dense output of order 7.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., 1993: the method and its
//! error estimate in II.5, the first step and the choice of steps in II.4, the dense output in II.6, the recognition of
//! stiff problems in IV.2 of volume II.

mod coefficients;

use crate::dynamics::Dynamics;
use crate::failure::Failure;
use crate::function::Function;
use crate::method::Tolerances;
use crate::projection::Tangent;
use crate::stepper::{Statistics, Stepper};
use coefficients::{A, C, DENSE, ERRORS};

const STAGES: usize = 12;
const ORDER: i32 = 8;
/// Steps are chosen by the error of the last one and, a little, by that of the one before, so that few are rejected; these
/// two take a sixth fewer evaluations than 0.9 and 0 on a double pendulum and on Andrews' mechanism.
const SAFETY: f64 = 0.8;
const MEMORY: f64 = 0.04;
/// Smaller errors are remembered as this one.
const LEAST_ERROR: f64 = 1e-4;
const SHRINK: f64 = 0.333;
const GROW: f64 = 6.0;

/// The method in the midst of its work.
pub struct Dop853<'a> {
    rates: &'a Function,
    /// Where constraints let the speeds go, if they are kept by projection.
    tangent: Option<Tangent<'a>>,
    tolerances: Tolerances,
    t: f64,
    state: Vec<f64>,
    /// The next step to try.
    step: f64,
    /// The rates at the stages, one after another; the first are those at the state if `is_fresh`.
    stages: Vec<f64>,
    is_fresh: bool,
    /// The step before: its begin, its length, and its states at both ends.
    last: (f64, f64),
    before: Vec<f64>,
    after: Vec<f64>,
    /// The terms of the dense output, if they are those of the last step.
    dense: Vec<f64>,
    is_dense: bool,
    scratch: Vec<f64>,
    /// The state at which the last stage of the step before was evaluated.
    last_stage: Vec<f64>,
    /// The error of the step before, in units of the tolerance.
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
            tolerances,
            t,
            state: state.to_vec(),
            step: 0.0,
            stages: vec![0.0; 16 * n],
            is_fresh: false,
            last: (t, 0.0),
            before: state.to_vec(),
            after: state.to_vec(),
            dense: vec![0.0; 7 * n],
            is_dense: false,
            scratch: vec![0.0; n],
            last_stage: vec![0.0; n],
            last_error: LEAST_ERROR,
            stiff_steps: 0,
            statistics: Statistics::default(),
        };
        new.step = new.first_step(end);
        new
    }

    /// Guess the first step from the rates and their change.
    fn first_step(&mut self, end: f64) -> f64 {
        let n = self.state.len();
        let longest = self.tolerances.max_step.min(end - self.t);
        self.evaluate_first();
        let (size, rate) = (self.weighted(&self.state), self.weighted(&self.stages[..n]));
        let trial = if size < 1e-5 || rate < 1e-5 { 1e-6 } else { 0.01 * size / rate }.min(longest);
        self.stage(1, self.t + trial, |_, y, first| y + trial * first);
        let change: Vec<f64> = (0..n).map(|i| self.stages[n + i] - self.stages[i]).collect();
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
            let n = self.state.len();
            self.rates.call(self.t, &self.state, &mut self.stages[..n]);
            self.statistics.evaluations += 1;
            self.is_fresh = true;
        }
    }

    /// Evaluate a stage at states that follow from those at the begin and the first rates.
    fn stage(&mut self, place: usize, t: f64, at: impl Fn(usize, f64, f64) -> f64) {
        let n = self.state.len();
        for i in 0..n {
            self.scratch[i] = at(i, self.state[i], self.stages[i]);
        }
        self.rates.call(t, &self.scratch, &mut self.stages[place * n..][..n]);
        self.statistics.evaluations += 1;
    }

    /// Evaluate the stages of a step, and write the state at its end to `after`.
    fn try_step(&mut self, h: f64) {
        let n = self.state.len();
        for place in 1..STAGES {
            combine(&mut self.scratch, &self.state, h, A[place], &self.stages);
            self.rates.call(self.t + C[place] * h, &self.scratch, &mut self.stages[place * n..][..n]);
        }
        self.statistics.evaluations += STAGES - 1;
        combine(&mut self.after, &self.state, h, A[STAGES], &self.stages);
    }

    /// The error of the step in units of the tolerance; NaN if some stage has no finite rate.
    fn error(&self, h: f64) -> f64 {
        let n = self.state.len();
        let estimate =
            |i: usize| ERRORS.map(|row| row.iter().map(|&(j, e)| e * self.stages[j * n + i]).sum::<f64>());
        self.weighted_error(h, estimate)
    }

    /// The error without the part that the projection onto the constraints takes away after the step.
    ///
    /// Near a singular position, where a constraint nearly follows from others, rounding errors along it are large in
    /// the accelerations: they would let no step pass.
    fn error_along(&self, h: f64, tangent: &Tangent<'_>) -> f64 {
        let n = self.state.len();
        let [fifth, third] = ERRORS.map(|row| {
            let all = (0..n).map(|i| row.iter().map(|&(j, e)| e * self.stages[j * n + i]).sum::<f64>());
            tangent.part(self.t + h, &self.after, all.collect())
        });
        self.weighted_error(h, |i| [fifth[i], third[i]])
    }

    /// Both estimates of an error together, in units of the tolerance.
    fn weighted_error(&self, h: f64, estimate: impl Fn(usize) -> [f64; 2]) -> f64 {
        let Tolerances { relative, absolute, controlled, .. } = self.tolerances;
        let (mut fifth, mut third) = (0.0, 0.0);
        for i in 0..controlled {
            let scale = absolute + relative * self.state[i].abs().max(self.after[i].abs());
            let [e5, e3] = estimate(i).map(|error| error / scale);
            fifth += e5 * e5;
            third += e3 * e3;
        }
        let both = fifth + 0.01 * third;
        if both <= 0.0 { 0.0 } else { h.abs() * fifth / (both * count(controlled)).sqrt() }
    }

    /// The factor to the next step after one that is accepted, by proportional and integral control
    /// [Hairer & Wanner, volume II, IV.2].
    fn factor(&mut self, error: f64) -> f64 {
        let (now, before) = (error.max(f64::MIN_POSITIVE), self.last_error);
        self.last_error = error.max(LEAST_ERROR);
        SAFETY * now.powf(0.2 * MEMORY - 1.0 / f64::from(ORDER)) * before.powf(MEMORY)
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
        let n = self.state.len();
        let (mut rates, mut states) = (0.0, 0.0);
        for i in 0..n {
            rates += (self.stages[i] - self.stages[(STAGES - 1) * n + i]).powi(2);
            states += (self.state[i] - self.last_stage[i]).powi(2);
        }
        let is_at_bound = states > 0.0 && self.last.1 * (rates / states).sqrt() > BOUND;
        self.stiff_steps =
            if is_at_bound { self.stiff_steps + 1 } else { self.stiff_steps.saturating_sub(1) };
        self.statistics.stiff |= self.stiff_steps >= STEPS;
    }

    /// Compute the terms of the dense output of the last step.
    fn prepare_dense(&mut self) {
        let n = self.state.len();
        let (t, h) = self.last;
        self.rates.call(t + h, &self.after, &mut self.stages[STAGES * n..][..n]);
        for place in STAGES + 1..C.len() {
            combine(&mut self.scratch, &self.before, h, A[place], &self.stages);
            self.rates.call(t + C[place] * h, &self.scratch, &mut self.stages[place * n..][..n]);
        }
        self.statistics.evaluations += C.len() - STAGES;
        for i in 0..n {
            let change = self.after[i] - self.before[i];
            let (first, end) = (h * self.stages[i], h * self.stages[STAGES * n + i]);
            self.dense[i] = change;
            self.dense[n + i] = first - change;
            self.dense[2 * n + i] = 2.0 * change - first - end;
            for (k, row) in DENSE.iter().enumerate() {
                self.dense[(3 + k) * n + i] =
                    h * row.iter().map(|&(j, d)| d * self.stages[j * n + i]).sum::<f64>();
            }
        }
        self.is_dense = true;
    }
}

impl Stepper for Dop853<'_> {
    fn step(&mut self, end: f64) -> Result<(), Failure> {
        self.evaluate_first();
        if !self.stages[..self.state.len()].iter().all(|rate| rate.is_finite()) {
            return Err(Failure::NotFinite { t: self.t });
        }
        if self.statistics.steps > 0 {
            self.note_stiffness();
        }
        let (mut is_finite, mut was_rejected) = (true, false);
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
            // Not before it has been rejected once: away from singular positions all errors say how accurate it is.
            if let Some(tangent) = self.tangent.as_ref().filter(|_| was_rejected && error > 1.0) {
                error = error.min(self.error_along(h, tangent));
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
        let n = out.len();
        if t >= self.t || t >= start + h {
            out.copy_from_slice(&self.after);
            return Ok(());
        }
        if !self.is_dense {
            self.prepare_dense();
        }
        let x = (t - start) / h;
        for (i, y) in out.iter_mut().enumerate() {
            let term = |k: usize| self.dense[k * n + i];
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

/// Write `base + h * sum of weights times stages`, four entries at a time: their sums stay in registers.
fn combine(out: &mut [f64], base: &[f64], h: f64, weights: &[(usize, f64)], stages: &[f64]) {
    const LANES: usize = 4;
    let n = out.len();
    let mut first = 0;
    while first + LANES <= n {
        let mut sums = [0.0; LANES];
        for &(place, weight) in weights {
            let rates = &stages[place * n + first..][..LANES];
            for (sum, rate) in sums.iter_mut().zip(rates) {
                *sum += weight * rate;
            }
        }
        for (lane, sum) in sums.iter().enumerate() {
            out[first + lane] = base[first + lane] + h * sum;
        }
        first += LANES;
    }
    for i in first..n {
        let sum: f64 = weights.iter().map(|&(place, weight)| weight * stages[place * n + i]).sum();
        out[i] = base[i] + h * sum;
    }
}
