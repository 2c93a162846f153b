//! The form that a textbook prints: flat sums, with common factors outside a whole sum only.
//!
//! Polynomials of the expression with different treatments of sines and cosines are arranged in a few ways, and the one
//! whose text is shortest is the result. What a reader stumbles over counts as further characters: a factor that
//! occurs again inside the brackets it stands before (Horner's nesting), multiples of angles, fractions inside
//! brackets, differences of parameters. The form may cost more operations; it is for the page, never for code.

mod arrangement;
mod flat_form;
mod reading;
mod wave_product;
mod wave_square;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::error::Error;
use crate::graph::{Function, Graph, Id, View};
use crate::polynomial::Budget;
use crate::print::compare_names;

use super::expand::Opening;
use super::ring::Ring;

/// Parts with more nodes, and polynomials with more terms, stay as they are.
const LARGEST_PART: usize = 1_500;
const TERMS: usize = 200;
/// The most terms of a sum of products of waves.
const JOINED: usize = 200;
/// The most terms handled for one part.
const WORK: usize = 30_000;
/// The same for squares that are completed.
const WORK_ON_SQUARES: usize = 3_000;
/// The most operations of an expression whose form is looked for from the expanded one, too: there, no bracket hides a
/// term from another one.
const EXPANDED: u64 = 40;
/// The terms of a long polynomial.
const LONG: usize = 16;

impl Graph {
    /// The form of an expression for the reader: of the forms that are tried, the one that reads shortest. Its text is
    /// never longer than the given one.
    ///
    /// # Errors
    /// If a part cannot be rebuilt.
    pub fn readable(&mut self, id: Id) -> Result<Id, Error> {
        let found = self.form_of_given_or_expanded(id, true)?;
        Ok(if self.is_no_longer(found, id) { found } else { id })
    }

    /// The form of an expression on the page of a textbook: the text may be longer than the given one where that has
    /// what a reader stumbles over.
    ///
    /// # Errors
    /// If a part cannot be rebuilt.
    pub fn textbook_form(&mut self, id: Id) -> Result<Id, Error> {
        self.form_of_given_or_expanded(id, false)
    }

    fn form_of_given_or_expanded(&mut self, id: Id, is_bounded: bool) -> Result<Id, Error> {
        let form = self.form_for_reader(id, is_bounded)?;
        if self.tree_cost(&[id]).total() > EXPANDED {
            return Ok(form);
        }
        let Ok(expanded) = self.choose_form(|graph| graph.expand(id)) else { return Ok(form) };
        if expanded == id {
            return Ok(form);
        }
        let other = self.form_for_reader(expanded, is_bounded)?;
        let is_taken = !is_bounded || self.is_no_longer(other, id);
        let is_better =
            is_taken && other != form && self.same(other, id) && self.reading(other) < self.reading(form);
        Ok(if is_better { other } else { form })
    }

    fn form_for_reader(&mut self, id: Id, is_bounded: bool) -> Result<Id, Error> {
        if self.is_larger(id, LARGEST_PART) {
            return Ok(id); // nobody reads it
        }
        self.choose_form(|graph| {
            let flat = graph.with_flat_sums(id)?;
            let joined = graph.inside_out(flat, Self::push_sums, &mut |graph, part| {
                let joined = graph.joined_waves(part)?;
                let is_taken = !is_bounded || graph.is_no_longer(joined, part);
                Ok(if is_taken { joined } else { part })
            })?;
            graph.inside_out(joined, Self::push_enclosed, &mut |graph, part| {
                Ok(graph.most_readable(part, is_bounded))
            })
        })
    }

    fn is_no_longer(&self, form: Id, given: Id) -> bool {
        let length = |id| self.to_text(id).chars().count();
        form == given || length(form) <= length(given)
    }

    /// A sum of products of waves as one of waves of sums, if that has fewer terms: a chain of rotations about one
    /// axis, from the innermost outwards, takes the sum of its angles, with little work. Sums in which no wave stands
    /// stay closed.
    fn joined_waves(&mut self, part: Id) -> Result<Id, Error> {
        if !self.is_sum(self.without_number(part)) {
            return Ok(part);
        }
        let atoms = self.atoms_by_name(part);
        let closed = self.sums_without_waves(part);
        let mut ring = Ring::with_atoms(self, Budget::new(JOINED, WORK), &atoms);
        let Ok(sum) = ring.polynomial_over(part, Opening::Products, closed) else { return Ok(part) };
        if sum.len() > JOINED || !ring.has_pairs(&sum) {
            return Ok(part);
        }
        match ring.combined(&sum) {
            Ok(combined) if combined.len() < sum.len() && ring.is_linear_in_waves(&combined) => {
                ring.node_of(&combined)
            }
            _ => Ok(part),
        }
    }

