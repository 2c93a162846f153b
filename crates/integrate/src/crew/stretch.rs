//! Accepted steps, one after another, of a motion without constraints in each lane: the control of a motion alone, in
//! vectors. A lane stops where its motion looks at a step.

use crate::failure::Failure;
use crate::lane::{Arrival, Beginning};
use crate::runge_kutta::{Tableau, error_of_step, note_stiffness, steepness};
use crate::stepper::{Statistics, Stretch};
use crate::tolerances::Tolerances;

use super::columns::{Columns, Waiting, read, write};
use super::control::Control;
use super::crossings::Crossings;
use super::norms::{Distances, Squares};
use super::stages::StepColumns;
use super::vectors::{Loop, in_vectors};

/// The steps of all lanes.
pub(super) struct Stretches<const W: usize> {
    tableau: &'static Tableau,
    tolerances: Tolerances,
    lanes: Vec<Option<Control>>,
    /// The states at the starts of the last steps that were accepted.
    starts: Vec<[f64; W]>,
    /// The largest magnitude or change of each integral so far, and the states at the start of the motions.
    sizes: Vec<[f64; W]>,
    origins: Vec<[f64; W]>,
    /// The state and the rates at the last stage of the last step that was accepted.
    last_stage: Vec<[f64; W]>,
    last_rates: Vec<[f64; W]>,
    has_dense_stages: bool,
    crossings: Option<Crossings<W>>,
}

impl<const W: usize> Stretches<W> {
    pub fn new(
        tableau: &'static Tableau,
        tolerances: Tolerances,
        entries: usize,
        crossings: Option<Crossings<W>>,
    ) -> Self {
        let zeros = || vec![[0.0; W]; entries];
        Self {
            tableau,
            tolerances,
            lanes: vec![None; W],
            starts: zeros(),
            sizes: zeros(),
            origins: zeros(),
            last_stage: zeros(),
            last_rates: zeros(),
            has_dense_stages: false,
            crossings,
        }
    }

    pub fn begin(&mut self, lane: usize, beginning: &Beginning<'_>, step: &mut StepColumns<W>) {
        let state = beginning.state;
        write(lane, state, &mut step.before);
        write(lane, beginning.rates, &mut step.rates);
        write(lane, state, &mut self.origins);
        for (sizes, x) in self.sizes.iter_mut().zip(state) {
            sizes[lane] = x.abs();
        }
        self.lanes[lane] = Some(Control::new(beginning));
        if let Some(crossings) = &mut self.crossings {
            crossings.begin(lane);
        }
    }

    pub fn put(&mut self, lane: usize, stretch: Stretch, statistics: Statistics) {
        if let Some(control) = &mut self.lanes[lane] {
            (control.stretch, control.statistics) = (stretch, statistics);
        }
    }

    pub fn arrival(
        &self,
        lane: usize,
        before: &mut [f64],
        after: &mut [f64],
        step: &StepColumns<W>,
    ) -> Arrival {
        let control = self.lanes[lane].as_ref().expect("a motion that has begun");
        read(lane, &self.starts, before);
        read(lane, &step.before, after);
        Arrival {
            last: control.last,
            t: control.t,
            statistics: control.statistics,
            has_crossing: self.crossings.as_ref().map(|crossings| crossings.found[lane]),
            failure: control.failure.clone(),
        }
    }

    pub fn has_dense_stages(&self) -> bool {
        self.has_dense_stages
    }

    /// What is known of events in the steps; each stretch ends with the first in which one may happen.
    pub fn crossings(&self) -> Option<&Crossings<W>> {
        self.crossings.as_ref()
    }

    /// Try a step of each lane that is not waiting for its motion, and return which lanes now do.
    pub fn take(
        &mut self,
        step: &mut StepColumns<W>,
        (function, events): (&mut Columns<W>, Option<&mut Columns<W>>),
        waiting: &mut Waiting<'_, W>,
    ) -> [bool; W] {
        self.take_first(step, function, waiting);
        self.check_first(step, waiting);
        self.choose_lengths(step, waiting);
        step.take(self.tableau, function, waiting);
        let errors = self.errors(step);
        let accepted = self.decide(&errors, step, waiting);
        self.add_dense_stages(&accepted, step, function, waiting);
        if let Some(events) = events {
            self.look_for_events(&accepted, step, events, waiting);
        }
        let has_crossing = self.crossings.as_ref().map_or([false; W], |crossings| crossings.found);
        let is_over: [bool; W] = std::array::from_fn(|lane| {
            let is_over = self.lanes[lane].as_ref().is_none_or(Control::is_over);
            waiting.lanes[lane] && (is_over || has_crossing[lane])
        });
        self.move_on(accepted, step);
        is_over
    }

