//! The error by which a step is judged, in units of the tolerance.

use super::{RungeKutta, count, error_of_step, in_tolerances, tolerance_of_integral, weight};
use crate::projection::Tangent;

/// If at most this fraction of an error is along the constraints, stages are projected onto them.
pub(super) const BESIDE: f64 = 0.01;

impl RungeKutta<'_> {
    /// The root mean square of a vector in units of the tolerance.
    pub(super) fn weighted(&self, vector: &[f64]) -> f64 {
        let controlled = self.tolerances.controlled;
        let states = vector.iter().zip(&self.state).take(controlled);
        let sum: f64 = states.map(|(v, y)| in_tolerances(&self.tolerances, *v, *y).powi(2)).sum();
        (sum / count(controlled)).sqrt()
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
    pub(super) fn error_that_counts(&mut self, h: f64, was_rejected: bool) -> f64 {
        let error = self.error(h);
        let Some(tangent) = self.tangent.as_ref().filter(|_| error > 1.0) else { return error };
        let along = self.error_along(h, tangent);
        if along < BESIDE * error {
            self.is_careful = true;
            self.regular = self.regular.max(h);
        }
        if was_rejected { error.min(along) } else { error }
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
}

pub(super) fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x - y).collect()
}
