//! Rebuilding a node over other children, by the constructor of its kind.

use crate::error::Error;
use crate::graph::{Graph, Id, View};

impl Graph {
    /// The same node over other children.
    ///
    /// # Errors
    /// If a divisor becomes zero.
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
