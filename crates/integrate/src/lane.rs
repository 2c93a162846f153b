//! The place of a motion that is integrated together with others, in a lane of the vectors.
//!
//! A motion in a lane runs the same loop as one alone, as a coroutine. Where it needs rates, steps or another function,
//! it writes its numbers to its lane and is suspended until the values are there. Who evaluates them is known as a [`Desk`].

#![allow(unsafe_code, reason = "a motion is known to its coroutine by a pointer")]

use std::fmt;
use std::ptr::NonNull;
use std::rc::Rc;

use corosensei::Yielder;

use crate::failure::Failure;
use crate::stepper::{Statistics, Stretch};

/// What a motion waits for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Request {
    /// The values of a function, by its number.
    Function(usize),
    /// A step, whatever its error.
    Step,
    /// Accepted steps, one after another.
    Stretch,
}

/// The memory for the results of a step.
pub(crate) struct StepResults<'a> {
    pub after: &'a mut [f64],
    pub last_stage: &'a mut [f64],
    pub errors: &'a mut [Vec<f64>],
}

/// A motion that takes its next steps in a lane.
pub(crate) struct Beginning<'a> {
    pub t: f64,
    pub end: f64,
    pub state: &'a [f64],
    /// The rates there.
    pub rates: &'a [f64],
    /// The largest magnitude or change of each entry so far, and the state at the start of the motion.
    pub sizes: &'a [f64],
    pub origin: &'a [f64],
    /// The state and the rates at the last stage of the step before.
    pub last_stage: (&'a [f64], &'a [f64]),
    /// The start and the length of the step before, and the logarithm of its error.
    pub last: (f64, f64),
    pub last_error: f64,
    pub stiff_steps: u32,
    /// The next step to try.
    pub step: f64,
    /// The power of an error that is proportional to the step.
    pub exponent: f64,
}

/// The last of several steps that were accepted.
pub(crate) struct Arrival {
    /// Its start, and its length.
    pub last: (f64, f64),
    /// Its end.
    pub t: f64,
    pub statistics: Statistics,
    /// Whether an event may happen in it, if the crew looks for events.
    pub has_crossing: Option<bool>,
    /// Why there is no further step.
    pub failure: Option<Failure>,
    /// Where steps end on the constraints.
    pub landing: Option<Landed>,
}

/// The end of steps on the constraints.
pub(crate) struct Landed {
    /// Whether the motion takes the next step itself.
    pub is_own_turn: bool,
    /// The largest speed so far.
    pub largest_speed: f64,
    pub step: f64,
    pub last_error: f64,
    pub stiff_steps: u32,
}

