//! Linear systems of deficient rank that code finds, recorded per thread.
//!
//! A motion, or an evaluation at some points, is the work of one thread. The caller takes the records before it starts
//! one, and afterwards takes those that belong to it.

use std::cell::RefCell;
use std::collections::BTreeSet;

use pyo3::prelude::*;
use symbody_core::Deficiency;

/// The number of a system, the number of its equations, those that follow from others, and those that contradict
/// others.
pub type Noted = (u32, usize, Vec<usize>, Vec<(usize, Vec<usize>)>);

thread_local! {
    static NOTED: RefCell<BTreeSet<Deficiency>> = const { RefCell::new(BTreeSet::new()) };
}

/// Record deficient systems.
pub fn note(found: impl IntoIterator<Item = Deficiency>) {
    NOTED.with_borrow_mut(|noted| noted.extend(found));
}

/// Return what was recorded on this thread since the last call.
pub fn take() -> Vec<Noted> {
    NOTED.take().into_iter().map(as_tuple).collect()
}

/// Report the deficient systems of an evaluation to the user.
pub fn report(py: Python<'_>, found: BTreeSet<Deficiency>, place: &str) -> PyResult<()> {
    if !found.is_empty() {
        let all: Vec<Noted> = found.into_iter().map(as_tuple).collect();
        py.import("symbody.symbolic.numeric.deficiency")?.call_method1("report_noted", (all, place))?;
    }
    Ok(())
}

fn as_tuple(found: Deficiency) -> Noted {
    let against = found.contradictions.into_iter().map(|one| (one.equation, one.others)).collect();
    (found.system, found.equations, found.dependent, against)
}

/// The linear systems of deficient rank that code found on this thread since the last call.
#[pyfunction]
fn take_deficiencies() -> Vec<Noted> {
    take()
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(take_deficiencies, module)?)
}
