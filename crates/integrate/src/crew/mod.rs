//! Motions in lock-step: the functions of several motions are evaluated together, each motion in a lane of the vectors.
//!
//! A motion in a lane runs the same loop as one alone, as a coroutine. Where it needs rates, a step or another function,
//! it writes its numbers to its lane and is suspended. When all motions of the crew are suspended, the functions that
//! they wait for are evaluated for all lanes at once. So each motion has its own time, steps, events and end, and a lane
//! whose motion has ended takes the next one. No arithmetic crosses lanes: a motion doesn't depend on its neighbours.

#![allow(unsafe_code, reason = "the coroutines borrow what outlives them")]

mod columns;
mod stages;

use std::cell::RefCell;
use std::rc::Rc;

use corosensei::stack::DefaultStack;
use corosensei::{Coroutine, CoroutineResult, Yielder};

use crate::dynamics::Dynamics;
use crate::lane::{Desk, Lane, Request, StepResults};
use crate::machine_code::MachineCode;
use crate::runge_kutta::Tableau;
use columns::{Columns, Waiting, read, write};
use stages::StepColumns;

/// The memory of the stack of a motion; only what is used is taken from the system.
const STACK: usize = 1 << 20;

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
        job(&Lane::new(crew, number, yielder));
    };
    // SAFETY: `run` drives the coroutine to its end, or drops it, before the job that it borrows is gone.
    unsafe { Coroutine::with_stack_unchecked(stack, body) }
}
