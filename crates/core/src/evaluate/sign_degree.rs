//! How many lanes a comparison needs: the degree of nodes as polynomials in signs.
//!
//! In a lane each independent sign is 1 or -1 as if by the toss of a coin. A polynomial of degree d in signs that is not
//! zero is zero with a probability of at most 1 - 2^-d there (the distance of a Reed-Muller code). An indicator such as
//! (1 + sign x)(1 + sign y)(1 + sign z) is not zero in one of eight lanes only. So the number of lanes grows with the
//! degree, such that what is not zero is zero in all of them with a probability of at most 2^-40.
//!
//! Sums have the largest degree of their terms, products the sum. Any other function of k signs has at most degree k.
//! This is the degree in all signs; [`independent_signs`](super::independent_signs) has that in independent ones.

use rustc_hash::FxHashSet;
use std::sync::Arc;

use crate::graph::{Flags, Function, Graph, Id, Kind, NumberId, Signs, View};

use super::pending::Pending;

/// More signs are not counted.
const MOST_SIGNS: usize = 1023;

/// The place of the sign of a root, which its base has; those of a function have the places from 0.
pub(super) const ROOT: usize = 255;

/// The node to which a sign belongs; `None` for a function that has no node yet.
pub(super) fn node_of(sign: u64) -> Option<Id> {
    u32::try_from(sign >> 8).ok().map(Id)
}

/// Which of the signs of its node a sign is.
pub(super) fn place_of(sign: u64) -> usize {
    usize::from(sign.to_le_bytes()[0])
}

/// The degree of what depends on more signs in another way than by sums and products.
const MANY: usize = 1000;

/// The signs of a function that has no node yet: no node has so large a number.
const PENDING: u64 = u64::MAX << 40;

/// The number of points, each in all the other lanes, for degrees up to 8.
const POINTS: [u16; 9] = [1, 1, 2, 4, 7, 15, 29, 58, 116];

/// The points for degrees up to 6. More are tried only if few nodes have to be evaluated there.
const MOST_POINTS: u16 = 29;
const FEW_NODES: usize = 100;

/// The points that a comparison needs; `None` for degrees that are too large.
pub(super) fn points_for(degree: usize) -> Option<u16> {
    POINTS.get(degree).copied()
}

impl Graph {
    /// The points that a comparison of nodes with these signs needs; `None` if there are too many for what is below them.
    pub(super) fn points_for(&self, signs: &Signs, nodes: &[Id]) -> Option<u16> {
        let points = match &signs.all {
            Some(all) if all.len() > 2 => points_for(self.degree_in_independent(all, signs.degree)),
            _ => points_for(signs.degree),
        }?;
        (points <= MOST_POINTS || self.hold_few_signs(nodes)).then_some(points)
    }

    /// Whether few nodes hold signs. The search ends when they are many, however many there are: a large Jacobian asks for
    /// each of its nodes.
    fn hold_few_signs(&self, nodes: &[Id]) -> bool {
        let (mut waiting, mut seen) = (nodes.to_vec(), FxHashSet::default());
        while let Some(id) = waiting.pop() {
            if self.flags(id).has(Flags::BRANCH) && seen.insert(id) {
                if seen.len() > FEW_NODES {
                    return false;
                }
                self.push_children(id, &mut waiting);
            }
        }
        true
    }

    /// The signs of a difference.
    pub(super) fn signs_of_both(&self, pending: Pending<'_>, id: Id) -> Signs {
        let (one, two) = (self.signs_of(pending), self.signs(id));
        Signs { degree: one.degree.max(two.degree), ..union(&one, &two) }
    }

    /// The signs that a node depends on.
    pub(super) fn signs(&self, id: Id) -> Signs {
        let known = |id: Id| self.lanes.borrow().signs(id).cloned();
        if let Some(signs) = known(id) {
            return signs;
        }
        let is_unknown = |id: Id| self.flags(id).has(Flags::BRANCH) && known(id).is_none();
        for node in self.post_order_where(&[id], is_unknown) {
            let signs = self.signs_from_parts(node);
            self.lanes.borrow_mut().insert_signs(node, signs);
        }
        known(id).unwrap_or_else(none)
    }

    /// The signs that something depends on.
    pub(super) fn signs_of(&self, pending: Pending<'_>) -> Signs {
        match pending {
            Pending::Node(id) => self.signs(id),
            Pending::Sum(terms) => self.signs_of_sum(terms.iter().map(|&(_, id)| id)),
            Pending::Product(factors) => self.signs_of_product(factors.iter().copied()),
            Pending::Function(function, args) => self.signs_of_function(function, args, PENDING),
        }
    }

    fn signs_from_parts(&self, id: Id) -> Signs {
        match self.view(id) {
            View::Scale(_, child) => self.signs(child),
            View::Sum(terms) => self.signs_of_sum(terms.iter().map(|(_, node)| node)),
            View::Product(factors) => self.signs_of_product(factors.iter()),
            View::Function(function, args) => {
                let words: Vec<u32> = self.represented(args).map(|arg| arg.0).collect();
                let known = self.row(Kind::Function(function), &words).unwrap_or(id);
                self.signs_of_function(function, &args.iter().collect::<Vec<_>>(), u64::from(known.0) << 8)
            }
            _ => {
                let all =
                    self.children(id).into_iter().fold(none(), |all, child| union(&all, &self.signs(child)));
                closed(all)
            }
        }
    }

