//! Orders of traversal, all by loops without recursion: graphs may be 10^5 levels deep.

use rustc_hash::FxHashSet;

use crate::interrupt::tick;

use super::node::Id;
use super::table::Graph;

impl Graph {
    /// All nodes below the roots, children before parents, each once; the order depends on structure only.
    #[must_use]
    pub fn post_order(&self, roots: &[Id]) -> Vec<Id> {
        self.post_order_where(roots, |_| true)
    }

    /// Like [`Self::post_order`], without nodes that fail the test and nodes that are reached only through these.
    pub(crate) fn post_order_where(&self, roots: &[Id], enter: impl Fn(Id) -> bool) -> Vec<Id> {
        children_first(roots, |id, out| self.push_children(id, out), enter)
    }

    /// The variables below the nodes, ordered by structure.
    #[must_use]
    pub fn variables(&self, roots: &[Id]) -> Vec<Id> {
        self.post_order(roots).into_iter().filter(|&id| self.is_variable(id)).collect()
    }
}

/// The nodes that are reached from the roots by `push_children`, which appends the children of a node: children before parents,
/// each once, without nodes that fail the test.
pub(crate) fn children_first(
    roots: &[Id],
    push_children: impl Fn(Id, &mut Vec<Id>),
    enter: impl Fn(Id) -> bool,
) -> Vec<Id> {
    let mut seen: FxHashSet<Id> = FxHashSet::default();
    let mut order = Vec::new();
    let mut stack: Vec<(Id, bool)> = Vec::new();
    let mut children = Vec::new();
    for &root in roots {
        if enter(root) {
            stack.push((root, false));
        }
        while let Some((id, expanded)) = stack.pop() {
            tick();
            if expanded {
                order.push(id);
                continue;
            }
            if !seen.insert(id) {
                continue;
            }
            stack.push((id, true));
            children.clear();
            push_children(id, &mut children);
            stack.extend(children.iter().rev().filter(|&&child| enter(child)).map(|&child| (child, false)));
        }
    }
    order
}