    /// Write the rates at the starts of the steps; those at the end of the step before, if the method has evaluated them.
    fn take_first(
        &mut self,
        step: &mut StepColumns<W>,
        function: &mut Columns<W>,
        waiting: &mut Waiting<'_, W>,
    ) {
        let mut is_new = [false; W];
        for (lane, control) in self.lanes.iter_mut().enumerate() {
            let Some(control) = control.as_mut().filter(|_| waiting.lanes[lane]) else { continue };
            step.t[lane] = control.t;
            is_new[lane] = !control.was_rejected && control.statistics.steps > 0;
        }
        if !self.tableau.evaluates_end {
            for (control, is_new) in self.lanes.iter_mut().zip(is_new) {
                if let Some(control) = control {
                    control.statistics.evaluations += usize::from(is_new);
                }
            }
            return step.take_first(function, waiting);
        }
        let n = step.entries;
        let (first, others) = step.rates.split_at_mut(n);
        for (first, end) in first.iter_mut().zip(&others[(self.tableau.stages - 1) * n..]) {
            blend(first, end, &is_new);
        }
    }

    fn choose_lengths(&mut self, step: &mut StepColumns<W>, waiting: &Waiting<'_, W>) {
        for (lane, control) in self.lanes.iter_mut().enumerate() {
            let Some(control) = control.as_mut().filter(|_| waiting.lanes[lane]) else { continue };
            let length =
                if control.failure.is_none() { control.length(self.tolerances.max_step) } else { None };
            step.h[lane] = length.unwrap_or(0.0);
        }
    }

    /// Check the rates at the starts of new steps, and whether stability has bounded the steps before them.
    fn check_first(&mut self, step: &StepColumns<W>, waiting: &Waiting<'_, W>) {
        let mut rates = [0.0; W];
        let mut states = [0.0; W];
        let mut sizes = [0.0; W];
        in_vectors::<W>(Distances {
            rates: (step.rates(0), &self.last_rates),
            states: (&step.before, &self.last_stage),
            sums: (&mut rates, &mut states),
            // A sum of zeros, unless a rate is not finite.
            zeros: &mut sizes,
        });
        for (lane, control) in self.lanes.iter_mut().enumerate() {
            let is_waiting = |control: &&mut Control| waiting.lanes[lane] && control.failure.is_none();
            let Some(control) = control.as_mut().filter(is_waiting) else { continue };
            if control.was_rejected {
                continue;
            }
            if sizes[lane].is_nan() {
                control.failure = Some(Failure::NotFinite { t: control.t });
            } else if control.statistics.steps > 0 {
                let is_at_bound =
                    steepness(control.last.1, rates[lane], states[lane]) > self.tableau.stability;
                control.statistics.stiff |= note_stiffness(&mut control.stiff_steps, is_at_bound);
            }
        }
    }

    /// The errors of the steps in units of the tolerance; NaN where some stage has no finite rate.
    fn errors(&self, step: &StepColumns<W>) -> [f64; W] {
        let mut squares = [[0.0; W]; 2];
        let &Self { tableau, tolerances, ref sizes, .. } = self;
        in_vectors::<W>(Squares { tableau, tolerances, sizes, step, sums: &mut squares });
        #[allow(clippy::cast_precision_loss, reason = "no state has 2^53 numbers")]
        let entries = self.tolerances.controlled as f64;
        let has_low = step.errors.len() > 1;
        std::array::from_fn(|lane| {
            let low = has_low.then_some(squares[1][lane]);
            error_of_step(step.h[lane], (squares[0][lane], low), entries)
        })
    }

