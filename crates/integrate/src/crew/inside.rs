//! What lanes see inside of the steps that they accept, where events are looked for: the dense output, and the functions
//! of the events in it. With constraints, a step whose dense output may be noise is left to its motion.

use crate::dynamics::EventKind;
use crate::runge_kutta::Tableau;
use crate::tolerances::Tolerances;

use super::columns::{Columns, Waiting};
use super::crossings::Crossings;
use super::defect::Defects;
use super::dense::Dense;
use super::landing::{Chosen, Corrections, Landings};
use super::norms::Zeros;
use super::stages::StepColumns;
use super::vectors::in_vectors;

/// The dense output of the last steps, and the events in them.
pub(super) struct Inside<const W: usize> {
    tableau: &'static Tableau,
    pub dense: Dense<W>,
    pub crossings: Crossings<W>,
    /// For methods whose dense output has stages of its own.
    defects: Option<Defects<W>>,
}

impl<const W: usize> Inside<W> {
    pub fn new(
        tableau: &'static Tableau,
        tolerances: Tolerances,
        kinds: &[EventKind],
        entries: usize,
    ) -> Self {
        let has_own_stages = tableau.c.len() > tableau.stages + 1;
        Self {
            tableau,
            dense: Dense::new(tableau, entries),
            crossings: Crossings::new(kinds, tolerances),
            defects: has_own_stages.then(|| Defects::new(tolerances, entries)),
        }
    }

    /// Look into accepted steps, which end at these instants. Return those that are still accepted: all states in them
    /// are on the constraints, and their dense output satisfies the equations.
    pub fn look(
        &mut self,
        (accepted, ends): (&[bool; W], &[f64; W]),
        step: &mut StepColumns<W>,
        (rates, events): (&mut Columns<W>, &mut Columns<W>),
        (landings, corrections): (Option<&Landings<W>>, &mut Corrections<'_, W>),
        waiting: &mut Waiting<'_, W>,
    ) -> [bool; W] {
        let mut accepted = self.take_stages(accepted, step, rates, (landings, corrections), waiting);
        self.dense.prepare(step);
        if let Some((defects, landings)) = self.defects.as_mut().zip(landings) {
            let place = (&accepted, ends);
            accepted = defects.are_small(place, (step, &self.dense), rates, (landings, corrections), waiting);
        }
        let place = (&accepted, ends);
        self.crossings.find(place, (step, &self.dense), events, (landings, corrections), waiting)
    }

    /// Evaluate the stages of the dense output, each on the constraints; return the steps where that is possible.
    fn take_stages(
        &self,
        accepted: &[bool; W],
        step: &mut StepColumns<W>,
        rates: &mut Columns<W>,
        (landings, corrections): (Option<&Landings<W>>, &mut Corrections<'_, W>),
        waiting: &mut Waiting<'_, W>,
    ) -> [bool; W] {
        let first = self.tableau.stages;
        let mut lanes = *accepted;
        for place in first..self.tableau.c.len() {
            let (stage, instants) = step.dense_stage(place, self.tableau, rates);
            match landings {
                Some(landings) if place == first => stage.copy_from_slice(&landings.states),
                Some(landings) => {
                    let bounds = &[f64::INFINITY; W];
                    let chosen = Chosen { lanes: &lanes, instants: &instants, bounds };
                    lanes = landings.project(stage, chosen, corrections, waiting);
                }
                None => {}
            }
            step.evaluate(place, instants, rates, &mut Waiting { lanes, noted: &mut *waiting.noted });
        }
        if landings.is_some() {
            let mut zeros = [0.0; W];
            in_vectors::<W>(Zeros { rates: &step.rates[first * step.entries..], out: &mut zeros });
            lanes = std::array::from_fn(|lane| lanes[lane] && !zeros[lane].is_nan());
        }
        lanes
    }

    /// The evaluations of the rates in a step of a motion.
    pub fn evaluations(&self, keeps_constraints: bool) -> usize {
        let in_the_middle = keeps_constraints && self.defects.is_some();
        self.tableau.c.len() - self.tableau.stages + usize::from(in_the_middle)
    }
}
