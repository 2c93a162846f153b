//! The parts of a logarithm that is a sum.

use crate::graph::Id;
use crate::value::Number;

/// A part of a logarithm: its coefficient, and whether the node is the part itself or its argument.
pub(super) enum Part {
    /// coefficient * node, for an exponential of the node.
    Exponent(Number, Id),
    /// coefficient * log(node), for a positive symbol or pi.
    Logarithm(Number, Id),
    /// coefficient * log(number)
    Number(Number, Number),
    /// coefficient * exponent * log(base), for a positive base.
    Power(Number, Id, Id),
}