    /// Accept or reject the steps; return which are accepted.
    fn decide(&mut self, errors: &[f64; W], step: &StepColumns<W>, waiting: &Waiting<'_, W>) -> [bool; W] {
        let evaluated = self.tableau.stages - usize::from(!self.tableau.evaluates_end);
        let mut accepted = [false; W];
        for (lane, control) in self.lanes.iter_mut().enumerate() {
            let is_waiting = |control: &&mut Control| waiting.lanes[lane] && control.failure.is_none();
            let Some(control) = control.as_mut().filter(is_waiting) else { continue };
            control.statistics.evaluations += evaluated;
            let (h, error) = (step.h[lane], errors[lane]);
            if error <= 1.0 {
                control.accept(h, error);
                accepted[lane] = true;
            } else {
                control.reject(h, error);
            }
        }
        accepted
    }

    /// Evaluate the stages of the dense output, if a motion looks into its step.
    fn add_dense_stages(
        &mut self,
        accepted: &[bool; W],
        step: &mut StepColumns<W>,
        function: &mut Columns<W>,
        waiting: &mut Waiting<'_, W>,
    ) {
        let is_watched = self.crossings.is_some();
        let looks_into =
            |control: &Control| is_watched || control.last.0 + control.last.1 > control.stretch.until;
        self.has_dense_stages = self
            .lanes
            .iter()
            .zip(accepted)
            .any(|(control, is_accepted)| *is_accepted && control.as_ref().is_some_and(looks_into));
        if self.has_dense_stages {
            step.take_dense(self.tableau, function, waiting);
        }
    }

    /// Note the steps in which an event may happen: their motions look at them.
    fn look_for_events(
        &mut self,
        accepted: &[bool; W],
        step: &StepColumns<W>,
        function: &mut Columns<W>,
        waiting: &mut Waiting<'_, W>,
    ) {
        let Some(crossings) = &mut self.crossings else { return };
        if !accepted.contains(&true) {
            crossings.found = [false; W];
            return;
        }
        let ends = std::array::from_fn(|lane| self.lanes[lane].as_ref().map_or(0.0, |control| control.t));
        crossings.find((accepted, &ends), step, function, waiting);
        for (control, is_accepted) in self.lanes.iter_mut().zip(accepted) {
            if let Some(control) = control.as_mut().filter(|_| *is_accepted) {
                control.statistics.evaluations += self.tableau.c.len() - self.tableau.stages;
            }
        }
    }

    /// Continue from the ends of the steps that were accepted.
    fn move_on(&mut self, accepted: [bool; W], step: &mut StepColumns<W>) {
        let last = (self.tableau.stages - 1) * step.entries;
        in_vectors::<W>(Moves { stretches: self, step, accepted, last });
    }
}

/// The move to the ends of the steps that were accepted.
struct Moves<'a, const W: usize> {
    stretches: &'a mut Stretches<W>,
    step: &'a mut StepColumns<W>,
    accepted: [bool; W],
    /// Where the rates of the last stage are.
    last: usize,
}

impl<const W: usize> Loop for Moves<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let Self { stretches, step, accepted, last } = self;
        for i in 0..step.entries {
            blend(&mut stretches.starts[i], &step.before[i], &accepted);
            blend(&mut step.before[i], &step.after[i], &accepted);
            blend(&mut stretches.last_stage[i], &step.last_stage[i], &accepted);
            blend(&mut stretches.last_rates[i], &step.rates[last + i], &accepted);
            if i >= stretches.tolerances.controlled {
                let (x, origin, mut sizes) = (step.before[i], stretches.origins[i], stretches.sizes[i]);
                for lane in 0..W {
                    sizes[lane] = sizes[lane].max(x[lane].abs()).max((x[lane] - origin[lane]).abs());
                }
                stretches.sizes[i] = sizes;
            }
        }
    }
}

/// Replace the numbers of some lanes.
#[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
#[inline(always)]
pub(super) fn blend<const W: usize>(old: &mut [f64; W], new: &[f64; W], chosen: &[bool; W]) {
    let mut both = *old;
    for lane in 0..W {
        both[lane] = if chosen[lane] { new[lane] } else { both[lane] };
    }
    *old = both;
}
