//! Classes of equal value: the memory of one derivation.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::value::Element;

use super::by_value::ByValue;
use super::node::Id;

/// The classes of one derivation.
///
/// Invariant: every node that the derivation has made or met stands for itself or has another one of its value that
/// stands for it; no two nodes that stand for themselves have equal or opposite values.
#[derive(Default)]
pub struct Classes {
    /// The nodes that stand for themselves.
    nodes: ByValue<()>,
    /// Nodes seen by this derivation -> the node that stands for them.
    known: FxHashMap<Id, Id>,
    /// Products that are part of something: taking them apart would not save their multiplications.
    used: FxHashSet<Id>,
    /// The degree in small variables beyond which terms are dropped, if the derivation drops any.
    pub(crate) order: Option<u32>,
    /// Expansions in the small variables that the derivation has made, by their orders.
    pub(crate) expansions: FxHashMap<u32, FxHashMap<Id, Box<[Id]>>>,
}

impl Classes {
    /// Drop terms beyond this degree in small variables from now on, or none; returns what held before.
    pub const fn keep_order(&mut self, order: Option<u32>) -> Option<u32> {
        std::mem::replace(&mut self.order, order)
    }

    /// The nodes that have a fingerprint up to sign.
    pub(crate) fn candidates(&self, value: Element) -> impl Iterator<Item = Id> {
        self.nodes.candidates(value).map(|&(id, ())| id)
    }

    /// The node that stands for `id`, if the derivation has seen `id`.
    pub(crate) fn representative(&self, id: Id) -> Option<Id> {
        self.known.get(&id).copied()
    }

    /// The nodes that stand for themselves.
    pub(crate) const fn nodes(&self) -> &ByValue<()> {
        &self.nodes
    }

    /// Let `id` stand for itself, and for its value if that is new.
    pub(crate) fn remember(&mut self, id: Id, value: Element, is_new: bool) {
        if is_new {
            self.nodes.push(value, id, ());
        }
        self.known.insert(id, id);
    }

    /// Let `representative` stand for `id`.
    pub(crate) fn replace(&mut self, id: Id, representative: Id) {
        self.known.insert(id, representative);
    }

    /// Record that products became parts of another node.
    pub(crate) fn mark_used(&mut self, products: impl Iterator<Item = Id>) {
        self.used.extend(products);
    }

    /// Whether a product is part of another node.
    pub(crate) fn is_used(&self, product: Id) -> bool {
        self.used.contains(&product)
    }
}
