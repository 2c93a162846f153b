//! Sums that others share: `a + b + c` and `d - 2 a - 2 b` become `s + c` and `d - 2 s` with `s = a + b`.
//!
//! A sum of many terms can be added up in many orders, and two sums share what they have in common only if both begin
//! with it. Sums that only one other sum uses are opened first. Then the pair of terms, up to a factor, that most sums
//! hold becomes a sum of its own, and so on: the greedy choice [Breuer 1969].

use std::cmp::Reverse;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::graph::{Graph, Id, NumberId, View};
use crate::interrupt::tick;

/// Sums of more terms are not searched.
const LONGEST_SUM: usize = 48;
/// The most pairs of one round.
const MOST_PAIRS: usize = 1_000_000;
/// The most rounds; each shares all pairs that it finds.
const ROUNDS: usize = 32;

/// A term's node, or a sum that was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Part {
    Node(Id),
    Shared(usize),
}

type Term = (NumberId, Part);

/// Two terms, the second as a multiple of the first.
type Pair = (Part, Part, NumberId);

impl Graph {
    /// The roots in forms whose sums share common parts, if these take fewer operations beside the `others`.
    ///
    /// The nodes of the others stay as they are, since these are computed anyway.
    pub fn with_shared_sums(&mut self, roots: &[Id], others: &[Id]) -> Vec<Id> {
        self.choose_form(|graph| {
            let cost = |graph: &Self, forms: &[Id]| graph.cost(&[others, forms].concat()).total();
            let mut best = roots.to_vec();
            let mut least = cost(graph, &best);
            for opens in [true, false] {
                let Some(forms) = SharedSums::of(graph, roots, others, opens).built(graph, roots) else {
                    continue;
                };
                let found = cost(graph, &forms);
                if found < least {
                    (least, best) = (found, forms);
                }
            }
            best
        })
    }
}

/// The sums of some expressions, and those that they share.
struct SharedSums {
    sums: Vec<Vec<Term>>,
    /// The sums that are nodes.
    places: FxHashMap<Id, usize>,
    kept: FxHashSet<Id>,
}

impl SharedSums {
    /// The sums below the roots with their common parts taken out; with `opens`, sums that are used once are opened.
    fn of(graph: &mut Graph, roots: &[Id], others: &[Id], opens: bool) -> Self {
        let kept = graph.post_order(others).into_iter().collect();
        let mut shared = Self { sums: Vec::new(), places: FxHashMap::default(), kept };
        shared.collect(graph, roots, opens);
        for _ in 0..ROUNDS {
            if !shared.share_pairs(graph) {
                break;
            }
        }
        shared.take_out_numbers(graph);
        shared
    }

    fn collect(&mut self, graph: &mut Graph, roots: &[Id], opens: bool) {
        let order = graph.post_order_where(roots, |id| !self.is_fixed(graph, id));
        let mut uses: FxHashMap<Id, usize> = FxHashMap::default();
        let mut children = roots.to_vec();
        for &id in &order {
            graph.push_children(id, &mut children);
        }
        for child in children {
            *uses.entry(child).or_default() += 1;
        }
        for &id in &order {
            let View::Sum(terms) = graph.view(id) else { continue };
            let terms: Vec<(NumberId, Id)> = terms.iter().collect();
            let mut opened: Vec<Term> = Vec::with_capacity(terms.len());
            for (factor, node) in terms {
                match self.places.get(&node) {
                    Some(&place)
                        if opens
                            && uses.get(&node) == Some(&1)
                            && graph.depends_on_time(node) == graph.depends_on_time(id)
                            && opened.len() + self.sums[place].len() <= LONGEST_SUM =>
                    {
                        for (inner, part) in std::mem::take(&mut self.sums[place]) {
                            let inner = graph.times(factor, inner);
                            add_term(graph, &mut opened, (inner, part));
                        }
                    }
                    _ => add_term(graph, &mut opened, (factor, Part::Node(node))),
                }
            }
            self.places.insert(id, self.sums.len());
            self.sums.push(opened);
        }
    }

    /// Whether a node stays as it is.
    fn is_fixed(&self, graph: &Graph, id: Id) -> bool {
        graph.is_constant(id) || self.kept.contains(&id)
    }

