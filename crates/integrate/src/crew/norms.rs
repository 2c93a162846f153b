//! Sums of squares in all lanes, by which steps are judged: of distances, and of errors in units of the tolerance.

use crate::runge_kutta::{Tableau, in_tolerances, tolerance_of_integral, weight};
use crate::tolerances::Tolerances;

use super::stages::StepColumns;
use super::vectors::Loop;

/// The squares of the distances of rates, and of states; and a sum of zeros, which is NaN if a rate is not finite.
pub(super) struct Distances<'a, const W: usize> {
    pub rates: (&'a [[f64; W]], &'a [[f64; W]]),
    pub states: (&'a [[f64; W]], &'a [[f64; W]]),
    pub sums: (&'a mut [f64; W], &'a mut [f64; W]),
    pub zeros: &'a mut [f64; W],
}

impl<const W: usize> Loop for Distances<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        Zeros { rates: self.rates.0, out: self.zeros }.run();
        for ((a, b), sums) in [(self.rates, self.sums.0), (self.states, self.sums.1)] {
            let mut sum = [0.0; W];
            for (a, b) in a.iter().zip(b) {
                for lane in 0..W {
                    sum[lane] += (a[lane] - b[lane]) * (a[lane] - b[lane]);
                }
            }
            *sums = sum;
        }
    }
}

/// A sum of zeros, which is NaN if a rate is not finite.
pub(super) struct Zeros<'a, const W: usize> {
    pub rates: &'a [[f64; W]],
    pub out: &'a mut [f64; W],
}

impl<const W: usize> Loop for Zeros<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let mut zeros = [0.0; W];
        for rates in self.rates {
            for lane in 0..W {
                zeros[lane] += 0.0 * rates[lane];
            }
        }
        *self.out = zeros;
    }
}

/// The sums of the squares of vectors in units of the tolerance of states.
pub(super) struct Weighted<'a, const W: usize> {
    pub tolerances: Tolerances,
    pub vector: &'a [[f64; W]],
    pub states: &'a [[f64; W]],
    pub sums: &'a mut [f64; W],
}

impl<const W: usize> Loop for Weighted<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let mut sums = [0.0; W];
        for (entries, states) in self.vector.iter().zip(self.states).take(self.tolerances.controlled) {
            for lane in 0..W {
                let scaled = in_tolerances(&self.tolerances, entries[lane], states[lane]);
                sums[lane] += scaled * scaled;
            }
        }
        *self.sums = sums;
    }
}

/// The sums of the squares of the errors in units of the tolerance.
pub(super) struct Squares<'a, const W: usize> {
    pub tableau: &'static Tableau,
    pub tolerances: Tolerances,
    /// The largest magnitude or change of each integral so far.
    pub sizes: &'a [[f64; W]],
    pub step: &'a StepColumns<W>,
    pub sums: &'a mut [[f64; W]; 2],
}

impl<const W: usize> Loop for Squares<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let (tolerances, step) = (self.tolerances, self.step);
        let controlled = tolerances.controlled;
        let (mut squares, mut integrals) = ([[0.0; W]; 2], [[0.0; W]; 2]);
        for i in 0..controlled {
            let (before, after) = (step.before[i], step.after[i]);
            let mut weights = [0.0; W];
            for lane in 0..W {
                weights[lane] = weight(&tolerances, before[lane], after[lane]);
            }
            add_squares(&mut squares, &step.errors, i, &weights);
        }
        for i in controlled..step.entries {
            let (allowed, after, sizes) = (self.steepest(i), step.after[i], self.sizes[i]);
            let mut weights = [0.0; W];
            for lane in 0..W {
                weights[lane] = tolerance_of_integral(&tolerances, sizes[lane], after[lane], allowed[lane]);
            }
            divide_and_add_squares(&mut integrals, &step.errors, i, &weights);
        }
        for (out, (squares, integrals)) in self.sums.iter_mut().zip(squares.iter().zip(&integrals)) {
            for lane in 0..W {
                out[lane] = squares[lane] + integrals[lane];
            }
        }
    }
}

impl<const W: usize> Squares<'_, W> {
    /// The largest term of an integral in the steps.
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn steepest(&self, i: usize) -> [f64; W] {
        let (step, mut steepest) = (self.step, [0.0_f64; W]);
        for stage in 0..self.tableau.stages {
            let rates = step.rates[stage * step.entries + i];
            for lane in 0..W {
                steepest[lane] = steepest[lane].max(rates[lane].abs());
            }
        }
        for (steepest, h) in steepest.iter_mut().zip(&step.h) {
            *steepest *= h.abs();
        }
        steepest
    }
}

#[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
#[inline(always)]
fn add_squares<const W: usize>(
    squares: &mut [[f64; W]; 2],
    errors: &[Vec<[f64; W]>],
    i: usize,
    weights: &[f64; W],
) {
    for (squares, errors) in squares.iter_mut().zip(errors) {
        let error = errors[i];
        for lane in 0..W {
            let scaled = error[lane] * weights[lane];
            squares[lane] += scaled * scaled;
        }
    }
}

#[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
#[inline(always)]
fn divide_and_add_squares<const W: usize>(
    squares: &mut [[f64; W]; 2],
    errors: &[Vec<[f64; W]>],
    i: usize,
    allowed: &[f64; W],
) {
    for (squares, errors) in squares.iter_mut().zip(errors) {
        let error = errors[i];
        for lane in 0..W {
            let scaled = error[lane] / allowed[lane];
            squares[lane] += scaled * scaled;
        }
    }
}
