//! The one graph of a process, the derivation of each thread, errors as Python exceptions, Ctrl-C, and limits of time.

#![expect(unsafe_code, reason = "Python's functions for interrupts have no safe form")]

use std::cell::{Cell, RefCell};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use pyo3::exceptions::PyTimeoutError;
use pyo3::ffi;
use pyo3::prelude::*;
use symbody_core::{Classes, Error, Graph, Id};

/// The graph, also after a panic.
///
/// A panic leaves the graph sound, because rows are only added, and each is entered whole with its value: all that can
/// panic, such as a full table, comes before the first change. Expressions that Python holds therefore stay right. At
/// most the classes of a derivation are lost, and then equal expressions may have different forms.
static GRAPH: LazyLock<Mutex<Graph>> = LazyLock::new(|| Mutex::new(Graph::new()));

thread_local! {
    /// The classes of the derivations of this thread; the last one is in progress, and the others wait for its end.
    #[expect(clippy::vec_box, reason = "the graph holds the classes in progress by their box: moving it is moving a pointer")]
    static CLASSES: RefCell<Vec<Box<Classes>>> = const { RefCell::new(Vec::new()) };

    /// When long work of this thread ends, if its time is limited.
    static DEADLINE: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// The graph while it is in the derivation of this thread; it leaves the derivation even if the work panics.
struct Deriving<'a>(&'a mut Graph);

impl Drop for Deriving<'_> {
    fn drop(&mut self) {
        CLASSES.with_borrow_mut(|waiting| waiting.extend(self.0.leave()));
    }
}

fn lock() -> MutexGuard<'static, Graph> {
    GRAPH.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Run work on the graph within the derivation of this thread, if there is one.
pub fn with_graph<T>(work: impl FnOnce(&mut Graph) -> T) -> T {
    let mut graph = lock();
    let Some(classes) = CLASSES.with_borrow_mut(Vec::pop) else {
        return work(&mut graph);
    };
    graph.enter(classes);
    let deriving = Deriving(&mut graph);
    work(deriving.0)
}

/// Run work on the graph outside any derivation, so that rewrites keep the forms that they make.
pub fn with_forms<T>(work: impl FnOnce(&mut Graph) -> T) -> T {
    let mut graph = lock();
    work(&mut graph)
}

/// What an operation makes: expressions, of which a derivation keeps terms up to its order, or something else.
pub trait Made: Sized {
    /// What the derivation in progress keeps.
    fn kept(self, graph: &mut Graph) -> Result<Self, Error>;
}

impl Made for Id {
    fn kept(self, graph: &mut Graph) -> Result<Self, Error> {
        Ok(graph.kept(vec![self])?[0])
    }
}

impl Made for Vec<Id> {
    fn kept(self, graph: &mut Graph) -> Result<Self, Error> {
        graph.kept(self)
    }
}

impl Made for [Id; 3] {
    fn kept(self, graph: &mut Graph) -> Result<Self, Error> {
        let kept = graph.kept(self.to_vec())?;
        Ok([kept[0], kept[1], kept[2]])
    }
}

impl Made for Vec<Vec<Id>> {
    fn kept(self, graph: &mut Graph) -> Result<Self, Error> {
        self.into_iter().map(|row| graph.kept(row)).collect()
    }
}

impl Made for usize {
    fn kept(self, _: &mut Graph) -> Result<Self, Error> {
        Ok(self)
    }
}

/// Run work that may take long on the graph, within the derivation of this thread. Ctrl-C and a limit of time end it.
pub fn long_with_graph<T: Made>(
    py: Python<'_>,
    work: impl FnMut(&mut Graph) -> Result<T, Error>,
) -> PyResult<T> {
    let mut work = work;
    interruptible(py, || with_graph(|graph| work(graph)?.kept(graph)))
}

/// Run work that may take long on the graph, outside any derivation. Ctrl-C and a limit of time end it.
pub fn long_with_forms<T>(py: Python<'_>, work: impl FnMut(&mut Graph) -> Result<T, Error>) -> PyResult<T> {
    let mut work = work;
    interruptible(py, || with_forms(&mut work))
}

/// Run work until its end, until its time is over, or until a signal arrives whose handler raises an exception.
fn interruptible<T>(py: Python<'_>, mut work: impl FnMut() -> Result<T, Error>) -> PyResult<T> {
    loop {
        if let Ok(result) = symbody_core::interruptible(is_interrupted, &mut work) {
            return raise(py, result);
        }
        check_deadline()?;
        // The handler runs now, as it may use expressions, for which the graph must be free. If it raises nothing, the
        // work begins again, and finds the nodes that it has made.
        repeat_interrupt();
        py.check_signals()?;
    }
}

