//! A table whose keys are values of nodes up to sign.

use rustc_hash::FxHashMap;

use crate::value::Element;

use super::node::Id;

/// Entries by the value of a node, up to sign.
///
/// A bucket holds the nodes of one fingerprint up to sign. It has several if signs and roots agree in the hash lanes by
/// chance, and the first is stored apart because there are seldom more.
pub(crate) struct ByValue<T> {
    first: FxHashMap<Element, (Id, T)>,
    others: FxHashMap<Element, Vec<(Id, T)>>,
}

impl<T> Default for ByValue<T> {
    fn default() -> Self {
        Self { first: FxHashMap::default(), others: FxHashMap::default() }
    }
}

impl<T> ByValue<T> {
    /// The entries whose nodes have a fingerprint up to sign.
    pub(crate) fn candidates(&self, value: Element) -> impl Iterator<Item = &(Id, T)> {
        let key = value.unsigned().0;
        let first = self.first.get(&key);
        let others = first.filter(|_| !self.others.is_empty()).and_then(|_| self.others.get(&key));
        first.into_iter().chain(others.into_iter().flatten())
    }

    /// Add an entry for a node of this fingerprint, whether or not there is one of its value.
    pub(crate) fn push(&mut self, value: Element, id: Id, item: T) {
        let key = value.unsigned().0;
        match self.first.entry(key) {
            std::collections::hash_map::Entry::Vacant(entry) => {
                entry.insert((id, item));
            }
            std::collections::hash_map::Entry::Occupied(_) => {
                self.others.entry(key).or_default().push((id, item));
            }
        }
    }

    /// Bytes held, but for those of second entries of one fingerprint.
    pub(crate) fn bytes(&self) -> usize {
        self.first.capacity() * (size_of::<(Element, (Id, T))>() + 1)
    }
}
