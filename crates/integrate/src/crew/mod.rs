//! Motions in lock-step: the functions of several motions are evaluated together, each motion in a lane of the vectors.
//!
//! A motion in a lane runs the same loop as one alone, as a coroutine. Where it needs rates, a step or another function,
//! it writes its numbers to its lane and is suspended. When all motions of the crew are suspended, the functions that
//! they wait for are evaluated for all lanes at once. So each motion has its own time, steps, events and end, and a lane
//! whose motion has ended takes the next one. No arithmetic crosses lanes: a motion doesn't depend on its neighbours.

#![allow(unsafe_code, reason = "the coroutines borrow what outlives them")]

mod columns;
mod control;
mod crossings;
mod defect;
mod dense;
mod inside;
mod landing;
mod norms;
mod stages;
mod stretch;
mod vectors;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use corosensei::stack::DefaultStack;
use corosensei::{Coroutine, CoroutineResult, Yielder};

use crate::dynamics::Dynamics;
use crate::lane::{Arrival, Beginning, Desk, LandingResults, Lane, Request, StepResults};
use crate::machine_code::MachineCode;
use crate::runge_kutta::Tableau;
use crate::stepper::{Statistics, Stretch};
use crate::tolerances::Tolerances;
use columns::{Columns, Waiting, read, write};
use inside::Inside;
use landing::{Corrections, Landings};
use stages::StepColumns;
use stretch::{Functions, Stretches};

/// The memory of the stack of a motion; only what is used is taken from the system.
const STACK: usize = 1 << 20;

/// The numbers of all functions, and of the steps.
struct Crew<const W: usize> {
    tableau: &'static Tableau,
    functions: Vec<RefCell<Option<Columns<W>>>>,
    /// The same functions, at several states of one motion.
    of_rows: Vec<RefCell<Option<Columns<W>>>>,
    step: RefCell<StepColumns<W>>,
    stretches: RefCell<Stretches<W>>,
    /// Whether motions wait together for functions, since they take steps one by one.
    shares_functions: bool,
    /// Whether code for one state was run for a motion since it was resumed.
    can_have_noted: Cell<bool>,
}

/// The numbers of coordinates and of speeds that constraints change, if lanes can keep all of these by the corrections.
fn kept_by_lanes(dynamics: &Dynamics<MachineCode>) -> Option<(usize, usize)> {
    let codes = [&dynamics.position_correction, &dynamics.velocity_correction];
    let are_there = codes.into_iter().flatten().all(|code| code.conditions().is_some());
    let events = dynamics.events.as_ref();
    let is_seen = events.is_none_or(|(code, _)| code.conditions().is_some());
    let is_plain = dynamics.sensitivity_correction.is_none() && is_seen;
    let [coordinates, speeds] = codes.map(|code| code.as_ref().map_or(0, MachineCode::outputs));
    (are_there && is_plain && speeds > 0).then_some((coordinates, speeds))
}

impl<const W: usize> Crew<W> {
    fn new(dynamics: &Dynamics<MachineCode>, tableau: &'static Tableau, tolerances: Tolerances) -> Self {
        let columns =
            || dynamics.functions().iter().map(|code| RefCell::new(code.and_then(Columns::of))).collect();
        let entries = dynamics.rates.outputs();
        let events = dynamics.events.as_ref().filter(|(code, _)| code.conditions().is_some());
        let inside = events.map(|(_, kinds)| Inside::new(tableau, tolerances, kinds, entries));
        let has_constraints = dynamics.has_constraints();
        let kept = if has_constraints { kept_by_lanes(dynamics) } else { None };
        let landings = kept.map(|kept| Landings::new(tolerances, kept, entries));
        Self {
            tableau,
            functions: columns(),
            of_rows: columns(),
            step: RefCell::new(StepColumns::new(tableau, entries)),
            shares_functions: has_constraints && landings.is_none(),
            stretches: RefCell::new(Stretches::new(tableau, tolerances, entries, inside, landings)),
            can_have_noted: Cell::new(false),
        }
    }