/// Whether the time is over, or Ctrl-C was pressed since the last question. Only the main thread is interrupted.
fn is_interrupted() -> bool {
    // SAFETY: the work runs while this thread holds the interpreter, and the function has no other condition.
    is_late() || unsafe { ffi::PyOS_InterruptOccurred() != 0 }
}

/// Whether the time of this thread's work is over.
fn is_late() -> bool {
    DEADLINE.get().is_some_and(|end| Instant::now() >= end)
}

/// Raise an error if the time of this thread's work is over.
pub fn check_deadline() -> PyResult<()> {
    if is_late() { Err(PyTimeoutError::new_err("the time limit is over")) } else { Ok(()) }
}

/// Let Python see the interrupt that `is_interrupted` took.
fn repeat_interrupt() {
    // SAFETY: as above.
    unsafe { ffi::PyErr_SetInterrupt() }
}

/// Return the result, or raise the error as the Python exception of its kind.
pub fn raise<T>(py: Python<'_>, result: Result<T, Error>) -> PyResult<T> {
    result.map_err(|error| exception(py, &error))
}

/// The same for an error whose message begins with the function that the user called.
pub fn raise_at<T>(py: Python<'_>, place: &str, result: Result<T, Error>) -> PyResult<T> {
    result.map_err(|error| python_exception(py, class(&error), format!("{place}: {error}{}", remedy(&error))))
}

fn exception(py: Python<'_>, error: &Error) -> PyErr {
    python_exception(py, class(error), format!("{error}{}", remedy(error)))
}

/// The name of the exception of `symbody.errors` for an error.
const fn class(error: &Error) -> &'static str {
    match error {
        Error::DivisionByZero(_) => "DivisionByZeroError",
        Error::MissingInput(_) => "ParameterError",
        _ => "ExpressionError",
    }
}

/// The remedy for an error, if its own message does not state it.
const fn remedy(error: &Error) -> &'static str {
    match error {
        Error::DivisionByZero(_) => "; check the divisor: its terms cancel, or a substitution makes it zero",
        Error::Domain { .. } => "; check the argument, or keep a symbol there and give its value later",
        _ => "",
    }
}

/// The exception for an argument that is not what is expected.
pub fn argument_error(py: Python<'_>, message: String) -> PyErr {
    python_exception(py, "ArgumentError", message)
}

/// An exception of the module `symbody.errors`.
fn python_exception(py: Python<'_>, class: &str, message: String) -> PyErr {
    let instance = py
        .import("symbody.errors")
        .and_then(|errors| errors.getattr(class))
        .and_then(|class| class.call1((message,)));
    match instance {
        Ok(instance) => PyErr::from_value(instance),
        Err(failure) => failure,
    }
}

/// Begin a derivation in this thread; one in progress waits for its end.
#[pyfunction]
fn begin_derivation() {
    CLASSES.with_borrow_mut(|classes| classes.push(Box::default()));
}

/// End the derivation of this thread and resume the one that waited for it.
#[pyfunction]
fn end_derivation() {
    CLASSES.with_borrow_mut(Vec::pop);
}

/// Let the derivation of this thread drop terms beyond a degree in small variables, or none; returns the former degree.
#[pyfunction]
#[pyo3(signature = (order))]
fn keep_order(order: Option<u32>) -> Option<u32> {
    CLASSES.with_borrow_mut(|classes| classes.last_mut().and_then(|last| last.keep_order(order)))
}

/// Let long work of this thread end after some seconds, or at its own end; returns what was left of a former limit.
#[pyfunction]
#[pyo3(signature = (seconds))]
fn limit_time(seconds: Option<f64>) -> Option<f64> {
    let limit = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    let before = DEADLINE.replace(limit.and_then(|limit| Instant::now().checked_add(limit)));
    before.map(|end| end.saturating_duration_since(Instant::now()).as_secs_f64())
}

/// The number of nodes in the graph of this process.
#[pyfunction]
fn node_count() -> usize {
    with_forms(|graph| graph.len())
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(begin_derivation, module)?)?;
    module.add_function(wrap_pyfunction!(end_derivation, module)?)?;
    module.add_function(wrap_pyfunction!(keep_order, module)?)?;
    module.add_function(wrap_pyfunction!(limit_time, module)?)?;
    module.add_function(wrap_pyfunction!(node_count, module)?)
}