    /// Give each pair of terms that two sums hold a sum of its own, the most frequent pairs first.
    fn share_pairs(&mut self, graph: &mut Graph) -> bool {
        let mut is_shared = false;
        for (pair, places) in self.pairs(graph) {
            let held: Vec<(usize, NumberId)> = places
                .into_iter()
                .filter_map(|place| Some((place, factor_of(graph, &self.sums[place], pair)?)))
                .collect();
            if held.len() < 2 {
                continue;
            }
            let (first, second, ratio) = pair;
            let part = Part::Shared(self.sums.len());
            for (place, factor) in held {
                let terms = &mut self.sums[place];
                terms.retain(|&(_, part)| part != first && part != second);
                terms.push((factor, part));
            }
            self.sums.push(vec![(NumberId::ONE, first), (ratio, second)]);
            is_shared = true;
        }
        is_shared
    }

    /// The pairs that several sums hold, each with the places of these sums; the most frequent ones first.
    fn pairs(&self, graph: &mut Graph) -> Vec<(Pair, Vec<usize>)> {
        let mut index: FxHashMap<Pair, usize> = FxHashMap::default();
        let mut pairs: Vec<(Pair, Vec<usize>)> = Vec::new();
        for (place, terms) in self.sums.iter().enumerate() {
            tick();
            if terms.len() > LONGEST_SUM {
                continue;
            }
            for (k, &one) in terms.iter().enumerate() {
                for &other in &terms[..k] {
                    let Some(pair) = pair_of(graph, one, other) else { continue };
                    if pairs.len() >= MOST_PAIRS {
                        return Vec::new();
                    }
                    let found = *index.entry(pair).or_insert_with(|| {
                        pairs.push((pair, Vec::new()));
                        pairs.len() - 1
                    });
                    pairs[found].1.push(place);
                }
            }
        }
        pairs.retain(|(_, places)| places.len() > 1);
        pairs.sort_by_key(|(_, places)| Reverse(places.len())); // stable: equal ones in the order of the sums
        pairs
    }

    /// Take out the numbers that several terms of a sum have, up to sign: 2 a - 2 b + c becomes 2 (a - b) + c.
    fn take_out_numbers(&mut self, graph: &mut Graph) {
        for place in 0..self.sums.len() {
            let mut groups: Vec<(NumberId, Vec<Term>)> = Vec::new();
            for &(factor, part) in &self.sums[place] {
                let size = graph.get_number(factor).abs();
                let sign = graph.get_number(factor).is_negative();
                let size = graph.number_id(&size);
                let term = (if sign { NumberId::MINUS_ONE } else { NumberId::ONE }, part);
                match groups.iter_mut().find(|(known, _)| *known == size) {
                    Some((_, group)) => group.push(term),
                    None => groups.push((size, vec![term])),
                }
            }
            let mut terms = Vec::new();
            for (size, group) in groups {
                if size == NumberId::ONE || group.len() < 2 {
                    terms.extend(group.into_iter().map(|(sign, part)| (graph.times(size, sign), part)));
                } else {
                    terms.push((size, Part::Shared(self.sums.len())));
                    self.sums.push(group);
                }
            }
            self.sums[place] = terms;
        }
    }

    /// The nodes of the roots, or None if a value could not be kept.
    fn built(&self, graph: &mut Graph, roots: &[Id]) -> Option<Vec<Id>> {
        let mut known: FxHashMap<Part, Id> = FxHashMap::default();
        let mut stack: Vec<(Part, bool)> =
            roots.iter().rev().map(|&root| (Part::Node(root), false)).collect();
        while let Some((part, is_ready)) = stack.pop() {
            if known.contains_key(&part) {
                continue;
            }
            if is_ready {
                let node = self.node_of(graph, part, &known)?;
                known.insert(part, node);
            } else {
                stack.push((part, true));
                stack.extend(self.parts_of(graph, part).into_iter().map(|child| (child, false)));
            }
        }
        let forms: Vec<Id> = roots.iter().map(|&root| known[&Part::Node(root)]).collect();
        roots.iter().zip(&forms).all(|(&root, &form)| graph.same(root, form)).then_some(forms)
    }

    fn terms_of(&self, part: Part) -> Option<&[Term]> {
        let place = match part {
            Part::Shared(place) => place,
            Part::Node(id) => *self.places.get(&id)?,
        };
        Some(&self.sums[place])
    }

