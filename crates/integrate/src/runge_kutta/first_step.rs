//! The length of the first step [Hairer, Nørsett, Wanner 1993, II.4].

use super::RungeKutta;
use super::error::difference;

impl RungeKutta<'_> {
    /// Guess the first step from the rates and their change.
    pub(super) fn first_step(&mut self, end: f64) -> f64 {
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
}
