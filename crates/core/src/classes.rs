//! Classes of equal value: the memory of one derivation.
//!
//! A derivation takes values: whoever builds a node whose value is known gets the node that is there.
//! The table belongs to one derivation, so a result depends on the model alone and never on what else
//! the process has computed. Nodes from outside are rebuilt on their first use.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::field::Element;
use crate::graph::Graph;
use crate::node::{Id, Kind, View};

/// The classes of one derivation.
#[derive(Default)]
pub struct Classes {
    /// Value up to sign -> the node, and whether the node has the opposite of the key's value.
    by_value: FxHashMap<Element, (Id, bool)>,
    /// Nodes seen by this derivation -> the node that stands for them.
    known: FxHashMap<Id, Id>,
    /// Products that are part of something: taking them apart would not save their multiplications.
    used: FxHashSet<Id>,
}

impl Graph {
    /// Begin a derivation with the given classes (fresh ones for a new derivation).
    pub fn enter(&mut self, classes: Box<Classes>) {
        self.classes = Some(classes);
    }

    /// End or suspend the derivation and hand its classes back.
    pub fn leave(&mut self) -> Option<Box<Classes>> {
        self.classes.take()
    }

    /// The node of the derivation that has this value, if there is one: the node and its sign.
    pub(crate) fn class_of(&self, value: Element) -> Option<(Id, bool)> {
        let classes = self.classes.as_ref()?;
        let (key, negated) = value.unsigned();
        classes.by_value.get(&key).map(|&(id, opposite)| (id, negated != opposite))
    }

    /// Like [`Self::class_of`], with the sign applied.
    pub(crate) fn known_value(&mut self, value: Element) -> Option<Id> {
        let (id, negated) = self.class_of(value)?;
        Some(if negated { self.opposite(id) } else { id })
    }

    /// Enter a node made by this derivation into the classes.
    pub(crate) fn remember(&mut self, id: Id) {
        if self.classes.is_none() {
            return;
        }
        let (key, negated) = self.value(id).unsigned();
        if let Some(classes) = self.classes.as_mut() {
            classes.by_value.entry(key).or_insert((id, negated));
            classes.known.insert(id, id);
        }
    }

    /// Record that nodes became parts of another one.
    pub(crate) fn mark_used(&mut self, ids: impl Iterator<Item = Id>) {
        let Some(mut classes) = self.classes.take() else { return };
        classes.used.extend(ids.filter(|&id| self.kind(id) == Kind::Product));
        self.classes = Some(classes);
    }

    /// Whether a node is a product made by this derivation and part of nothing yet.
    pub(crate) fn is_fresh_product(&self, id: Id) -> bool {
        self.kind(id) == Kind::Product
            && self.classes.as_ref().is_some_and(|classes| !classes.used.contains(&id))
    }

    /// The node that stands for `id` in the derivation in progress; `id` itself outside of one.
    pub(crate) fn adopt(&mut self, id: Id) -> Id {
        let Some(classes) = self.classes.as_ref() else { return id };
        if let Some(&known) = classes.known.get(&id) {
            return known;
        }
        match self.view(id) {
            // Signs and multiples are not entered into the classes: look through them.
            View::Scale(factor, child) => {
                let child = self.adopt(child);
                self.scale(factor, child)
            }
            View::Number(_) => id,
            _ => self.adopt_below(id),
        }
    }

    fn adopt_below(&mut self, root: Id) -> Id {
        let order = self.post_order(&[root]);
        let mut last = root;
        for id in order {
            let Some(classes) = self.classes.as_ref() else { return root };
            if let Some(&known) = classes.known.get(&id) {
                last = known;
                continue;
            }
            let adopted = if self.is_leaf(id) {
                self.known_value(self.value(id)).filter(|_| self.kind(id) != Kind::Number).unwrap_or(id)
            } else {
                let map = |graph: &Self, child: Id| {
                    graph.classes.as_ref().and_then(|c| c.known.get(&child).copied()).unwrap_or(child)
                };
                // A division that was possible before stays possible.
                self.rebuild(id, &map).unwrap_or(id)
            };
            if adopted == id {
                self.remember(id);
            }
            if let Some(classes) = self.classes.as_mut() {
                classes.known.insert(id, adopted);
            }
            last = adopted;
        }
        last
    }

    fn is_leaf(&self, id: Id) -> bool {
        matches!(self.kind(id), Kind::Number | Kind::Pi | Kind::Time | Kind::Symbol(_) | Kind::TimeFunction)
    }
}