    fn parts_of(&self, graph: &Graph, part: Part) -> Vec<Part> {
        if let Some(terms) = self.terms_of(part) {
            return terms.iter().map(|&(_, part)| part).collect();
        }
        match part {
            Part::Node(id) if !self.is_fixed(graph, id) => {
                graph.children(id).into_iter().map(Part::Node).collect()
            }
            _ => Vec::new(),
        }
    }

    fn node_of(&self, graph: &mut Graph, part: Part, known: &FxHashMap<Part, Id>) -> Option<Id> {
        if let Some(terms) = self.terms_of(part) {
            let terms: Vec<(NumberId, Id)> =
                terms.iter().map(|&(factor, part)| (factor, known[&part])).collect();
            return Some(graph.sum(&terms));
        }
        let Part::Node(id) = part else { return None };
        let map = |_: &Graph, child: Id| known.get(&Part::Node(child)).copied().unwrap_or(child);
        let changed = graph.children(id).into_iter().any(|child| map(graph, child) != child);
        if changed { graph.rebuild(id, &map).ok() } else { Some(id) }
    }
}

/// Add a term to others, which are of different parts.
fn add_term(graph: &mut Graph, terms: &mut Vec<Term>, (factor, part): Term) {
    match terms.iter().position(|&(_, known)| known == part) {
        None => terms.push((factor, part)),
        Some(place) => {
            let total = graph.get_number(terms[place].0).add(graph.get_number(factor));
            if total.is_zero() {
                terms.remove(place);
            } else {
                terms[place].0 = graph.number_id(&total);
            }
        }
    }
}

/// The pair of two terms, in an order that depends on values alone; None if their ratio is not exact.
fn pair_of(graph: &mut Graph, (a, one): Term, (b, other): Term) -> Option<Pair> {
    let is_swapped = match (one, other) {
        (Part::Node(x), Part::Node(y)) => graph.compare_values(x, y).is_gt(),
        (Part::Shared(x), Part::Shared(y)) => x > y,
        (Part::Shared(_), Part::Node(_)) => true,
        (Part::Node(_), Part::Shared(_)) => false,
    };
    let (first, second, a, b) = if is_swapped { (other, one, b, a) } else { (one, other, a, b) };
    if a == b {
        return Some((first, second, NumberId::ONE));
    }
    let (a, b) = (graph.get_number(a), graph.get_number(b));
    if a.is_decimal() || b.is_decimal() {
        return None;
    }
    let ratio = b.mul(&a.recip().ok()?);
    Some((first, second, graph.number_id(&ratio)))
}

/// The factor of a pair in a sum, if the sum holds it.
fn factor_of(graph: &mut Graph, terms: &[Term], pair: Pair) -> Option<NumberId> {
    let held = |part: Part| terms.iter().copied().find(|&(_, known)| known == part);
    let (first, second) = (held(pair.0)?, held(pair.1)?);
    (pair_of(graph, first, second)? == pair).then_some(first.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::Assumption;
    use crate::value::Number;

    #[test]
    fn sums_share_what_they_have_in_common_up_to_a_factor() {
        let g = &mut Graph::new();
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| g.symbol(name, Assumption::Real));
        let minus_two = g.number_id(&Number::integer(-2));
        let one = g.sum(&[(NumberId::ONE, a), (NumberId::ONE, b), (NumberId::ONE, c)]);
        let two = g.sum(&[(NumberId::ONE, d), (minus_two, a), (minus_two, b)]);
        let forms = g.with_shared_sums(&[one, two], &[]);
        assert_eq!(g.cost(&[one, two]).total(), 6);
        assert_eq!(g.cost(&forms).total(), 4);
        assert!(g.equal(forms[0], one) && g.equal(forms[1], two));
    }

    #[test]
    fn sums_used_once_are_opened_and_others_stay() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c, d, x] = ["a", "b", "c", "d", "x"].map(|name| g.symbol(name, Assumption::Real));
        let (ab, cd) = (g.add(a, b), g.add(c, d));
        let nested = g.add(ab, cd); // (a + b) + (c + d)
        let bc = g.add(b, c);
        let other = g.mul(bc, x)?;
        let forms = g.with_shared_sums(&[nested], &[other]);
        assert_eq!(g.cost(&[other, nested]).total(), 5);
        assert_eq!(g.cost(&[other, forms[0]]).total(), 5); // b + c is computed anyway, but it is no part of the roots
        let forms = g.with_shared_sums(&[nested, other], &[]);
        assert_eq!(g.cost(&forms).total(), 4);
        Ok(())
    }
}
