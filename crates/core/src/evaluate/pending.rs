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

impl Pending<'_> {
    /// The nodes of which it is made.
    pub(super) fn nodes(self) -> Vec<Id> {
        match self {
            Self::Node(id) => vec![id],
            Self::Sum(terms) => terms.iter().map(|&(_, id)| id).collect(),
            Self::Product(factors) => factors.iter().map(|&(id, _)| id).collect(),
            Self::Function(_, args) => args.to_vec(),
        }
    }
}
