//! Construction within a derivation: a node whose value is known is not made again.
//!
//! The classes belong to one derivation, so a result depends on the model alone and never on what else the process has
//! computed. Nodes from outside are rebuilt on their first use.

use crate::evaluate::Pending;
use crate::graph::{Flags, Graph, Id, Kind, View};
use crate::value::Element;

/// What a derivation has made with a fingerprint.
pub(super) enum Match {
    None,
    /// A node without signs and roots that has this value, or the opposite one if the second part is true.
    Known(Id, bool),
    /// Nodes with signs and roots only, which may have the value or another one.
    Branching,
}

impl Graph {
    /// The node of the derivation in progress that has the value of something with this fingerprint, if there is one.
    pub(super) fn known_value(&mut self, value: Element, pending: Pending<'_>) -> Option<Id> {
        let classes = self.classes.as_ref()?;
        let (id, negated) = classes
            .candidates(value)
            .map(|id| (id, self.value(id) != value))
            .find(|&(id, negated)| self.agrees(pending, id, negated))?;
        Some(if negated { self.opposite(id) } else { id })
    }

    /// What the derivation in progress has made with the fingerprint of something without signs and roots.
    pub(super) fn plain_match(&self, value: Element) -> Match {
        let Some(classes) = self.classes.as_ref() else { return Match::None };
        let mut found = Match::None;
        for id in classes.candidates(value) {
            if !self.flags(id).has(Flags::BRANCH) {
                return Match::Known(id, self.value(id) != value);
            }
            found = Match::Branching;
        }
        found
    }

    /// Record that nodes became parts of another one.
    pub(super) fn mark_used(&mut self, ids: impl Iterator<Item = Id>) {
        let Some(mut classes) = self.classes.take() else { return };
        classes.mark_used(ids.filter(|&id| self.kind(id) == Kind::Product));
        self.classes = Some(classes);
    }

    /// Whether a node is a product that this derivation has made and that is not part of another node yet.
    pub(super) fn is_fresh_product(&self, id: Id) -> bool {
        self.kind(id) == Kind::Product && self.classes.as_ref().is_some_and(|classes| !classes.is_used(id))
    }

    /// The node that stands for `id` in the derivation in progress; `id` itself outside of one.
    pub(crate) fn adopt(&mut self, id: Id) -> Id {
        let Some(classes) = self.classes.as_ref() else { return id };
        if let Some(known) = classes.representative(id) {
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
            if let Some(known) = classes.representative(id) {
                last = known;
                continue;
            }
            let adopted = if self.is_leaf(id) {
                self.known_value(self.value(id), Pending::Node(id))
                    .filter(|_| self.kind(id) != Kind::Number)
                    .unwrap_or(id)
            } else {
                let map = |graph: &Self, child: Id| {
                    graph.classes.as_ref().and_then(|classes| classes.representative(child)).unwrap_or(child)
                };
                // A division that was possible before stays possible. If a constructor refuses all the same, the
                // node itself is as right.
                self.rebuild(id, &map).unwrap_or(id)
            };
            if adopted == id {
                self.remember(id);
            }
            if let Some(classes) = self.classes.as_mut() {
                classes.replace(id, adopted);
            }
            last = adopted;
        }
        last
    }

    fn is_leaf(&self, id: Id) -> bool {
        matches!(
            self.kind(id),
            Kind::Number | Kind::Pi | Kind::Time | Kind::Symbol(_) | Kind::TimeFunction(_)
        )
    }
}
