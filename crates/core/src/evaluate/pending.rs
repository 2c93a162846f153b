//! What is compared: nodes, and sums, products and functions that have no node yet.

use crate::graph::{Function, Id, NumberId};

/// Something with a value: a node, or a sum or product of nodes that has none yet.
#[derive(Clone, Copy)]
pub(crate) enum Pending<'a> {
    Node(Id),
    Sum(&'a [(NumberId, Id)]),
    Product(&'a [(Id, NumberId)]),
    Function(Function, &'a [Id]),
}
