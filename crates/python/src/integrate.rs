//! Integration of compiled equations, without the interpreter; Python is asked several times per second whether to
//! continue.

#![allow(
    unsafe_code,
    reason = "machine code is known by its address, and the arrays that Python hands over are written without a lock"
)]

use std::slice;
use std::time::{Duration, Instant};

use pyo3::buffer::PyBuffer;
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use symbody_integrate as native;

use crate::deficiency::{Noted, take};
use crate::session::check_deadline;

/// The time between two checks of signals and progress.
const LOOK: Duration = Duration::from_millis(50);

/// An address, the number of constants that the code there reads, and the number of values that it writes; and for
/// several states at a time, another address and the number of conditions that the code there writes.
type Code = (usize, usize, usize, Option<(usize, usize)>);
/// Events: the number of the function, the instant, and the state.
type Occurrences = Vec<(usize, f64, Vec<f64>)>;
/// Steps, rejected steps, evaluations of the rates and of the Jacobian, and whether the problem looks stiff.
type Statistics = (usize, usize, usize, usize, bool);
/// How many instants were reached, events, the end, the kind of failure with time and message, statistics, and since
/// when and how much the balance of energy is off, the doubles of the trail, and where the branch became uncertain.
type Run = (
    usize,
    Occurrences,
    (f64, Vec<f64>),
    Option<(&'static str, f64, String)>,
    Statistics,
    Option<(f64, f64)>,
    Vec<u8>,
    Option<f64>,
);
/// The number of a motion, its run, and the deficiencies of its linear systems.
type RunOfMany = (usize, Run, Vec<Noted>);
/// The counts of all motions as bytes of whole numbers, six for each, -1 for those that were not begun: statistics and
/// the number of instants that were reached; where they ended, as bytes of doubles; the events of motions of which there
/// is nothing else to tell; and the runs with something to tell.
type Runs = (Vec<u8>, Vec<u8>, Happened, Vec<RunOfMany>);
/// Events of many motions in columns of bytes: the number of the motion and of the function as whole numbers, the instant
/// and the state as doubles.
type Happened = (Vec<u8>, Vec<u8>, Vec<u8>, Vec<u8>);

/// The order, the number of stages, whether the error needs the rates at the end, the bound of stability, the instants of
/// the stages, and the rows of weights: of the stages, of the errors, of the dense output.
type Coefficients = (i32, usize, bool, f64, Vec<f64>, Rows, Rows, Rows);
type Rows = Vec<Vec<(usize, f64)>>;

/// Return the coefficients of an explicit method; `None` for others.
#[pyfunction]
fn tableau(method: &str) -> PyResult<Option<Coefficients>> {
    let rows = |rows: &[native::Row]| rows.iter().map(|row| row.to_vec()).collect();
    Ok(named(method)?.tableau().map(|own| {
        let native::Tableau { order, stages, evaluates_end, stability, c, a, errors, dense } = *own;
        (order, stages, evaluates_end, stability, c.to_vec(), rows(a), rows(errors), rows(dense))
    }))
}

/// A system of equations as compiled code.
#[pyclass(frozen)]
pub struct Dynamics {
    states: usize,
    code: native::Dynamics<native::MachineCode>,
}

#[pymethods]
impl Dynamics {
    #[new]
    #[pyo3(signature = (rates, jacobian=None, position_correction=None, velocity_correction=None, energies=None, events=None, sensitivity_correction=None))]
    fn new(
        rates: Code,
        jacobian: Option<(Code, Vec<(usize, usize)>)>,
        position_correction: Option<Code>,
        velocity_correction: Option<Code>,
        energies: Option<Code>,
        events: Option<(Code, Vec<(i32, bool)>)>,
        sensitivity_correction: Option<(Code, usize)>,
    ) -> Self {
        let states = rates.2;
        let code = |(address, constants, outputs, vector): Code| {
            // SAFETY: the caller compiled the code at this address for these lengths, and keeps it while `self` lives.
            let code = unsafe { native::MachineCode::new(address, states, constants, outputs) };
            match vector {
                // SAFETY: likewise.
                Some((address, conditions)) => unsafe { code.with_vectors(address, conditions) },
                None => code,
            }
        };
        let kinds = |kinds: Vec<(i32, bool)>| {
            kinds.into_iter().map(|(direction, terminal)| native::EventKind { direction, terminal }).collect()
        };
        Self {
            states,
            code: native::Dynamics {
                rates: code(rates),
                jacobian: jacobian.map(|(own, places)| (code(own), places)),
                position_correction: position_correction.map(code),
                velocity_correction: velocity_correction.map(code),
                sensitivity_correction: sensitivity_correction.map(|(own, first)| (code(own), first)),
                energies: energies.map(code),
                events: events.map(|(own, those)| (code(own), kinds(those))),
            },
        }
    }

    /// The number of constants that all functions read.
    #[getter]
    fn constants(&self) -> usize {
        self.code.constants()
    }

    /// Integrate from a state through instants; write the states there to `out`, and keep up to `trail` states at
    /// ends of steps.
    ///
    /// `keep_going` is called several times per second with the time that was reached.
    #[allow(clippy::too_many_arguments, reason = "the arguments of an integration")]
    fn integrate(
        &self,
        py: Python<'_>,
        method: &str,
        state: PyBuffer<f64>,
        constants: PyBuffer<f64>,
        instants: PyBuffer<f64>,
        tolerances: (f64, f64, f64, usize),
        mut out: PyBuffer<f64>,
        trail: usize,
        keep_going: Option<Py<PyAny>>,
    ) -> PyResult<Run> {
        let method = named(method)?;
        let (state, constants, instants) = (state.to_vec(py)?, constants.to_vec(py)?, instants.to_vec(py)?);
        check_lengths(&[
            ("the state", state.len(), self.states),
            ("the constants", constants.len(), self.code.constants()),
            ("the states", out.item_count(), instants.len() * self.states),
        ])?;
        let states = written(&mut out)?;
        let mut look = Look::new(keep_going);
        let run = py.detach(|| {
            let dynamics = self.code.with_constants(&constants);
            let record = native::Record { instants: &instants, states, trail };
            native::integrate(&dynamics, method, &state, record, limits(tolerances), &mut |t| {
                look.keeps_going(t)
            })
        });
        look.error.map_or_else(|| Ok(as_tuple(run)), Err)
    }

    /// Integrate many motions in several threads, each of which takes several in lock-step; a row of states, constants
    /// and `out` for each.
    ///
    /// `crew` is the number of threads, and that of the lanes of the code for several states, or 1.
    ///
    /// `keep_going` is called with the number of motions that are done. Motions that reached the last instant, or an event
    /// that ended them, are returned in columns; beside each other run stands what its linear systems lacked.
    #[allow(clippy::too_many_arguments, reason = "the arguments of an integration")]
    fn integrate_many(
        &self,
        py: Python<'_>,
        method: &str,
        states: PyBuffer<f64>,
        constants: PyBuffer<f64>,
        instants: PyBuffer<f64>,
        tolerances: (f64, f64, f64, usize),
        mut out: PyBuffer<f64>,
        trail: usize,
        crew: (usize, usize),
        keep_going: Option<Py<PyAny>>,
    ) -> PyResult<Runs> {
        let method = named(method)?;
        let (begins, constants, instants) = (states.to_vec(py)?, constants.to_vec(py)?, instants.to_vec(py)?);
        let cases = begins.len() / self.states.max(1);
        check_lengths(&[
            ("the states", begins.len(), cases * self.states),
            ("the constants", constants.len(), cases * self.code.constants()),
            ("the results", out.item_count(), cases * instants.len() * self.states),
        ])?;
        if ![1, 2, 4, 8].contains(&crew.1) {
            return Err(PyValueError::new_err(format!("{} lanes, not 1, 2, 4 or 8", crew.1)));
        }
        let width = self.code.constants();
        let cases: Vec<_> = (0..cases)
            .map(|k| native::Case {
                state: &begins[k * self.states..][..self.states],
                constants: &constants[k * width..][..width],
            })
            .collect();
        let record = native::Record { instants: &instants, states: written(&mut out)?, trail };
        let mut look = Look::new(keep_going);
        let runs = py.detach(|| {
            let tolerances = limits(tolerances);
            #[allow(clippy::cast_precision_loss, reason = "a count of motions")]
            let mut watched = |done: usize| look.keeps_going(done as f64);
            native::integrate_many(&self.code, method, &cases, record, tolerances, crew, &mut watched, &take)
        });
        if let Some(error) = look.error {
            return Err(error);
        }
        let states = written(&mut out)?.chunks((instants.len() * self.states).max(1));
        let counts = runs.iter().flat_map(|run| run.as_ref().map_or([-1; 6], |(run, _)| counts(run)));
        let counts = counts.flat_map(i64::to_ne_bytes).collect();
        let ends = runs.iter().map(|run| run.as_ref().map_or(f64::NAN, |(run, _)| run.end.0));
        let ends = ends.flat_map(f64::to_ne_bytes).collect();
        let mut happened = Happened::default();
        let mut remarkable = Vec::new();
        for ((number, run), states) in runs.into_iter().enumerate().zip(states) {
            let Some((run, noted)) = run else { continue };
            if noted.is_empty() && !has_news(&run, &instants, &states[states.len() - self.states..]) {
                put_events(&mut happened, number, &run.occurrences);
            } else {
                remarkable.push((number, as_tuple(run), noted));
            }
        }
        Ok((counts, ends, happened, remarkable))
    }
}

/// Whether there is more to tell of a motion than its events, and that it ended at the last instant or at one of them.
fn has_news(run: &native::Run, instants: &[f64], last: &[f64]) -> bool {
    let is_whole = run.reached == instants.len() && instants.last() == Some(&run.end.0) && run.end.1 == last;
    let is_ended = run.end.0 < instants[instants.len() - 1]
        && run.occurrences.last().is_some_and(|event| (event.t, &event.state) == (run.end.0, &run.end.1));
    let is_plain = run.failure.is_none() && run.imbalance.is_none() && run.uncertain.is_none();
    !((is_whole || is_ended) && is_plain && run.trail.is_empty())
}

#[allow(clippy::cast_possible_wrap, reason = "no motion has 2^63 steps")]
fn counts(run: &native::Run) -> [i64; 6] {
    let native::Statistics { steps, rejected, evaluations, jacobians, stiff, .. } = run.statistics;
    let reached = run.reached as i64;
    [steps as i64, rejected as i64, evaluations as i64, jacobians as i64, i64::from(stiff), reached]
}

/// Append the events of a motion to the columns.
#[allow(clippy::cast_possible_wrap, reason = "there are less than 2^63 motions")]
fn put_events(columns: &mut Happened, number: usize, events: &[native::Occurrence]) {
    for native::Occurrence { event, t, state } in events {
        columns.0.extend((number as i64).to_ne_bytes());
        columns.1.extend((*event as i64).to_ne_bytes());
        columns.2.extend(t.to_ne_bytes());
        columns.3.extend(state.iter().flat_map(|x| x.to_ne_bytes()));
    }
}

/// Asks Python from time to time whether to continue.
struct Look {
    keep_going: Option<Py<PyAny>>,
    last: Instant,
    is_over: bool,
    error: Option<PyErr>,
}

impl Look {
    fn new(keep_going: Option<Py<PyAny>>) -> Self {
        Self { keep_going, last: Instant::now(), is_over: false, error: None }
    }

    /// Ctrl-C ends the motion, and the results so far are kept; the end of a limit of time is an error.
    fn keeps_going(&mut self, progress: f64) -> bool {
        if self.is_over {
            return false;
        }
        if self.last.elapsed() < LOOK {
            return true;
        }
        let answer = Python::attach(|py| {
            py.check_signals()?;
            check_deadline()?;
            self.keep_going.as_ref().map_or(Ok(true), |ask| ask.call1(py, (progress,))?.is_truthy(py))
        });
        self.last = Instant::now();
        self.is_over = !matches!(answer, Ok(true));
        self.error = answer
            .err()
            .filter(|error| Python::attach(|py| !error.is_instance_of::<PyKeyboardInterrupt>(py)));
        !self.is_over
    }
}

fn named(method: &str) -> PyResult<native::Method> {
    native::Method::named(method).ok_or_else(|| PyValueError::new_err(method.to_owned()))
}

fn limits((relative, absolute, max_step, controlled): (f64, f64, f64, usize)) -> native::Tolerances {
    native::Tolerances { relative, absolute, max_step, controlled }
}

fn check_lengths(lengths: &[(&str, usize, usize)]) -> PyResult<()> {
    match lengths.iter().find(|(_, found, expected)| found != expected) {
        Some((what, found, expected)) => {
            Err(PyValueError::new_err(format!("{what}: {found} numbers, not {expected}")))
        }
        None => Ok(()),
    }
}

/// The memory of an array that Python made for this call.
fn written(out: &mut PyBuffer<f64>) -> PyResult<&mut [f64]> {
    if out.readonly() || !out.is_c_contiguous() {
        return Err(PyValueError::new_err("the results are written to a contiguous array"));
    }
    if out.item_count() == 0 {
        return Ok(&mut []);
    }
    // SAFETY: contiguous, writable and of doubles; the caller made it for this call, and nobody else writes it.
    Ok(unsafe { slice::from_raw_parts_mut(out.buf_ptr().cast(), out.item_count()) })
}

fn as_tuple(run: native::Run) -> Run {
    let occurrences = run.occurrences.into_iter().map(|o| (o.event, o.t, o.state)).collect();
    let failure = run.failure.map(|failure| (failure.kind(), failure.t(), failure.to_string()));
    let s = run.statistics;
    let imbalance = run.imbalance.map(|found| (found.t, found.part));
    let statistics = (s.steps, s.rejected, s.evaluations, s.jacobians, s.stiff);
    let trail = run.trail.into_iter().flat_map(f64::to_ne_bytes).collect();
    (run.reached, occurrences, run.end, failure, statistics, imbalance, trail, run.uncertain)
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Dynamics>()?;
    module.add_function(wrap_pyfunction!(tableau, module)?)
}