    /// Evaluate what some motions wait for, and let them continue. Steps wait until no motion waits for anything else, so
    /// that all lanes take them together.
    fn serve(&self, requests: &mut [Option<Request>; W], noted: &mut dyn FnMut(usize)) {
        let functions = requests.iter().flatten();
        let Some(&wanted @ Request::Function(number)) =
            functions.clone().find(|request| matches!(request, Request::Function(_)))
        else {
            return self.serve_steps(requests, noted);
        };
        let lanes = requests.map(|request| request == Some(wanted));
        self.columns(number, |columns| columns.evaluate(&mut Waiting { lanes, noted }));
        for (request, _) in requests.iter_mut().zip(lanes).filter(|(_, is_waiting)| *is_waiting) {
            *request = None;
        }
    }

    /// Take a step of all lanes.
    fn serve_steps(&self, requests: &mut [Option<Request>; W], noted: &mut dyn FnMut(usize)) {
        let alone = requests.map(|request| request == Some(Request::Step));
        let lanes = requests.map(|request| request == Some(Request::Stretch));
        let mut is_over = [false; W];
        self.columns(Dynamics::<MachineCode>::RATES, |rates| {
            let mut step = self.step.borrow_mut();
            if lanes.contains(&true) {
                is_over = self.take_stretches(&mut step, rates, &mut Waiting { lanes, noted }, &alone);
            } else {
                let mut waiting = Waiting { lanes: alone, noted };
                step.take_first(rates, &mut waiting);
                step.take(self.tableau, rates, &mut waiting);
            }
        });
        for (request, (is_over, is_alone)) in requests.iter_mut().zip(is_over.into_iter().zip(alone)) {
            if is_over || is_alone {
                *request = None;
            }
        }
    }

    /// Take a step of motions that take several, and of others that take one; return which of the former look at it.
    fn take_stretches(
        &self,
        step: &mut StepColumns<W>,
        rates: &mut Columns<W>,
        waiting: &mut Waiting<'_, W>,
        others: &[bool; W],
    ) -> [bool; W] {
        let [mut positions, mut velocities, mut events] = [
            Dynamics::<MachineCode>::POSITIONS,
            Dynamics::<MachineCode>::VELOCITIES,
            Dynamics::<MachineCode>::EVENTS,
        ]
        .map(|number| self.functions[number].borrow_mut());
        let corrections = Corrections { positions: positions.as_mut(), velocities: velocities.as_mut() };
        let functions = Functions { rates, events: events.as_mut(), corrections };
        self.stretches.borrow_mut().take(step, functions, waiting, others)
    }

    fn columns(&self, function: usize, then: impl FnOnce(&mut Columns<W>)) {
        if let Some(columns) = self.functions[function].borrow_mut().as_mut() {
            then(columns);
        }
    }
}

impl<const W: usize> Desk for Crew<W> {
    fn put_constants(&self, lane: usize, function: usize, constants: &[f64]) {
        self.columns(function, |columns| {
            let first = columns.inputs.len() - constants.len();
            write(lane, constants, &mut columns.inputs[first..]);
        });
    }

    fn put_state(&self, lane: usize, function: usize, t: f64, state: &[f64]) {
        self.columns(function, |columns| {
            columns.inputs[0][lane] = t;
            write(lane, state, &mut columns.inputs[1..]);
        });
    }

    fn read_values(&self, lane: usize, function: usize, out: &mut [f64]) {
        self.columns(function, |columns| read(lane, &columns.outputs, out));
    }

    fn evaluate_rows(&self, function: usize, rows: &[f64], constants: &[f64], out: &mut [f64]) {
        if let Some(columns) = self.of_rows[function].borrow_mut().as_mut() {
            columns.evaluate_rows(rows, constants, out, &mut |_| self.can_have_noted.set(true));
        }
    }

    fn put_step(&self, lane: usize, (t, h): (f64, f64), before: &[f64]) {
        let mut columns = self.step.borrow_mut();
        (columns.t[lane], columns.h[lane]) = (t, h);
        write(lane, before, &mut columns.before);
    }

    fn read_step(&self, lane: usize, results: StepResults<'_>) {
        let columns = self.step.borrow();
        read(lane, &columns.after, results.after);
        read(lane, &columns.last_stage, results.last_stage);
        for (columns, error) in columns.errors.iter().zip(results.errors) {
            read(lane, columns, error);
        }
    }

    fn read_rates(&self, lane: usize, stage: usize, rates: &mut [f64]) {
        read(lane, self.step.borrow().rates(stage), rates);
    }

    fn begin(&self, lane: usize, beginning: &Beginning<'_>) {
        self.stretches.borrow_mut().begin(lane, beginning, &mut self.step.borrow_mut());
    }

