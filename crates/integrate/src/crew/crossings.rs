//! The steps in which an event may happen, found for all lanes at once: the functions of the events are evaluated in
//! the dense output of accepted steps, at the same instants as those of a motion alone, and on the constraints.

use crate::dynamics::EventKind;
use crate::event::crosses;
use crate::excursion::{may_pass, noise, three};
use crate::part::{PARTS, end_of_part};
use crate::tolerances::Tolerances;

use super::columns::{Columns, Waiting, read};
use super::dense::Dense;
use super::landing::{Chosen, Corrections, Landings};
use super::stages::StepColumns;
use super::vectors::{Loop, blend, in_vectors};

/// The functions of the events along the steps of all lanes.
pub(super) struct Crossings<const W: usize> {
    directions: Vec<i32>,
    tolerances: Tolerances,
    /// Whether some function may pass zero in the last step of each motion.
    pub found: [bool; W],
    /// Whether the values at the end of the last step of each motion are known.
    is_known: [bool; W],
    values: Vec<[f64; W]>,
    /// The values at the start of the step and at the ends of its parts, one after another.
    parts: Vec<Vec<[f64; W]>>,
}

impl<const W: usize> Crossings<W> {
    pub fn new(kinds: &[EventKind], tolerances: Tolerances) -> Self {
        Self {
            tolerances,
            directions: kinds.iter().map(|kind| kind.direction).collect(),
            found: [false; W],
            is_known: [false; W],
            values: vec![[0.0; W]; kinds.len()],
            parts: vec![vec![[0.0; W]; kinds.len()]; 1 + PARTS],
        }
    }

    /// Begin another motion in a lane.
    pub fn begin(&mut self, lane: usize) {
        self.is_known[lane] = false;
    }

    /// Note in which of the accepted steps, which end at these instants, some function may pass zero. Return the steps in
    /// which all states are on the constraints.
    pub fn find(
        &mut self,
        (accepted, ends): (&[bool; W], &[f64; W]),
        (step, dense): (&StepColumns<W>, &Dense<W>),
        function: &mut Columns<W>,
        (landings, corrections): (Option<&Landings<W>>, &mut Corrections<'_, W>),
        waiting: &mut Waiting<'_, W>,
    ) -> [bool; W] {
        self.evaluate_starts(accepted, step, function, waiting);
        self.parts[0].copy_from_slice(&self.values);
        let (mut found, mut accepted) = ([false; W], *accepted);
        for part in 1..=PARTS {
            let instants = std::array::from_fn(|lane| end_of_part(part, step.t[lane], ends[lane]));
            let state = &mut function.inputs[1..=step.entries];
            match landings {
                Some(landings) if part == PARTS => state.copy_from_slice(&landings.states),
                _ => dense.states_at(instants, ends, step, state),
            }
            if let Some(landings) = landings.filter(|_| part < PARTS) {
                let chosen = Chosen { lanes: &accepted, instants: &instants, bounds: &landings.bounds };
                accepted = landings.project(state, chosen, corrections, waiting);
            }
            function.inputs[0] = instants;
            function.evaluate(&mut Waiting { lanes: accepted, noted: &mut *waiting.noted });
            self.parts[part].copy_from_slice(&function.outputs);
        }
        let Self { directions, tolerances, parts, .. } = self;
        in_vectors::<W>(Signs { directions, tolerances, parts, found: &mut found });
        for (values, last) in self.values.iter_mut().zip(&self.parts[PARTS]) {
            blend(values, last, &accepted);
        }
        self.found = std::array::from_fn(|lane| accepted[lane] && found[lane]);
        accepted
    }

    /// Read the values at the end of the last step.
    pub fn read_end(&self, lane: usize, values: &mut [f64]) {
        read(lane, &self.values, values);
    }

    /// Read the values at the start of the last step, and at the ends of its parts, one after another.
    pub fn read_values(&self, lane: usize, start: &mut [f64], ends: &mut [f64]) {
        read(lane, &self.parts[0], start);
        for (ends, values) in ends.chunks_mut(start.len()).zip(&self.parts[1..]) {
            read(lane, values, ends);
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

/// The search for functions that pass zero in their directions, or that may pass it and come back.
struct Signs<'a, const W: usize> {
    directions: &'a [i32],
    tolerances: &'a Tolerances,
    parts: &'a [Vec<[f64; W]>],
    found: &'a mut [bool; W],
}

impl<const W: usize> Loop for Signs<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let Self { directions, tolerances, parts, found } = self;
        for (event, direction) in directions.iter().enumerate() {
            let mut most = [0.0_f64; W];
            for values in parts {
                for lane in 0..W {
                    most[lane] = most[lane].max(values[event][lane].abs());
                }
            }
            for two in parts.windows(2) {
                for lane in 0..W {
                    found[lane] |= crosses(two[0][event][lane], two[1][event][lane], *direction);
                }
            }
            for (place, here) in parts.iter().enumerate() {
                let [a, b, c] = three(place).map(|place| &parts[place][event]);
                for lane in 0..W {
                    let noise = noise(most[lane], tolerances);
                    found[lane] |= may_pass([a[lane], b[lane], c[lane]], here[event][lane], noise);
                }
            }
        }
    }
}
