//! Which node stands for all nodes of its value where functions are evaluated.

use rustc_hash::FxHashMap;

use crate::value::Element;

use super::by_value::ByValue;
use super::node::Id;

/// The nodes that stand for classes of nodes of equal or opposite values.
///
/// Invariant: the nodes below a known node are known, and nothing is ever forgotten: values were found from this.
#[derive(Default)]
pub(crate) struct Representatives {
    /// The first nodes of the classes.
    firsts: ByValue<()>,
    /// The first nodes of the opposite value, by the first nodes of the classes.
    opposites: FxHashMap<Id, Id>,
    known: FxHashMap<Id, Standing>,
}

/// How a node stands in its class.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standing {
    /// The first node of the class, which has the value of this node or the opposite one.
    pub(crate) first: Id,
    pub(crate) is_opposite: bool,
    /// The first node of the class that has the value of this node.
    pub(crate) equal: Id,
}

impl Representatives {
    pub(crate) fn standing(&self, id: Id) -> Option<Standing> {
        self.known.get(&id).copied()
    }

    /// The first nodes of the classes that have a fingerprint up to sign.
    pub(crate) fn candidates(&self, value: Element) -> Vec<Id> {
        self.firsts.candidates(value).map(|&(id, ())| id).collect()
    }

    /// Let a node of this fingerprint begin a class.
    pub(crate) fn begin(&mut self, id: Id, value: Element) {
        self.firsts.push(value, id, ());
        self.known.insert(id, Standing { first: id, is_opposite: false, equal: id });
    }

    /// Enter a node into the class that begins with another one.
    pub(crate) fn join(&mut self, id: Id, first: Id, is_opposite: bool) {
        let equal = if is_opposite { *self.opposites.entry(first).or_insert(id) } else { first };
        self.known.insert(id, Standing { first, is_opposite, equal });
    }

    /// Bytes held, for the memory budget.
    pub(crate) fn bytes(&self) -> usize {
        self.known.capacity() * (size_of::<(Id, Standing)>() + 1) + self.firsts.bytes()
    }
}
