//! Orders of visiting and rebuilding; all loops, no recursion: graphs are 10^5 levels deep.

use rustc_hash::FxHashSet;

use crate::error::Error;
use crate::graph::Graph;
use crate::node::{Id, View};

impl Graph {
    /// All nodes below the roots, children before parents, each once; the order depends on structure only.
    #[must_use]
    pub fn post_order(&self, roots: &[Id]) -> Vec<Id> {
        self.post_order_where(roots, |_| true)
    }

    /// Like [`Self::post_order`], without what is only reached through nodes that fail the test.
    pub(crate) fn post_order_where(&self, roots: &[Id], enter: impl Fn(Id) -> bool) -> Vec<Id> {
        let mut seen: FxHashSet<Id> = FxHashSet::default();
        let mut order = Vec::new();
        let mut stack: Vec<(Id, bool)> = Vec::new();
        let mut children = Vec::new();
        for &root in roots {
            if enter(root) {
                stack.push((root, false));
            }
            while let Some((id, expanded)) = stack.pop() {
                if expanded {
                    order.push(id);
                    continue;
                }
                if !seen.insert(id) {
                    continue;
                }
                stack.push((id, true));
                children.clear();
                self.push_children(id, &mut children);
                stack.extend(
                    children.iter().rev().filter(|&&child| enter(child)).map(|&child| (child, false)),
                );
            }
        }
        order
    }

    /// The same node over other children.
    ///
    /// # Errors
    /// When a divisor became zero.
    pub(crate) fn rebuild(&mut self, id: Id, map: &impl Fn(&Self, Id) -> Id) -> Result<Id, Error> {
        match self.view(id) {
            View::Number(_) | View::Pi | View::Time | View::Symbol(..) | View::TimeFunction(..) => Ok(id),
            View::Application { name, args, orders } => {
                let (name, orders) = (name.to_owned(), orders.to_vec());
                let args: Vec<Id> = args.iter().map(|arg| map(self, arg)).collect();
                self.application(&name, &args, &orders)
            }
            View::Scale(factor, child) => {
                let child = map(self, child);
                Ok(self.scale(factor, child))
            }
            View::Sum(terms) => {
                let terms: Vec<_> = terms.iter().map(|(c, node)| (c, map(self, node))).collect();
                Ok(self.sum(&terms))
            }
            View::Product(factors) => {
                let factors: Vec<_> = factors.iter().map(|(node, e)| (map(self, node), e)).collect();
                self.product(&factors)
            }
            View::Function(function, args) => {
                let args: Vec<Id> = args.iter().map(|arg| map(self, arg)).collect();
                self.apply(function, &args)
            }
            View::LinearSystem { matrix, right } => {
                let matrix: Vec<Id> = matrix.iter().map(|entry| map(self, entry)).collect();
                let right: Vec<Id> = right.iter().map(|entry| map(self, entry)).collect();
                self.linear_system(&matrix, &right)
            }
            View::Solution(system, index) => {
                let system = map(self, system);
                Ok(self.solution(system, index))
            }
        }
    }
}
