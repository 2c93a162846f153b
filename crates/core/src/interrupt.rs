//! Interruption of long work, for whoever waits for it.
//!
//! Work that may take long calls [`tick`] in its loops. [`interruptible`] runs work with a watch, which is asked now and
//! then whether to go on. If not, the stack unwinds to `interruptible`; a tick comes before a change of the graph, never
//! within one, so that the graph stays sound.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// The work was interrupted before its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interrupted;

/// How many ticks pass between two questions to the watch: less than some milliseconds, as a tick may stand for the
/// value of a node in a field.
const STRIDE: u32 = 1 << 5;

thread_local! {
    static WATCH: Cell<Option<fn() -> bool>> = const { Cell::new(None) };
    static LEFT: Cell<u32> = const { Cell::new(STRIDE) };
}

/// Run work until its end, or until `watch` returns true.
///
/// # Errors
/// If the work was interrupted.
pub fn interruptible<T>(watch: fn() -> bool, work: impl FnOnce() -> T) -> Result<T, Interrupted> {
    let before = WATCH.replace(Some(watch));
    let result = catch_unwind(AssertUnwindSafe(work));
    WATCH.set(before);
    result.map_err(|payload| if payload.is::<Interrupted>() { Interrupted } else { resume_unwind(payload) })
}

/// A step of long work: it does not return if the work is interrupted.
#[inline]
pub(crate) fn tick() {
    let left = LEFT.get();
    if left == 0 { ask() } else { LEFT.set(left - 1) }
}

/// A step that may take long by itself, such as a product of integers of a million digits.
pub(crate) fn long_tick() {
    ask();
}

#[cold]
fn ask() {
    LEFT.set(STRIDE);
    if WATCH.get().is_some_and(|is_over| is_over()) {
        resume_unwind(Box::new(Interrupted)); // no panic: nothing is printed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Assumption, Graph};
    use crate::value::Number;

    #[test]
    fn work_ends_early_and_the_graph_stays_sound() {
        let g = &mut Graph::new();
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Assumption::Real));
        let sum = g.add(a, b);
        let power = g.pow_number(sum, &Number::integer(3000)).expect("a power of a sum");
        g.enter(Box::default());
        assert_eq!(interruptible(|| true, || g.expand(power)), Err(Interrupted));
        assert!(g.leave().is_some());
        let expanded = interruptible(|| false, || g.expand(power)).expect("nothing interrupts");
        assert!(expanded.is_ok_and(|expanded| g.equal(expanded, power)));
    }

    #[test]
    fn a_panic_stays_a_panic() {
        let result = catch_unwind(|| interruptible(|| false, || resume_unwind(Box::new("mistake"))));
        assert!(result.is_err());
    }
}