    /// The node itself if it is a sum, and what it encloses.
    fn push_sums(&self, id: Id, out: &mut FxHashSet<Id>) {
        self.push_enclosed(id, out);
        if self.is_sum(id) {
            out.insert(id);
        }
    }

    /// The sums in a part in whose terms no sine or cosine stands.
    fn sums_without_waves(&self, part: Id) -> FxHashSet<Id> {
        let mut with_waves: FxHashSet<Id> = FxHashSet::default();
        let mut found: FxHashSet<Id> = FxHashSet::default();
        for id in self.post_order(&[part]) {
            let is_wave = matches!(self.view(id), View::Function(Function::Sin | Function::Cos, _));
            if is_wave || self.children(id).iter().any(|child| with_waves.contains(child)) {
                with_waves.insert(id);
            } else if self.is_sum(id) {
                found.insert(id);
            }
        }
        found
    }

    fn most_readable(&mut self, part: Id, is_bounded: bool) -> Id {
        if self.is_larger(part, LARGEST_PART) {
            return part;
        }
        // A sum that is kept closed takes the place of what equals it, so that each opening has a ring of its own.
        let budget = Budget::new(TERMS, WORK);
        let atoms = self.atoms_by_name(part);
        let mut candidates = Vec::new();
        if self.has_closed_sums(part) {
            candidates = Ring::with_atoms(self, budget, &atoms).closed_forms(part);
        }
        let mut ring = Ring::with_atoms(self, budget, &atoms);
        for polynomial in ring.flat_forms(part) {
            candidates.extend(ring.arrangements(&polynomial));
            candidates.extend(ring.over_common_denominator(&polynomial));
            if let Ok(Some(tangents)) = ring.in_tangents(&polynomial) {
                candidates.extend(ring.arrangements(&tangents));
            }
        }
        let mut ring = Ring::with_atoms(self, budget, &atoms);
        for polynomial in ring.forms_over_parameters(part) {
            candidates.extend(ring.arrangements(&polynomial));
        }
        self.best_reading(part, candidates, is_bounded)
    }

    /// The candidate that reads best. Most are told by the least length that their texts can have.
    fn best_reading(&self, part: Id, candidates: Vec<Id>, is_bounded: bool) -> Id {
        let mut best = (self.reading(part), part);
        let longest = if is_bounded { best.0.2.chars().count() } else { usize::MAX };
        let mut seen: FxHashSet<Id> = FxHashSet::default();
        let mut known: FxHashMap<Id, usize> = FxHashMap::default();
        let mut measured: Vec<(usize, Id)> = Vec::new();
        for candidate in candidates {
            if seen.insert(candidate) && self.same(candidate, part) {
                measured.push((self.least_length(candidate, &mut known), candidate));
            }
        }
        measured.sort_by_key(|&(length, _)| length);
        for (length, candidate) in measured {
            if length > best.0.0 || length + self.awkwardness(candidate) > best.0.0 {
                continue;
            }
            let reading = self.reading(candidate);
            if reading < best.0 && reading.2.chars().count() <= longest {
                best = (reading, candidate);
            }
        }
        best.1
    }

    fn is_larger(&self, part: Id, limit: usize) -> bool {
        let mut seen: FxHashSet<Id> = FxHashSet::default();
        let mut stack = vec![part];
        while let Some(id) = stack.pop() {
            if seen.insert(id) {
                self.push_children(id, &mut stack);
            }
            if seen.len() > limit {
                return true;
            }
        }
        false
    }

    /// The nodes that may be atoms of a part by kind and name, so that among equal arrangements names decide and not the
    /// order in which the part was put together.
    fn atoms_by_name(&self, part: Id) -> Vec<Id> {
        let mut named: Vec<(u8, String, Id)> = Vec::new();
        for id in self.post_order(&[part]) {
            let kind = match self.view(id) {
                View::Symbol(..) => 0,
                View::TimeFunction(..) => 1,
                View::Application { .. } => 2,
                View::Function(..) => 3,
                _ => continue,
            };
            named.push((kind, self.to_text(id), id));
        }
        named.sort_by(|(a, x, _), (b, y, _)| {
            a.cmp(b).then_with(|| compare_names(x, y)).then_with(|| x.cmp(y))
        });
        named.into_iter().map(|(_, _, id)| id).collect()
    }
}

impl<'g> Ring<'g> {
    /// A ring whose first atoms are given.
    fn with_atoms(graph: &'g mut Graph, budget: Budget, atoms: &[Id]) -> Self {
        let mut ring = Self::new(graph, budget);
        for &id in atoms {
            ring.atom(id);
        }
        ring
    }
}
