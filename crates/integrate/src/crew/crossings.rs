//! The steps in which an event may happen, found for all lanes at once: the functions of the events are evaluated in
//! the dense output of accepted steps, at the same instants as those of a motion alone.

use crate::dynamics::EventKind;
use crate::event::{PARTS, crosses, end_of_part};
use crate::runge_kutta::{Tableau, between, hermite_terms, terms};

use super::columns::{Columns, Waiting, read};
use super::stages::{StepColumns, combine};
use super::vectors::{Loop, blend, in_vectors};

/// The functions of the events along the steps of all lanes.
pub(super) struct Crossings<const W: usize> {
    tableau: &'static Tableau,
    directions: Vec<i32>,
    /// Whether some function passes zero in the last step of each motion.
    pub found: [bool; W],
    /// Whether the values at the end of the last step of each motion are known.
    is_known: [bool; W],
    values: Vec<[f64; W]>,
    /// The values at the start of the step and at the ends of its parts, one after another.
    parts: Vec<Vec<[f64; W]>>,
    /// The terms of the dense output of the step.
    terms: Vec<Vec<[f64; W]>>,
}

impl<const W: usize> Crossings<W> {
    pub fn new(tableau: &'static Tableau, kinds: &[EventKind], entries: usize) -> Self {
        Self {
            tableau,
            directions: kinds.iter().map(|kind| kind.direction).collect(),
            found: [false; W],
            is_known: [false; W],
            values: vec![[0.0; W]; kinds.len()],
            parts: vec![vec![[0.0; W]; kinds.len()]; 1 + PARTS as usize],
            terms: vec![vec![[0.0; W]; entries]; terms(tableau)],
        }
    }

    /// Begin another motion in a lane.
    pub fn begin(&mut self, lane: usize) {
        self.is_known[lane] = false;
    }

    /// Note in which of the accepted steps, which end at these instants, some function passes zero.
    pub fn find(
        &mut self,
        (accepted, ends): (&[bool; W], &[f64; W]),
        step: &StepColumns<W>,
        function: &mut Columns<W>,
        waiting: &mut Waiting<'_, W>,
    ) {
        self.evaluate_starts(accepted, step, function, waiting);
        in_vectors::<W>(Terms { tableau: self.tableau, step, out: &mut self.terms });
        self.parts[0].copy_from_slice(&self.values);
        let mut found = [false; W];
        for part in 1..=PARTS {
            let instants = std::array::from_fn(|lane| end_of_part(part, step.t[lane], ends[lane]));
            function.inputs[0] = instants;
            let state = &mut function.inputs[1..=step.entries];
            in_vectors::<W>(States { instants, ends, step, terms: &self.terms, state });
            function.evaluate(&mut Waiting { lanes: *accepted, noted: &mut *waiting.noted });
            let (earlier, later) = self.parts.split_at_mut(part as usize);
            let (before, after) = (&earlier[part as usize - 1], &mut later[0]);
            after.copy_from_slice(&function.outputs);
            in_vectors::<W>(Signs { directions: &self.directions, before, after, found: &mut found });
        }
        for (values, last) in self.values.iter_mut().zip(&self.parts[PARTS as usize]) {
            blend(values, last, accepted);
        }
        self.found = std::array::from_fn(|lane| accepted[lane] && found[lane]);
    }

    /// Read the values at the start of the last step, and at the ends of its parts, one after another.
    pub fn read_values(&self, lane: usize, start: &mut [f64], ends: &mut [f64]) {
        read(lane, &self.parts[0], start);
        for (ends, values) in ends.chunks_mut(start.len()).zip(&self.parts[1..]) {
            read(lane, values, ends);
        }
    }

    /// Read the terms of the dense output of the last step.
    pub fn read_terms(&self, lane: usize, terms: &mut [Vec<f64>]) {
        for (term, columns) in terms.iter_mut().zip(&self.terms) {
            read(lane, columns, term);
        }
    }

    /// Write the values at the starts of the first steps.
    fn evaluate_starts(
        &mut self,
        accepted: &[bool; W],
        step: &StepColumns<W>,
        function: &mut Columns<W>,
        waiting: &mut Waiting<'_, W>,
    ) {
        let is_new = std::array::from_fn(|lane| accepted[lane] && !self.is_known[lane]);
        if !is_new.contains(&true) {
            return;
        }
        function.inputs[0] = step.t;
        function.inputs[1..=step.entries].copy_from_slice(&step.before);
        function.evaluate(&mut Waiting { lanes: is_new, noted: &mut *waiting.noted });
        for (values, first) in self.values.iter_mut().zip(&function.outputs) {
            blend(values, first, &is_new);
        }
        for (is_known, is_new) in self.is_known.iter_mut().zip(is_new) {
            *is_known |= is_new;
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

/// The search for functions that pass zero in their directions.
struct Signs<'a, const W: usize> {
    directions: &'a [i32],
    before: &'a [[f64; W]],
    after: &'a [[f64; W]],
    found: &'a mut [bool; W],
}

impl<const W: usize> Loop for Signs<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let Self { directions, before, after, found } = self;
        for ((before, after), direction) in before.iter().zip(after).zip(directions) {
            for lane in 0..W {
                found[lane] |= crosses(before[lane], after[lane], *direction);
            }
        }
    }
}
