//! The dense output: states between the ends of the last step [Hairer, Nørsett & Wanner 1993, II.6].
//!
//! `y(x) = y0 + x (F0 + (1 - x) (F1 + x (F2 + (1 - x) (F3 + ...))))`: the first three terms are the cubic Hermite
//! polynomial, the others come from the tableau.

use crate::lane::Lane;

use super::tableau::Tableau;
use super::{RungeKutta, is_finite};

/// The number of terms of the dense output that form its cubic Hermite polynomial.
const HERMITE: usize = 3;

/// The number of terms of the dense output of a method.
pub(crate) fn terms(tableau: &Tableau) -> usize {
    HERMITE + tableau.dense.len()
}

/// The terms of the cubic Hermite polynomial of an entry, for its values and its rates at the ends of a step.
#[allow(clippy::inline_always, reason = "loops over lanes are compiled for the vectors of their caller")]
#[inline(always)]
pub(crate) fn hermite_terms(
    h: f64,
    (before, after): (f64, f64),
    (first, last): (f64, f64),
) -> (f64, f64, f64) {
    let (start, end, change) = (h * first, h * last, after - before);
    (change, start - change, 2.0 * change - start - end)
}

/// Add term number k to the sum of the later terms, at a fraction of the step.
#[allow(clippy::inline_always, reason = "loops over lanes are compiled for the vectors of their caller")]
#[inline(always)]
pub(crate) fn between(sum: f64, term: f64, k: usize, x: f64) -> f64 {
    (sum + term) * if k.is_multiple_of(2) { x } else { 1.0 - x }
}

/// The same for the sum of the later terms and its slope.
#[allow(clippy::inline_always, reason = "loops over lanes are compiled for the vectors of their caller")]
#[inline(always)]
pub(crate) fn slope_between((sum, slope): (f64, f64), term: f64, k: usize, x: f64) -> (f64, f64) {
    let (factor, sign) = if k.is_multiple_of(2) { (x, 1.0) } else { (1.0 - x, -1.0) };
    ((sum + term) * factor, slope * factor + sign * (sum + term))
}

impl RungeKutta<'_> {
    /// Evaluate the stages of the dense output of the last step.
    fn add_stages(&mut self) {
        let ((t, h), &Tableau { stages, c, a, .. }) = (self.last, self.tableau);
        if let Some(lane) = self.free_lane().filter(Lane::has_dense_stages) {
            for place in stages..c.len() {
                lane.read_rates(place, self.stages.row_mut(place));
            }
            self.statistics.evaluations += c.len() - stages;
            return;
        }
        self.scratch.copy_from_slice(&self.after);
        self.evaluate(stages, t + h);
        for place in stages + 1..c.len() {
            self.stages.step(&mut self.scratch, &self.before, h, a[place]);
            self.evaluate(place, t + c[place] * h);
        }
    }

    /// Compute the terms of the dense output of the last step.
    pub(super) fn prepare_dense(&mut self) {
        if let Some(lane) = self.rates.lane().filter(|_| self.has_crossing.is_some()) {
            lane.read_terms(&mut self.dense);
            self.is_dense = true;
            return;
        }
        self.fetch_rates();
        self.is_careful = self.projection.is_needed();
        self.add_stages();
        let &Tableau { stages, c, .. } = self.tableau;
        if self.is_careful && (stages..c.len()).any(|stage| !is_finite(self.stages.row(stage))) {
            self.is_careful = false;
            self.add_stages();
        }
        let (_, h) = self.last;
        let (hermite, higher) = self.dense.split_at_mut(HERMITE);
        let [change, first, second] = hermite else { unreachable!("there are three terms") };
        for i in 0..self.after.len() {
            let slopes = (self.stages.row(0)[i], self.stages.row(stages)[i]);
            (change[i], first[i], second[i]) = hermite_terms(h, (self.before[i], self.after[i]), slopes);
        }
        for (terms, weights) in higher.iter_mut().zip(self.tableau.dense) {
            self.stages.sum(terms, weights);
            for term in terms {
                *term *= h;
            }
        }
        self.is_dense = true;
    }

    /// Write the state at a fraction of the last step.
    pub(super) fn value(&self, x: f64, out: &mut [f64]) {
        for (i, y) in out.iter_mut().enumerate() {
            let terms = self.dense.iter().enumerate().rev();
            let sum = terms.fold(0.0, |sum, (k, terms)| between(sum, terms[i], k, x));
            *y = self.before[i] + sum;
        }
    }

    /// The rates of the dense output at a fraction of the last step.
    pub(super) fn slopes(&self, x: f64) -> Vec<f64> {
        let h = self.last.1;
        let slope = |i: usize| {
            let terms = self.dense.iter().enumerate().rev();
            let (_, slope) = terms.fold((0.0, 0.0), |sums, (k, terms)| slope_between(sums, terms[i], k, x));
            slope / h
        };
        (0..self.after.len()).map(slope).collect()
    }
}