    fn put_stretch(&self, lane: usize, stretch: Stretch, statistics: Statistics, largest_speed: f64) {
        self.stretches.borrow_mut().put(lane, stretch, statistics, largest_speed);
    }

    fn read_arrival(&self, lane: usize, before: &mut [f64], after: &mut [f64]) -> Arrival {
        self.stretches.borrow().arrival(lane, before, after, &self.step.borrow())
    }

    fn keeps_constraints(&self) -> bool {
        self.stretches.borrow().keeps_constraints()
    }

    fn read_landing(&self, lane: usize, results: LandingResults<'_>) {
        self.stretches.borrow().read_landing(lane, results, &self.step.borrow());
    }

    fn shares_functions(&self) -> bool {
        self.shares_functions
    }

    fn note_code_for_one(&self) {
        self.can_have_noted.set(true);
    }

    fn has_dense_stages(&self) -> bool {
        self.stretches.borrow().has_dense_stages()
    }

    fn looks_for_events(&self) -> bool {
        self.stretches.borrow().inside().is_some()
    }

    fn read_event_values(&self, lane: usize, start: &mut [f64], ends: &mut [f64]) {
        if let Some(inside) = self.stretches.borrow().inside() {
            inside.crossings.read_values(lane, start, ends);
        }
    }

    fn read_event_values_at_end(&self, lane: usize, values: &mut [f64]) {
        if let Some(inside) = self.stretches.borrow().inside() {
            inside.crossings.read_end(lane, values);
        }
    }

    fn read_terms(&self, lane: usize, terms: &mut [Vec<f64>]) {
        if let Some(inside) = self.stretches.borrow().inside() {
            inside.dense.read_terms(lane, terms);
        }
    }
}

/// Run a job in each lane, to its end: it integrates motion after motion, in the lane that it gets. `noted` is called
/// with the number of a lane each time after its motion, or code for its state alone, was run on this thread.
///
/// # Panics
/// If there are no lanes of this width, or a job panics.
pub fn run_crew(
    width: usize,
    dynamics: &Dynamics<MachineCode>,
    (tableau, tolerances): (&'static Tableau, Tolerances),
    job: &dyn Fn(&Lane),
    noted: &mut dyn FnMut(usize),
) {
    match width {
        2 => run::<2>(dynamics, (tableau, tolerances), job, noted),
        4 => run::<4>(dynamics, (tableau, tolerances), job, noted),
        8 => run::<8>(dynamics, (tableau, tolerances), job, noted),
        _ => unreachable!("vectors have two, four or eight lanes"),
    }
}

fn run<const W: usize>(
    dynamics: &Dynamics<MachineCode>,
    (tableau, tolerances): (&'static Tableau, Tolerances),
    job: &dyn Fn(&Lane),
    noted: &mut dyn FnMut(usize),
) {
    let crew = Rc::new(Crew::<W>::new(dynamics, tableau, tolerances));
    let mut motions: Vec<Option<Coroutine<(), Request, ()>>> =
        (0..W).map(|number| coroutine(Rc::clone(&crew), number, job)).map(Some).collect();
    let mut waiting = [None; W];
    // Code for several states solves no linear systems, so it notes nothing.
    let can_note = dynamics.functions().iter().flatten().any(|code| code.conditions().is_none());
    loop {
        for (number, (motion, request)) in motions.iter_mut().zip(&mut waiting).enumerate() {
            let Some(running) = motion.as_mut().filter(|_| request.is_none()) else { continue };
            match running.resume(()) {
                CoroutineResult::Yield(next) => *request = Some(next),
                CoroutineResult::Return(()) => *motion = None,
            }
            if can_note | crew.can_have_noted.take() {
                noted(number);
            }
        }
        if motions.iter().all(Option::is_none) {
            break;
        }
        crew.serve(&mut waiting, noted);
    }
}

/// The coroutine of a lane.
fn coroutine<const W: usize>(
    crew: Rc<Crew<W>>,
    number: usize,
    job: &dyn Fn(&Lane),
) -> Coroutine<(), Request, ()> {
    let stack = DefaultStack::new(STACK).expect("memory for the stack of a motion");
    let body = move |yielder: &Yielder<(), Request>, ()| {
        job(&Lane::new(crew, number, yielder));
    };
    // SAFETY: `run` drives the coroutine to its end, or drops it, before the job that it borrows is gone.
    unsafe { Coroutine::with_stack_unchecked(stack, body) }
}
