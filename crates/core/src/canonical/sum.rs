//! Sums and multiples.
//!
//! A shared sum inside a sum stays a child, so that the size of recursive kinematics grows linearly. Like terms merge
//! one level deep, by value. The first term of a sum is positive: a negative sign moves into a `Scale`. The number 0 is
//! not a term: `x + 0` is `x`.

use crate::evaluate::Pending;
use crate::graph::{Flags, Graph, Id, Kind, LONGEST, NumberId, View};
use crate::interrupt::tick;
use crate::value::{Element, Number};

/// The most terms that are searched for cancellations with those of child sums.
const CANCELLATION_SEARCH: usize = 48;

/// The work on more terms than these may be interrupted.
const LONG: usize = 1000;

type Term = (NumberId, Id);

impl Graph {
    /// A numeric multiple of a node.
    pub fn scale(&mut self, factor: NumberId, id: Id) -> Id {
        if factor == NumberId::ONE {
            return id;
        }
        if self.get_number(factor).is_zero() || id == Id::ZERO {
            return Id::ZERO;
        }
        match self.view(id) {
            View::Number(number) => {
                let product = self.get_number(factor).mul(self.get_number(number));
                self.number(&product)
            }
            View::Scale(inner, child) => {
                let product = self.get_number(factor).mul(self.get_number(inner));
                let product = self.number_id(&product);
                self.scale(product, child)
            }
            _ => {
                if self.get_number(factor).is_minus_one() {
                    return self.opposite(id);
                }
                let value = self.number_value(factor) * self.value(id);
                self.finish(Kind::Scale, self.flags(id), &[factor.0, id.0], value)
            }
        }
    }

    /// The opposite of a node. The classes know values up to sign, so the opposite is a row of its own in any case.
    pub(crate) fn opposite(&mut self, id: Id) -> Id {
        let (factor, child) = self.split_multiple(NumberId::MINUS_ONE, id);
        if child == Id::ONE {
            return self.number_node(factor);
        }
        if factor == NumberId::ONE {
            return child;
        }
        let (flags, value) = (self.flags(id), -self.value(id));
        self.intern(Kind::Scale, flags, &[factor.0, child.0], value)
    }

    /// The opposite of a node.
    pub fn neg(&mut self, id: Id) -> Id {
        let id = self.adopt(id);
        self.scale(NumberId::MINUS_ONE, id)
    }

    /// a + b.
    pub fn add(&mut self, a: Id, b: Id) -> Id {
        self.sum(&[(NumberId::ONE, a), (NumberId::ONE, b)])
    }

    /// a - b.
    pub fn sub(&mut self, a: Id, b: Id) -> Id {
        self.sum(&[(NumberId::ONE, a), (NumberId::MINUS_ONE, b)])
    }

    /// The sum of numeric multiples of nodes.
    pub fn sum(&mut self, terms: &[Term]) -> Id {
        let terms: Vec<Term> = terms.iter().map(|&(c, id)| (c, self.adopt(id))).collect();
        let value = self.terms_value(&terms);
        let plain = terms.iter().all(|&(_, id)| self.as_number(id).is_some());
        if !plain {
            if value.is_zero() && self.is_number_everywhere(Pending::Sum(&terms), &Number::integer(0)) {
                return Id::ZERO;
            }
            if let Some(known) = self.known_value(value, Pending::Sum(&terms)) {
                return known;
            }
        }
        let terms = self.merge_terms(terms);
        let terms = self.cancel_terms(terms);
        let terms = if self.classes.is_some() { self.factor_fresh_products(terms) } else { terms };
        if self.classes.is_some()
            && let Some((content, bare)) = self.split_content(&terms)
        {
            let sum = self.sum(&bare);
            return self.scale(content, sum);
        }
        self.sum_of_merged(terms, value)
    }

    fn terms_value(&self, terms: &[Term]) -> Element {
        terms.iter().fold(Element::ZERO, |sum, &(c, id)| sum + self.number_value(c) * self.value(id))
    }

    fn sum_of_merged(&mut self, mut terms: Vec<Term>, value: Element) -> Id {
        if terms.is_empty() {
            return Id::ZERO;
        }
        if let [(c, id)] = terms[..] {
            return self.scale(c, id);
        }
        while terms.len() * 2 > LONGEST {
            let rest = terms.split_off(terms.len() - LONGEST / 4);
            let rest_value = self.terms_value(&rest);
            terms.push((NumberId::ONE, self.sum_of_merged(rest, rest_value)));
        }
        let negative = self.get_number(terms[0].0).is_negative();
        if negative {
            for term in &mut terms {
                term.0 = self.negated(term.0);
            }
        }
        let flags = self.joined_flags(terms.iter().map(|&(_, id)| id));
        let words: Vec<u32> = terms.iter().flat_map(|&(c, id)| [c.0, id.0]).collect();
        let value = if negative { -value } else { value };
        let id = self.finish(Kind::Sum, flags, &words, value);
        self.mark_used(terms.iter().map(|&(_, id)| id));
        if negative { self.scale(NumberId::MINUS_ONE, id) } else { id }
    }

