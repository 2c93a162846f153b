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

/// The start of a motion that takes its steps in a lane.
pub(crate) struct Beginning<'a> {
    pub t: f64,
    pub end: f64,
    pub state: &'a [f64],
    /// The rates there.
    pub rates: &'a [f64],
    /// The first step to try.
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

    /// Begin a motion without constraints, which takes its steps by [`Self::advance`].
    pub(crate) fn begin(&self, beginning: &Beginning<'_>) {
        self.crew.begin(self.number, beginning);
    }

    /// Take accepted steps, together with those of the other lanes. Write the states at the ends of the last one.
    pub(crate) fn advance(
        &self,
        stretch: Stretch,
        statistics: Statistics,
        (before, after): (&mut [f64], &mut [f64]),
    ) -> Arrival {
        self.crew.put_stretch(self.number, stretch, statistics);
        self.wait_for(Request::Stretch);
        self.crew.read_arrival(self.number, before, after)
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
    fn put_stretch(&self, lane: usize, stretch: Stretch, statistics: Statistics);
    fn read_arrival(&self, lane: usize, before: &mut [f64], after: &mut [f64]) -> Arrival;
    fn has_dense_stages(&self) -> bool;
    fn looks_for_events(&self) -> bool;
    fn read_event_values(&self, lane: usize, start: &mut [f64], ends: &mut [f64]);
    fn read_terms(&self, lane: usize, terms: &mut [Vec<f64>]);
}