/// The memory for what a motion knows at the end of steps on the constraints.
pub(crate) struct LandingResults<'a> {
    /// The state on the constraints.
    pub state: &'a mut [f64],
    pub sizes: &'a mut [f64],
    /// The state and the rates at the last stage of the last step.
    pub last_stage: (&'a mut [f64], &'a mut [f64]),
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
    /// The place with a number in a crew, of the motion in the coroutine that the yielder belongs to.
    pub(crate) fn new(crew: Rc<dyn Desk>, number: usize, yielder: &Yielder<(), Request>) -> Self {
        Self { crew, number, function: 0, yielder: NonNull::from(yielder) }
    }

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

    /// Write the values of the function at several states of this motion, at once: rows of an instant and a state.
    pub(crate) fn evaluate_rows(&self, rows: &[f64], constants: &[f64], out: &mut [f64]) {
        self.crew.evaluate_rows(self.function, rows, constants, out);
    }

    /// Take a step from a state, as soon as all other lanes ask for one. The function is that of the rates. Write the
    /// rates at the start, with which it agrees.
    pub(crate) fn take_step(&self, (t, h): (f64, f64), before: &[f64], first: &mut [f64]) {
        self.crew.put_step(self.number, (t, h), before);
        self.wait_for(Request::Step);
        self.crew.read_rates(self.number, 0, first);
    }

    /// Begin a motion, or continue one, which takes its next steps by [`Self::advance`].
    pub(crate) fn begin(&self, beginning: &Beginning<'_>) {
        self.crew.begin(self.number, beginning);
    }

    /// Take accepted steps, together with those of the other lanes. Write the states at the ends of the last one, if any
    /// was accepted.
    pub(crate) fn advance(
        &self,
        stretch: Stretch,
        (statistics, largest_speed): (Statistics, f64),
        (before, after): (&mut [f64], &mut [f64]),
    ) -> Arrival {
        self.crew.put_stretch(self.number, stretch, statistics, largest_speed);
        self.wait_for(Request::Stretch);
        self.crew.read_arrival(self.number, before, after)
    }

    /// Whether steps of motions with constraints are taken by [`Self::advance`].
    pub(crate) fn keeps_constraints(&self) -> bool {
        self.crew.keeps_constraints()
    }

    /// Read what is known at the end of steps on the constraints.
    pub(crate) fn read_landing(&self, results: LandingResults<'_>) {
        self.crew.read_landing(self.number, results);
    }

    /// Whether the functions of several motions are evaluated together. Motions that take several steps at a time seldom
    /// need the same function.
    pub(crate) fn shares_functions(&self) -> bool {
        self.crew.shares_functions()
    }

    /// Note that code for one state was run, which may have noted something of its motion.
    pub(crate) fn note_code_for_one(&self) {
        self.crew.note_code_for_one();
    }

    /// Whether the rates at the stages of the dense output of the last step are there.
    pub(crate) fn has_dense_stages(&self) -> bool {
        self.crew.has_dense_stages()
    }

    /// Whether the crew looks for events in the steps of [`Self::advance`].
    pub(crate) fn looks_for_events(&self) -> bool {
        self.crew.looks_for_events()
    }

    /// Read the values of the functions of the events in the last step, where the crew looks for them.
    pub(crate) fn read_event_values(&self, start: &mut [f64], ends: &mut [f64]) {
        self.crew.read_event_values(self.number, start, ends);
    }

    /// Read these values at the end of the last step, where the crew looks for events.
    pub(crate) fn read_event_values_at_end(&self, values: &mut [f64]) {
        self.crew.read_event_values_at_end(self.number, values);
    }

    /// Read the terms of the dense output of the last step, where the crew looks for events.
    pub(crate) fn read_terms(&self, terms: &mut [Vec<f64>]) {
        self.crew.read_terms(self.number, terms);
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
pub(crate) trait Desk {
    fn put_constants(&self, lane: usize, function: usize, constants: &[f64]);
    fn put_state(&self, lane: usize, function: usize, t: f64, state: &[f64]);
    fn read_values(&self, lane: usize, function: usize, out: &mut [f64]);
    fn evaluate_rows(&self, function: usize, rows: &[f64], constants: &[f64], out: &mut [f64]);
    fn put_step(&self, lane: usize, times: (f64, f64), before: &[f64]);
    fn read_step(&self, lane: usize, results: StepResults<'_>);
    fn read_rates(&self, lane: usize, stage: usize, rates: &mut [f64]);
    fn begin(&self, lane: usize, beginning: &Beginning<'_>);
    fn put_stretch(&self, lane: usize, stretch: Stretch, statistics: Statistics, largest_speed: f64);
    fn read_arrival(&self, lane: usize, before: &mut [f64], after: &mut [f64]) -> Arrival;
    fn keeps_constraints(&self) -> bool;
    fn read_landing(&self, lane: usize, results: LandingResults<'_>);
    fn shares_functions(&self) -> bool;
    fn note_code_for_one(&self);
    fn has_dense_stages(&self) -> bool;
    fn looks_for_events(&self) -> bool;
    fn read_event_values(&self, lane: usize, start: &mut [f64], ends: &mut [f64]);
    fn read_event_values_at_end(&self, lane: usize, values: &mut [f64]);
    fn read_terms(&self, lane: usize, terms: &mut [Vec<f64>]);
}
