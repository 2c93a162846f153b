//! Accepted steps, one after another, of a motion in each lane: the control of a motion alone, in vectors. A lane stops
//! where its motion looks at a step; with constraints, also before a step that is rejected, that does not land on the
//! constraints, or that starts where its rates may be noise.

use crate::failure::Failure;
use crate::lane::{Arrival, Beginning, Landed, LandingResults};
use crate::runge_kutta::{HELD_BACK, NOISE, SLOW, Tableau, error_of_step, steepness};
use crate::stepper::{Statistics, Stretch};
use crate::tolerances::Tolerances;

use super::columns::{Columns, Waiting, read, write};
use super::control::Control;
use super::inside::Inside;
use super::landing::{Corrections, Landings};
use super::norms::{Distances, Squares};
use super::stages::StepColumns;
use super::vectors::{Loop, blend, in_vectors};

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
    inside: Option<Inside<W>>,
    landings: Option<Landings<W>>,
    /// The ends of the last accepted steps, before they were put onto the constraints.
    ends: Vec<[f64; W]>,
}

/// The functions that steps need.
pub(super) struct Functions<'a, const W: usize> {
    pub rates: &'a mut Columns<W>,
    pub events: Option<&'a mut Columns<W>>,
    pub corrections: Corrections<'a, W>,
}