    /// Bring terms into the form (coefficient, node that is not a multiple), ordered by value, with equal nodes merged.
    pub(super) fn merge_terms(&mut self, terms: Vec<Term>) -> Vec<Term> {
        let mut terms: Vec<Term> =
            terms.into_iter().map(|(factor, id)| self.split_multiple(factor, id)).collect();
        let is_long = terms.len() > LONG;
        terms.sort_by(|&(_, a), &(_, b)| {
            if is_long {
                tick();
            }
            (a != Id::ONE).cmp(&(b != Id::ONE)).then_with(|| self.compare_values(a, b))
        });
        let mut merged: Vec<Term> = Vec::with_capacity(terms.len());
        for (coefficient, node) in terms {
            match merged.last_mut() {
                Some((last, kept)) if self.same_up_to_sign(*kept, node) => {
                    let addend = self.get_number(coefficient);
                    let addend = if self.same(*kept, node) { addend.clone() } else { addend.neg() };
                    let total = self.get_number(*last).add(&addend);
                    *last = self.number_id(&total);
                }
                _ => merged.push((coefficient, node)),
            }
        }
        merged.retain(|&(c, _)| !self.get_number(c).is_zero());
        merged
    }

    /// factor * id as a multiple of a node that is not itself a multiple; numbers are multiples of the node 1.
    pub(crate) fn split_multiple(&mut self, factor: NumberId, id: Id) -> Term {
        let (inner, node) = match self.view(id) {
            View::Number(number) => (number, Id::ONE),
            View::Scale(inner, child) => (inner, child),
            _ => return (factor, id),
        };
        let product = self.get_number(factor).mul(self.get_number(inner));
        (self.number_id(&product), node)
    }

    /// Open child sums that have a term which cancels another term, so that (a + b) - b is a.
    fn cancel_terms(&mut self, mut terms: Vec<Term>) -> Vec<Term> {
        for _ in 0..8 {
            let Some((first, second)) = self.cancelling_sum(&terms) else { break };
            let mut open = Vec::new();
            for (position, &(factor, id)) in terms.iter().enumerate() {
                match self.view(id) {
                    View::Sum(inner) if position == first || Some(position) == second => {
                        open.extend(inner.iter().map(|(c, node)| (factor, c, node)));
                    }
                    _ => open.push((factor, NumberId::ONE, id)),
                }
            }
            terms = open.into_iter().map(|(factor, c, node)| (self.times(factor, c), node)).collect();
            terms = self.merge_terms(terms);
        }
        terms
    }

    /// The positions of a child sum, and perhaps a second one, with a term that cancels another.
    fn cancelling_sum(&self, terms: &[Term]) -> Option<(usize, Option<usize>)> {
        // The scaled value, the node, the position, and whether the term is one of a child sum.
        let mut seen: Vec<(Element, Id, usize, bool)> = Vec::new();
        for (position, &(factor, id)) in terms.iter().enumerate() {
            let scaled =
                |c: NumberId, node: Id| self.number_value(factor) * self.number_value(c) * self.value(node);
            seen.push((scaled(NumberId::ONE, id), id, position, false));
            if let View::Sum(inner) = self.view(id) {
                seen.extend(inner.iter().map(|(c, node)| (scaled(c, node), node, position, true)));
            }
            if seen.len() > CANCELLATION_SEARCH {
                return None;
            }
        }
        for (i, &(value, node, position, inner)) in seen.iter().enumerate() {
            let opposite = -value;
            for &(other, other_node, other_position, other_inner) in &seen[..i] {
                if other == opposite
                    && other_position != position
                    && (inner || other_inner)
                    && self.may_cancel(node, other_node)
                {
                    return Some(match (inner, other_inner) {
                        (true, true) => (other_position, Some(position)),
                        (true, false) => (position, None),
                        _ => (other_position, None),
                    });
                }
            }
        }
        None
    }

    /// Whether nodes with multiples of opposite fingerprints have multiples of opposite values.
    fn may_cancel(&self, a: Id, b: Id) -> bool {
        let branches = |id: Id| self.flags(id).has(Flags::BRANCH);
        !branches(a) && !branches(b) || self.same_up_to_sign(a, b)
    }
}