    fn signs_of_sum(&self, ids: impl Iterator<Item = Id>) -> Signs {
        ids.fold(none(), |sum, id| {
            let signs = self.signs(id);
            Signs { degree: sum.degree.max(signs.degree), ..union(&sum, &signs) }
        })
    }

    fn signs_of_product(&self, factors: impl Iterator<Item = (Id, NumberId)>) -> Signs {
        let product = factors.fold(none(), |product, (base, exponent)| {
            let exponent = self.get_number(exponent);
            let base = if exponent.is_integer() { base } else { self.representative(base) };
            let mut signs = self.signs(base);
            let power = exponent.to_i64().and_then(|n| usize::try_from(n).ok());
            match power {
                Some(n) => signs.degree = signs.degree.saturating_mul(n),
                None if self.is_branching(base, exponent) => {
                    signs = with_signs(&signs, u64::from(base.0) << 8 | ROOT as u64, 1);
                }
                None => signs = closed(signs),
            }
            let degree = product.degree.saturating_add(signs.degree);
            Signs { degree, ..union(&product, &signs) }
        });
        let most = count(&product);
        Signs { degree: product.degree.min(most), ..product }
    }

    /// The signs of a function, which is evaluated for the nodes that stand for its arguments.
    fn signs_of_function(&self, function: Function, args: &[Id], token: u64) -> Signs {
        let args: Vec<Id> = args.iter().map(|&arg| self.representative(arg)).collect();
        let all = args.iter().fold(none(), |all, &arg| union(&all, &self.signs(arg)));
        let own = match function {
            Function::Abs | Function::Sign if !self.has_real_values(args[0]) => 2, // that of its norm, too
            Function::Abs | Function::Sign | Function::Atan2 | Function::Power => 1,
            Function::Min | Function::Max => args.len() - 1,
            Function::Piecewise => args.len() / 2,
            Function::Sin | Function::Cos | Function::Tan => self.roots_of_angle(args[0]).len(),
            Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh => {
                usize::from(self.makes_roots(args[0], true))
            }
            _ => 0,
        };
        with_signs(&all, token, own)
    }
}

fn none() -> Signs {
    Signs { all: Some(Arc::new([])), degree: 0 }
}

fn count(signs: &Signs) -> usize {
    signs.all.as_ref().map_or(MANY, |all| all.len())
}

/// All signs of both, with a degree that is still to be found.
fn union(a: &Signs, b: &Signs) -> Signs {
    let all = match (&a.all, &b.all) {
        (Some(a), Some(b)) if b.is_empty() => Some(Arc::clone(a)),
        (Some(a), Some(b)) if a.is_empty() => Some(Arc::clone(b)),
        (Some(a), Some(b)) => {
            let mut all: Vec<u64> = a.iter().chain(b.iter()).copied().collect();
            all.sort_unstable();
            all.dedup();
            (all.len() <= MOST_SIGNS).then(|| all.into())
        }
        _ => None,
    };
    Signs { all, degree: 0 }
}

/// The signs of an arbitrary function of signs.
fn closed(signs: Signs) -> Signs {
    Signs { degree: count(&signs), ..signs }
}

/// The signs of a function of signs that has some of its own.
fn with_signs(signs: &Signs, token: u64, own: usize) -> Signs {
    let own: Arc<[u64]> = (0..own as u64).map(|k| token + k).collect();
    closed(union(signs, &Signs { all: Some(own), degree: 0 }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::Assumption;

    /// Max(x0, 0) Max(x1, 0) ... is not zero, though it is in all but one of 2^n lanes.
    #[test]
    fn products_of_indicators_are_not_zero() -> Result<(), Error> {
        let g = &mut Graph::new();
        let mut product = Id::ONE;
        for k in 0..12 {
            let x = g.symbol(&format!("x{k}"), Assumption::Real);
            let part = g.apply(Function::Max, &[x, Id::ZERO])?;
            product = g.mul(product, part)?;
            assert_ne!(product, Id::ZERO);
            let negative = g.apply(Function::Min, &[x, Id::ZERO])?;
            let both = g.mul(part, negative)?;
            assert_eq!(both, Id::ZERO);
        }
        Ok(())
    }

    /// The search may end early, but it counts each node once, as many as are few and not one more.
    #[test]
    fn few_signs_are_counted_exactly() -> Result<(), Error> {
        let g = &mut Graph::new();
        let x = g.symbol("x", Assumption::Real);
        let mut node = g.apply(Function::Abs, &[x])?;
        for expected in 1..=FEW_NODES + 3 {
            let counted = g.post_order_where(&[node, node], |id| g.flags(id).has(Flags::BRANCH)).len();
            assert_eq!(counted, expected);
            assert_eq!(g.hold_few_signs(&[node, node]), expected <= FEW_NODES, "{expected}");
            node = g.apply(Function::Sin, &[node])?;
        }
        Ok(())
    }
}
