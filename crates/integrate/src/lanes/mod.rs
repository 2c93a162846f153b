//! Motions in lock-step: the functions of several motions are evaluated together, each motion in a lane of the vectors.
//!
//! A motion in a lane runs the same loop as one alone, as a coroutine. Where it needs rates, a step or another function,
//! it writes its numbers to its lane and is suspended. When all motions of the crew are suspended, the functions that
//! they wait for are evaluated for all lanes at once. So each motion has its own time, steps, events and end, and a lane
//! whose motion has ended takes the next one. No arithmetic crosses lanes: a motion doesn't depend on its neighbours.

#![allow(
    unsafe_code,
    reason = "a motion is known to its coroutine by a pointer, and the coroutines borrow what outlives them"
)]

mod columns;
mod stages;

use std::cell::RefCell;
use std::fmt;
use std::ptr::NonNull;
use std::rc::Rc;

use corosensei::stack::DefaultStack;
use corosensei::{Coroutine, CoroutineResult, Yielder};

use crate::dynamics::Dynamics;
use crate::machine_code::MachineCode;
use crate::runge_kutta::{Stages, Tableau};
use columns::{Columns, Waiting, read, write};
use stages::StepColumns;

/// The memory of the stack of a motion; only what is used is taken from the system.
const STACK: usize = 1 << 20;

/// What a motion waits for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Request {
    /// The values of a function, by its number.
    Function(usize),
    /// A step.
    Step,
}

/// The memory for the results of a step.
pub(crate) struct StepResults<'a> {
    pub after: &'a mut [f64],
    pub last_stage: &'a mut [f64],
    pub errors: &'a mut [Vec<f64>],
    /// The rates of the last stage, and those at the end if the method evaluates them.
    pub stages: &'a mut Stages,
}

/// The place of a motion in a crew.
#[derive(Clone)]
pub struct Lane {
    crew: Rc<dyn Desk>,
    number: usize,
    function: usize,
    /// Suspends the coroutine of the motion.
    yielder: NonNull<Yielder<(), Request>>,
}

impl fmt::Debug for Lane {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Lane({})", self.number)
    }
}

impl Lane {
    /// Its number in the crew.
    pub fn number(&self) -> usize {
        self.number
    }

    /// The lane for a function, by its number, with its constants.
    pub(crate) fn of_function(&self, function: usize, constants: &[f64]) -> Self {
        self.crew.put_constants(self.number, function, constants);
        Self { function, ..self.clone() }
    }

    /// Write the values of the function, as soon as those of the other lanes are evaluated.
    pub(crate) fn evaluate(&self, t: f64, state: &[f64], out: &mut [f64]) {
        self.crew.put_state(self.number, self.function, t, state);
        self.wait_for(Request::Function(self.function));
        self.crew.read_values(self.number, self.function, out);
    }

    /// Take a step from a state, as soon as all other lanes ask for one. The function is that of the rates. Write the
    /// rates at the start, with which it agrees.
    pub(crate) fn take_step(&self, (t, h): (f64, f64), before: &[f64], first: &mut [f64]) {
        self.crew.put_step(self.number, (t, h), before);
        self.wait_for(Request::Step);
        self.crew.read_rates(self.number, 0, first);
    }

    /// Read the results of the last step.
    pub(crate) fn read_step(&self, results: StepResults<'_>) {
        self.crew.read_step(self.number, results);
    }

    /// Read the rates at a stage of the last step.
    pub(crate) fn read_rates(&self, stage: usize, rates: &mut [f64]) {
        self.crew.read_rates(self.number, stage, rates);
    }

    fn wait_for(&self, request: Request) {
        // SAFETY: a lane belongs to a motion, which runs inside the coroutine that the pointer belongs to.
        unsafe { self.yielder.as_ref() }.suspend(request);
    }
}

/// The memory that the motions of a crew share.
trait Desk {
    fn put_constants(&self, lane: usize, function: usize, constants: &[f64]);
    fn put_state(&self, lane: usize, function: usize, t: f64, state: &[f64]);
    fn read_values(&self, lane: usize, function: usize, out: &mut [f64]);
    fn put_step(&self, lane: usize, times: (f64, f64), before: &[f64]);
    fn read_step(&self, lane: usize, results: StepResults<'_>);
    fn read_rates(&self, lane: usize, stage: usize, rates: &mut [f64]);
}

/// The numbers of all functions, and of the steps.
struct Crew<const W: usize> {
    tableau: &'static Tableau,
    functions: Vec<RefCell<Option<Columns<W>>>>,
    step: RefCell<StepColumns<W>>,
}

impl<const W: usize> Crew<W> {
    fn new(dynamics: &Dynamics<MachineCode>, tableau: &'static Tableau) -> Self {
        let functions = dynamics.functions();
        Self {
            tableau,
            functions: functions.iter().map(|code| RefCell::new(code.and_then(Columns::of))).collect(),
            step: RefCell::new(StepColumns::new(tableau, dynamics.rates.outputs())),
        }
    }

    /// Evaluate what some motions wait for, and let them continue. Steps wait until no motion waits for anything else, so
    /// that all lanes take them together.
    fn serve(&self, requests: &mut [Option<Request>; W], noted: &mut dyn FnMut(usize)) {
        let first = requests.iter().flatten().find(|request| **request != Request::Step);
        let Some(&wanted @ Request::Function(number)) = first else {
            let lanes = requests.map(|request| request.is_some());
            self.columns(Dynamics::<MachineCode>::RATES, |rates| {
                self.step.borrow_mut().take(self.tableau, rates, &mut Waiting { lanes, noted });
            });
            *requests = [None; W];
            return;
        };
        let lanes = requests.map(|request| request == Some(wanted));
        self.columns(number, |columns| columns.evaluate(&mut Waiting { lanes, noted }));
        for (request, _) in requests.iter_mut().zip(lanes).filter(|(_, is_waiting)| *is_waiting) {
            *request = None;
        }
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
        let last = self.tableau.stages - 1;
        for stage in last..=last + usize::from(self.tableau.evaluates_end) {
            read(lane, columns.rates(stage), results.stages.row_mut(stage));
        }
    }

    fn read_rates(&self, lane: usize, stage: usize, rates: &mut [f64]) {
        read(lane, self.step.borrow().rates(stage), rates);
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
    tableau: &'static Tableau,
    job: &dyn Fn(&Lane),
    noted: &mut dyn FnMut(usize),
) {
    match width {
        2 => run::<2>(dynamics, tableau, job, noted),
        4 => run::<4>(dynamics, tableau, job, noted),
        8 => run::<8>(dynamics, tableau, job, noted),
        _ => unreachable!("vectors have two, four or eight lanes"),
    }
}

fn run<const W: usize>(
    dynamics: &Dynamics<MachineCode>,
    tableau: &'static Tableau,
    job: &dyn Fn(&Lane),
    noted: &mut dyn FnMut(usize),
) {
    let crew = Rc::new(Crew::<W>::new(dynamics, tableau));
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
            if can_note {
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
        job(&Lane { crew, number, function: 0, yielder: NonNull::from(yielder) });
    };
    // SAFETY: `run` drives the coroutine to its end, or drops it, before the job that it borrows is gone.
    unsafe { Coroutine::with_stack_unchecked(stack, body) }
}
