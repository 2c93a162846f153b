//! What code notes of linear systems of deficient rank, thread by thread.
//!
//! A motion, and an evaluation at some points, is the work of one thread: whoever begins one takes what was noted
//! before, and takes afterwards what belongs to it.

use std::cell::RefCell;
use std::collections::BTreeSet;

use pyo3::prelude::*;
use symbody_core::Deficiency;

/// The number of the system, of its equations, those that follow from others, and those that contradict others.
pub type Noted = (u32, usize, Vec<usize>, Vec<(usize, Vec<usize>)>);

thread_local! {
    static NOTED: RefCell<BTreeSet<Deficiency>> = const { RefCell::new(BTreeSet::new()) };
}

/// Note what a system lacks.
pub fn note(found: impl IntoIterator<Item = Deficiency>) {
    NOTED.with_borrow_mut(|noted| noted.extend(found));
}

/// What was noted on this thread since it was last asked for.
pub fn take() -> Vec<Noted> {
    NOTED.take().into_iter().map(told).collect()
}

/// Report what an evaluation found to its user.
pub fn report(py: Python<'_>, found: BTreeSet<Deficiency>, place: &str) -> PyResult<()> {
    if !found.is_empty() {
        let all: Vec<Noted> = found.into_iter().map(told).collect();
        py.import("symbody.symbolic.numeric.deficiency")?.call_method1("report_noted", (all, place))?;
    }
    Ok(())
}

fn told(found: Deficiency) -> Noted {
    let against = found.contradictions.into_iter().map(|one| (one.equation, one.others)).collect();
    (found.system, found.equations, found.dependent, against)
}

/// The linear systems of deficient rank that code met on this thread since the last call.
#[pyfunction]
fn take_deficiencies() -> Vec<Noted> {
    take()
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(take_deficiencies, module)?)
}
