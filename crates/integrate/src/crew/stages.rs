//! The stages of one step of an explicit Runge–Kutta method, of a motion in each lane: each has its own time and step.

use crate::runge_kutta::Tableau;

use super::columns::{Columns, Waiting};
use super::vectors::{Loop, in_vectors};

/// A step of each lane.
pub(super) struct StepColumns<const W: usize> {
    pub entries: usize,
    pub t: [f64; W],
    pub h: [f64; W],
    pub before: Vec<[f64; W]>,
    pub after: Vec<[f64; W]>,
    /// The state at which the last stage was evaluated.
    pub last_stage: Vec<[f64; W]>,
    /// The rates at the stages, at the end of the step, and at the stages of the dense output, one after another.
    pub rates: Vec<[f64; W]>,
    /// The estimates of the error.
    pub errors: Vec<Vec<[f64; W]>>,
}

impl<const W: usize> StepColumns<W> {
    pub fn new(tableau: &Tableau, entries: usize) -> Self {
        let zeros = |rows| vec![[0.0; W]; rows * entries];
        Self {
            entries,
            t: [0.0; W],
            h: [0.0; W],
            before: zeros(1),
            after: zeros(1),
            last_stage: zeros(1),
            rates: zeros(tableau.c.len()),
            errors: tableau.errors.iter().map(|_| zeros(1)).collect(),
        }
    }

    /// The rates at a stage.
    pub fn rates(&self, stage: usize) -> &[[f64; W]] {
        &self.rates[stage * self.entries..][..self.entries]
    }

    /// Evaluate the rates at the states before the step, which are those of the first stage.
    pub fn take_first(&mut self, function: &mut Columns<W>, waiting: &mut Waiting<'_, W>) {
        function.inputs[1..=self.entries].copy_from_slice(&self.before);
        self.evaluate(0, self.t, function, waiting);
    }

    /// Evaluate the other stages of a step, the states after it, and the errors.
    pub fn take(&mut self, tableau: &Tableau, function: &mut Columns<W>, waiting: &mut Waiting<'_, W>) {
        let n = self.entries;
        for place in 1..tableau.stages {
            let stage = &mut function.inputs[1..=n];
            combine(stage, Some((&self.before, &self.h)), &self.rates, tableau.a[place]);
            self.evaluate(place, self.instants(tableau.c[place]), function, waiting);
        }
        self.last_stage.copy_from_slice(&function.inputs[1..=n]);
        combine(&mut self.after, Some((&self.before, &self.h)), &self.rates, tableau.a[tableau.stages]);
        if tableau.evaluates_end {
            function.inputs[1..=n].copy_from_slice(&self.after);
            self.evaluate(tableau.stages, self.instants(1.0), function, waiting);
        }
        for (error, weights) in self.errors.iter_mut().zip(tableau.errors) {
            combine(error, None, &self.rates, weights);
        }
    }

    /// Evaluate the stages of the dense output of a step.
    pub fn take_dense(&mut self, tableau: &Tableau, function: &mut Columns<W>, waiting: &mut Waiting<'_, W>) {
        for place in tableau.stages..tableau.c.len() {
            let (_, instants) = self.dense_stage(place, tableau, function);
            self.evaluate(place, instants, function, waiting);
        }
    }

    /// Write the state at a stage of the dense output, the first of which is the end of the step; return it and the
    /// instants.
    pub fn dense_stage<'a>(
        &self,
        place: usize,
        tableau: &Tableau,
        function: &'a mut Columns<W>,
    ) -> (&'a mut [[f64; W]], [f64; W]) {
        let stage = &mut function.inputs[1..=self.entries];
        if place == tableau.stages {
            stage.copy_from_slice(&self.after);
            return (stage, self.instants(1.0));
        }
        combine(stage, Some((&self.before, &self.h)), &self.rates, tableau.a[place]);
        (stage, self.instants(tableau.c[place]))
    }

    /// The instants at a fraction of the steps.
    fn instants(&self, c: f64) -> [f64; W] {
        std::array::from_fn(|lane| self.t[lane] + c * self.h[lane])
    }

    /// Evaluate the rates at a stage, whose state is among the inputs of the function.
    pub fn evaluate(
        &mut self,
        place: usize,
        instants: [f64; W],
        function: &mut Columns<W>,
        waiting: &mut Waiting<'_, W>,
    ) {
        function.inputs[0] = instants;
        function.evaluate_into(&mut self.rates[place * self.entries..][..self.entries], waiting);
    }
}

/// Write `base + h * sum of weights times rows`, or the sum alone. Nothing is fused: the numbers are those of a motion
/// that is integrated alone.
pub(super) fn combine<const W: usize>(
    out: &mut [[f64; W]],
    base: Option<(&[[f64; W]], &[f64; W])>,
    rows: &[[f64; W]],
    weights: &[(usize, f64)],
) {
    in_vectors::<W>(Combination { out, base, rows, weights });
}

struct Combination<'a, const W: usize> {
    out: &'a mut [[f64; W]],
    base: Option<(&'a [[f64; W]], &'a [f64; W])>,
    rows: &'a [[f64; W]],
    weights: &'a [(usize, f64)],
}

/// How many entries are summed at a time: their sums stay in registers, and one waits for no other.
const TOGETHER: usize = 4;

impl<const W: usize> Loop for Combination<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(mut self) {
        let mut entry = 0;
        while entry + TOGETHER <= self.out.len() {
            self.write::<TOGETHER>(entry);
            entry += TOGETHER;
        }
        while entry < self.out.len() {
            self.write::<1>(entry);
            entry += 1;
        }
    }
}

impl<const W: usize> Combination<'_, W> {
    /// Write some entries. The numbers of a vector are copied before they change, which keeps it in a register.
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn write<const N: usize>(&mut self, first: usize) {
        let entries = self.out.len();
        let mut sums = [[0.0; W]; N];
        for &(stage, weight) in self.weights {
            let rates = &self.rows[stage * entries + first..][..N];
            for (sums, rates) in sums.iter_mut().zip(rates) {
                for (sum, rate) in sums.iter_mut().zip(rates) {
                    *sum += weight * rate;
                }
            }
        }
        if let Some((base, h)) = self.base {
            let h = *h;
            for (sums, starts) in sums.iter_mut().zip(&base[first..][..N]) {
                for lane in 0..W {
                    sums[lane] = starts[lane] + h[lane] * sums[lane];
                }
            }
        }
        self.out[first..][..N].copy_from_slice(&sums);
    }
}