impl<const W: usize> Stretches<W> {
    pub fn new(
        tableau: &'static Tableau,
        tolerances: Tolerances,
        entries: usize,
        inside: Option<Inside<W>>,
        landings: Option<Landings<W>>,
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
            inside,
            landings,
            ends: zeros(),
        }
    }

    pub fn begin(&mut self, lane: usize, beginning: &Beginning<'_>, step: &mut StepColumns<W>) {
        write(lane, beginning.state, &mut step.before);
        write(lane, beginning.rates, &mut step.rates);
        write(lane, beginning.origin, &mut self.origins);
        write(lane, beginning.sizes, &mut self.sizes);
        write(lane, beginning.last_stage.0, &mut self.last_stage);
        write(lane, beginning.last_stage.1, &mut self.last_rates);
        self.lanes[lane] = Some(Control::new(beginning));
        if let Some(inside) = &mut self.inside {
            inside.crossings.begin(lane);
        }
    }

    pub fn put(&mut self, lane: usize, stretch: Stretch, statistics: Statistics, largest_speed: f64) {
        if let Some(control) = &mut self.lanes[lane] {
            control.put(stretch, statistics, largest_speed);
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
        // The ends of a step that the motion has taken by itself are known to the motion alone.
        if control.has_advanced() {
            read(lane, &self.starts, before);
            read(lane, if self.landings.is_some() { &self.ends } else { &step.before }, after);
        }
        Arrival {
            last: control.last,
            t: control.t,
            statistics: control.statistics,
            has_crossing: self.inside.as_ref().map(|inside| inside.crossings.found[lane]),
            failure: control.failure.clone(),
            landing: self.landings.as_ref().map(|_| Landed {
                is_own_turn: control.is_own_turn,
                largest_speed: control.largest_speed,
                step: control.step,
                last_error: control.last_error,
                stiff_steps: control.stiff_steps,
            }),
        }
    }

    pub fn read_landing(&self, lane: usize, results: LandingResults<'_>, step: &StepColumns<W>) {
        let LandingResults { state, sizes, last_stage: (last_stage, last_rates) } = results;
        read(lane, &step.before, state);
        read(lane, &self.sizes, sizes);
        read(lane, &self.last_stage, last_stage);
        read(lane, &self.last_rates, last_rates);
    }

    /// Whether motions keep constraints.
    pub fn keeps_constraints(&self) -> bool {
        self.landings.is_some()
    }

    pub fn has_dense_stages(&self) -> bool {
        self.has_dense_stages
    }

    /// What is known of the inside of the steps, if events are looked for; each stretch ends with the first step in which
    /// one may happen.
    pub fn inside(&self) -> Option<&Inside<W>> {
        self.inside.as_ref()
    }

    /// Try a step of each lane that is not waiting for its motion, and return which lanes now do. Others may wait for a
    /// step of their own, which is taken as well.
    pub fn take(
        &mut self,
        step: &mut StepColumns<W>,
        functions: Functions<'_, W>,
        waiting: &mut Waiting<'_, W>,
        others: &[bool; W],
    ) -> [bool; W] {
        let Functions { rates, events, mut corrections } = functions;
        let lanes = waiting.lanes;
        let mut all = Waiting {
            lanes: std::array::from_fn(|lane| lanes[lane] || others[lane]),
            noted: &mut *waiting.noted,
        };
        self.check_turning(step, &lanes);
        self.take_first(step, rates, (&mut all, &lanes));
        self.check_first(step, &lanes);
        self.choose_lengths(step, &lanes);
        step.take(self.tableau, rates, &mut all);
        let errors = self.errors(step);
        let passed = self.pass(&errors, &lanes);
        let landed = self.land(passed, step, &mut corrections, waiting);
        let accepted = match events {
            Some(events) => self.look_inside(landed, step, (rates, events), &mut corrections, waiting),
            None => landed,
        };
        self.decide(&errors, &accepted, step, &lanes);
        self.add_dense_stages(&accepted, step, rates, waiting);
        let has_crossing = self.inside.as_ref().map_or([false; W], |inside| inside.crossings.found);
        let is_over: [bool; W] = std::array::from_fn(|lane| {
            let is_over = self.lanes[lane].as_ref().is_none_or(Control::is_over);
            lanes[lane] && (is_over || has_crossing[lane])
        });
        self.move_on(accepted, step);
        is_over
    }

    /// Leave steps to motions that turn back, where rounding errors may decide on their directions, and to those that the
    /// longest step holds back, which may leap over a singular position.
    fn check_turning(&mut self, step: &StepColumns<W>, lanes: &[bool; W]) {
        let Some(landings) = &self.landings else { return };
        let (now, ever) = (landings.fastest_of(&step.before), landings.fastest_of(&self.sizes));
        for (lane, control) in self.lanes.iter_mut().enumerate() {
            let Some(control) = control.as_mut().filter(|_| lanes[lane]) else { continue };
            let turns_back = control.statistics.steps > 0 && now[lane] < SLOW * ever[lane];
            control.is_own_turn |= turns_back || control.step > HELD_BACK * self.tolerances.max_step;
        }
    }

    /// The lanes whose steps are as accurate as they should be.
    fn pass(&self, errors: &[f64; W], lanes: &[bool; W]) -> [bool; W] {
        let goes_on = |lane: usize| self.lanes[lane].as_ref().is_some_and(Control::goes_on);
        std::array::from_fn(|lane| lanes[lane] && goes_on(lane) && errors[lane] <= 1.0)
    }

    /// Put the ends of steps onto the constraints, if there are any; return which of the steps are accepted.
    fn land(
        &mut self,
        passed: [bool; W],
        step: &StepColumns<W>,
        corrections: &mut Corrections<'_, W>,
        waiting: &mut Waiting<'_, W>,
    ) -> [bool; W] {
        let ends = self.ends_of(step);
        let Some(landings) = &mut self.landings else { return passed };
        if !passed.contains(&true) {
            return passed;
        }
        let largest = std::array::from_fn(|lane| {
            self.lanes[lane].as_ref().map_or(0.0, |control| control.largest_speed)
        });
        landings.land((&passed, &ends, &largest), step, corrections, waiting)
    }

    /// Write the rates at the starts of the steps; those at the end of the step before, if the method has evaluated them.
    fn take_first(
        &mut self,
        step: &mut StepColumns<W>,
        function: &mut Columns<W>,
        (waiting, lanes): (&mut Waiting<'_, W>, &[bool; W]),
    ) {
        let mut is_new = [false; W];
        for (lane, control) in self.lanes.iter_mut().enumerate() {
            let Some(control) = control.as_mut().filter(|_| lanes[lane]) else { continue };
            step.t[lane] = control.t;
            is_new[lane] = !control.was_rejected() && control.statistics.steps > 0;
        }
        // Onto the constraints, the end of the step before has moved.
        if self.landings.is_some() || !self.tableau.evaluates_end {
            let is_counted = self.landings.is_none();
            for (control, is_new) in self.lanes.iter_mut().zip(is_new) {
                if let Some(control) = control {
                    control.statistics.evaluations += usize::from(is_new && is_counted);
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

    fn choose_lengths(&mut self, step: &mut StepColumns<W>, lanes: &[bool; W]) {
        let is_landing = self.landings.is_some();
        for (lane, control) in self.lanes.iter_mut().enumerate() {
            let Some(control) = control.as_mut().filter(|_| lanes[lane]) else { continue };
            let length = if control.goes_on() { control.length(self.tolerances.max_step) } else { None };
            if is_landing && control.failure.take().is_some() {
                control.is_own_turn = true;
            }
            step.h[lane] = length.unwrap_or(0.0);
        }
    }

    /// Check the rates at the starts of new steps, and whether stability has bounded the steps before them.
    fn check_first(&mut self, step: &StepColumns<W>, lanes: &[bool; W]) {
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
        let is_landing = self.landings.is_some();
        for (lane, control) in self.lanes.iter_mut().enumerate() {
            let is_waiting = |control: &&mut Control| lanes[lane] && control.goes_on();
            let Some(control) = control.as_mut().filter(is_waiting) else { continue };
            if control.was_rejected() {
                continue;
            }
            let is_first = control.statistics.steps == 0;
            let steepness = if is_first { 0.0 } else { steepness(control.last.1, rates[lane], states[lane]) };
            if is_landing && (sizes[lane].is_nan() || steepness.is_nan() || steepness > NOISE) {
                control.is_own_turn = true;
            } else if sizes[lane].is_nan() {
                control.failure = Some(Failure::NotFinite { t: control.t });
            } else if !is_first {
                control.note_stiffness(steepness > self.tableau.stability);
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

    /// Continue after the steps that are accepted, and before the others.
    fn decide(&mut self, errors: &[f64; W], accepted: &[bool; W], step: &StepColumns<W>, lanes: &[bool; W]) {
        let evaluated = self.tableau.stages - usize::from(!self.tableau.evaluates_end);
        let keeps = self.landings.is_some();
        let inside = self.inside.as_ref().map_or(0, |inside| inside.evaluations(keeps));
        for (lane, control) in self.lanes.iter_mut().enumerate() {
            let is_waiting = |control: &&mut Control| lanes[lane] && control.failure.is_none();
            let Some(control) = control.as_mut().filter(is_waiting) else { continue };
            if let Some(landings) = &self.landings {
                if !accepted[lane] {
                    control.leave();
                    continue;
                }
                control.largest_speed = control.largest_speed.max(landings.fastest[lane]);
                control.statistics.evaluations += usize::from(control.statistics.steps > 0);
            }
            control.statistics.evaluations += evaluated + if accepted[lane] { inside } else { 0 };
            let (h, error) = (step.h[lane], errors[lane]);
            if accepted[lane] { control.accept(h, error) } else { control.reject(h, error) }
        }
    }

    /// Look for events in accepted steps: motions look at those in which one may happen. Return the steps that are still
    /// accepted.
    fn look_inside(
        &mut self,
        accepted: [bool; W],
        step: &mut StepColumns<W>,
        functions: (&mut Columns<W>, &mut Columns<W>),
        corrections: &mut Corrections<'_, W>,
        waiting: &mut Waiting<'_, W>,
    ) -> [bool; W] {
        let ends = self.ends_of(step);
        let Some(inside) = &mut self.inside else { return accepted };
        if !accepted.contains(&true) {
            inside.crossings.found = [false; W];
            return accepted;
        }
        let place = (&accepted, &ends);
        inside.look(place, step, functions, (self.landings.as_ref(), corrections), waiting)
    }

    /// Evaluate the stages of the dense output, if a motion without constraints looks into its step.
    fn add_dense_stages(
        &mut self,
        accepted: &[bool; W],
        step: &mut StepColumns<W>,
        function: &mut Columns<W>,
        waiting: &mut Waiting<'_, W>,
    ) {
        if self.inside.is_some() || self.landings.is_some() {
            return;
        }
        let looks_into = |control: &Control| control.last.0 + control.last.1 > control.stretch.until;
        let lanes =
            std::array::from_fn(|lane| accepted[lane] && self.lanes[lane].as_ref().is_some_and(looks_into));
        self.has_dense_stages = lanes.contains(&true);
        if self.has_dense_stages {
            step.take_dense(self.tableau, function, &mut Waiting { lanes, noted: &mut *waiting.noted });
        }
    }

    /// Where the steps end that were chosen.
    fn ends_of(&self, step: &StepColumns<W>) -> [f64; W] {
        std::array::from_fn(|lane| {
            self.lanes[lane].as_ref().map_or(0.0, |control| control.end_of_step(step.h[lane]))
        })
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
            blend(&mut stretches.last_stage[i], &step.last_stage[i], &accepted);
            blend(&mut stretches.last_rates[i], &step.rates[last + i], &accepted);
            let (x, origin, mut sizes) = (step.after[i], stretches.origins[i], stretches.sizes[i]);
            for lane in 0..W {
                sizes[lane] = sizes[lane].max(x[lane].abs()).max((x[lane] - origin[lane]).abs());
            }
            blend(&mut stretches.sizes[i], &sizes, &accepted);
            if let Some(landings) = &stretches.landings {
                blend(&mut stretches.ends[i], &step.after[i], &accepted);
                blend(&mut step.before[i], &landings.states[i], &accepted);
            } else {
                blend(&mut step.before[i], &step.after[i], &accepted);
            }
        }
    }
}
