//! The parts of a product under construction: numbers, roots of numbers, and powers of distinct bases.

use crate::graph::{Graph, Id};
use crate::value::Number;

/// The parts of a product while it is collected.
pub(super) struct Collector {
    pub(crate) coefficient: Number,
    pub(crate) factors: Vec<(Id, Number)>,
    /// The product of all numbers under a square root.
    pub(crate) radicand: Option<Number>,
}

impl Collector {
    /// Multiply by base ** exponent; if a base with the same or the opposite value is present, add the exponent to
    /// its own.
    pub(crate) fn push(&mut self, graph: &Graph, base: Id, exponent: &Number) {
        let value = graph.value(base);
        for (position, (known, total)) in self.factors.iter_mut().enumerate() {
            let same = graph.value(*known) == value;
            let opposite = !same && graph.value(*known) == -value && exponent.is_integer();
            if !(same || opposite) {
                continue;
            }
            if opposite && !exponent.is_even() {
                self.coefficient = self.coefficient.neg();
            }
            *total = total.add(exponent);
            if total.is_zero() {
                self.factors.remove(position);
            }
            return;
        }
        self.factors.push((base, exponent.clone()));
    }
}
