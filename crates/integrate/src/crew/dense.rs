//! The dense output of the steps of all lanes: the same polynomials as those of a motion alone.

use crate::runge_kutta::{Tableau, between, hermite_terms, slope_between, terms};

use super::columns::read;
use super::stages::{StepColumns, combine};
use super::vectors::{Loop, in_vectors};

/// The terms of the dense output of the last step of each lane.
pub(super) struct Dense<const W: usize> {
    tableau: &'static Tableau,
    terms: Vec<Vec<[f64; W]>>,
}

impl<const W: usize> Dense<W> {
    pub fn new(tableau: &'static Tableau, entries: usize) -> Self {
        Self { tableau, terms: vec![vec![[0.0; W]; entries]; terms(tableau)] }
    }

    /// Compute the terms from the rates at all stages.
    pub fn prepare(&mut self, step: &StepColumns<W>) {
        in_vectors::<W>(Terms { tableau: self.tableau, step, out: &mut self.terms });
    }

    /// Write the states at an instant of each step, which ends at another one.
    pub fn states_at(
        &self,
        instants: [f64; W],
        ends: &[f64; W],
        step: &StepColumns<W>,
        state: &mut [[f64; W]],
    ) {
        in_vectors::<W>(States { instants, ends, step, terms: &self.terms, state });
    }

    /// Write the slopes at a fraction of each step.
    pub fn slopes_at(&self, x: f64, step: &StepColumns<W>, slopes: &mut [[f64; W]]) {
        in_vectors::<W>(Slopes { x, h: &step.h, terms: &self.terms, out: slopes });
    }

    /// Read the terms of one lane.
    pub fn read_terms(&self, lane: usize, terms: &mut [Vec<f64>]) {
        for (term, columns) in terms.iter_mut().zip(&self.terms) {
            read(lane, columns, term);
        }
    }
}

/// The terms of the dense output of a step.
struct Terms<'a, const W: usize> {
    tableau: &'static Tableau,
    step: &'a StepColumns<W>,
    out: &'a mut [Vec<[f64; W]>],
}

impl<const W: usize> Loop for Terms<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let Self { tableau, step, out } = self;
        let (hermite, higher) = out.split_at_mut(out.len() - tableau.dense.len());
        let [change, first, second] = hermite else { unreachable!("there are three terms") };
        let (rates, rates_at_end) = (step.rates(0), step.rates(tableau.stages));
        for i in 0..step.entries {
            for lane in 0..W {
                let ends = (step.before[i][lane], step.after[i][lane]);
                let slopes = (rates[i][lane], rates_at_end[i][lane]);
                (change[i][lane], first[i][lane], second[i][lane]) =
                    hermite_terms(step.h[lane], ends, slopes);
            }
        }
        for (terms, weights) in higher.iter_mut().zip(tableau.dense) {
            combine(terms, None, &step.rates, weights);
            for term in terms {
                for (entry, h) in term.iter_mut().zip(&step.h) {
                    // A motion alone adds the products to 0, which makes 0 of -0.
                    *entry = (0.0 + *entry) * h;
                }
            }
        }
    }
}

/// The states at an instant of each step.
struct States<'a, const W: usize> {
    instants: [f64; W],
    ends: &'a [f64; W],
    step: &'a StepColumns<W>,
    terms: &'a [Vec<[f64; W]>],
    state: &'a mut [[f64; W]],
}

impl<const W: usize> Loop for States<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let Self { instants, ends, step, terms, state } = self;
        let (mut parts, mut is_end) = ([0.0; W], [false; W]);
        for lane in 0..W {
            let (t, start, h) = (instants[lane], step.t[lane], step.h[lane]);
            parts[lane] = (t - start) / h;
            is_end[lane] = t >= ends[lane] || t >= start + h;
        }
        for (i, y) in state.iter_mut().enumerate() {
            let mut sums = [0.0; W];
            for (k, term) in terms.iter().enumerate().rev() {
                for lane in 0..W {
                    sums[lane] = between(sums[lane], term[i][lane], k, parts[lane]);
                }
            }
            for lane in 0..W {
                let inside = step.before[i][lane] + sums[lane];
                y[lane] = if is_end[lane] { step.after[i][lane] } else { inside };
            }
        }
    }
}

/// The slopes at a fraction of each step.
struct Slopes<'a, const W: usize> {
    x: f64,
    h: &'a [f64; W],
    terms: &'a [Vec<[f64; W]>],
    out: &'a mut [[f64; W]],
}

impl<const W: usize> Loop for Slopes<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let Self { x, h, terms, out } = self;
        for (i, out) in out.iter_mut().enumerate() {
            let mut sums = [(0.0, 0.0); W];
            for (k, term) in terms.iter().enumerate().rev() {
                for lane in 0..W {
                    sums[lane] = slope_between(sums[lane], term[i][lane], k, x);
                }
            }
            for lane in 0..W {
                out[lane] = sums[lane].1 / h[lane];
            }
        }
    }
}
