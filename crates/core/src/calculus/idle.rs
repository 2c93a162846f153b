//! Idle variables: those in the form of an expression on which its value does not depend.
//!
//! The spin angle of a disc stands in `sin(q)**2*a + cos(q)**2*b - (b - a)*cos(q)**2`, but not in its value. Any number in
//! place of such a variable gives an expression of the same value, which is proved before it is taken.

use std::collections::VecDeque;

use crate::graph::{ByValue, Function, Graph, Id, View};
use crate::value::Number;

impl Graph {
    /// The roots in forms without idle variables, so far as such forms are found and take no more operations.
    pub fn without_idle_variables(&mut self, roots: &[Id]) -> Vec<Id> {
        let mut best = roots.to_vec();
        let mut idle = VecDeque::from(self.seemingly_idle_variables(roots));
        let mut is_sure = false;
        while let Some(&variable) = idle.front() {
            if let Some(found) = self.without_idle(variable, &best, is_sure) {
                best = found;
                idle.pop_front();
            } else {
                let sure = self.idle_variables(&best); // which takes longer than a trial that succeeds
                idle.retain(|id| sure.contains(id));
                is_sure = true;
            }
        }
        best
    }

    /// The roots with a number in place of a variable, if their values and their costs allow it.
    ///
    /// Nothing if the values differ and it isn't sure that the variable is idle.
    fn without_idle(&mut self, variable: Id, roots: &[Id], is_sure: bool) -> Option<Vec<Id>> {
        let mut pairs = self.rates_of(variable, roots);
        for place in self.places_for(variable, roots) {
            pairs.push((variable, place));
            let replaced = self.substitute(roots, &pairs);
            pairs.pop();
            // A division by zero, or by what became zero, is no reason to fail: another number may do.
            let Ok(replaced) = replaced else { continue };
            let is_equal = roots.iter().zip(&replaced).all(|(&a, &b)| self.equal(a, b));
            if !is_equal && !is_sure {
                return None;
            }
            if is_equal
                && self.is_as_regular(&replaced, roots)
                && self.cost(&replaced).total() <= self.cost(roots).total()
            {
                return Some(replaced);
            }
        }
        Some(roots.to_vec())
    }

    /// Whether forms have no poles but those of other forms: whether they divide by what these divide by.
    fn is_as_regular(&self, forms: &[Id], others: &[Id]) -> bool {
        let mut known: ByValue<()> = ByValue::default();
        for id in self.divisors(others) {
            known.push(self.value(id), id, ());
        }
        self.divisors(forms).into_iter().all(|id| self.find_up_to_sign(&known, id).is_some())
    }

    /// What must not be zero, or has no value everywhere: divisors, systems of equations, and arguments of functions
    /// with poles and branches. Numbers are left out.
    fn divisors(&self, roots: &[Id]) -> Vec<Id> {
        let mut divisors = Vec::new();
        for id in self.post_order_where(roots, |id| !self.is_constant(id)) {
            match self.view(id) {
                View::Product(factors) => divisors.extend(
                    factors
                        .iter()
                        .filter(|&(_, exponent)| {
                            let exponent = self.get_number(exponent);
                            exponent.is_negative() || !exponent.is_integer()
                        })
                        .map(|(base, _)| base),
                ),
                View::LinearSystem { .. } => divisors.push(id),
                View::Function(Function::Sin | Function::Cos | Function::Exp, _) => {}
                View::Function(_, args) => divisors.extend(args.iter()),
                _ => {}
            }
        }
        divisors.retain(|&id| !self.is_constant(id));
        divisors
    }

    /// The numbers that may replace a variable: zero first; right angles for angles, and small numbers for others.
    fn places_for(&mut self, variable: Id, roots: &[Id]) -> Vec<Id> {
        let is_angle = self.post_order(roots).into_iter().any(|id| match self.view(id) {
            View::Function(Function::Sin | Function::Cos | Function::Tan, args) => {
                self.variables(&[args.get(0)]).contains(&variable)
            }
            _ => false,
        });
        let others = if is_angle {
            let pi = self.pi();
            [2, 4].map(|n| {
                let part = self.number_id(&Number::rational(1, n));
                self.scale(part, pi)
            })
        } else {
            [1, 2].map(|n| self.integer(n))
        };
        vec![Id::ZERO, others[0], others[1]]
    }

    /// The pairs that keep the rates of a function of time when it is replaced.
    pub(super) fn rates_of(&self, variable: Id, roots: &[Id]) -> Vec<(Id, Id)> {
        let View::TimeFunction(name, order, assumption) = self.view(variable) else { return Vec::new() };
        let is_rate = |id: &Id| matches!(self.view(*id), View::TimeFunction(other, more, its) if other == name && more > order && its == assumption);
        self.variables(roots).into_iter().filter(is_rate).map(|id| (id, id)).collect()
    }
}
