//! How many independent signs a comparison meets: sign(x y) is the product of sign x and sign y, in every lane.
//!
//! The degree of an expression as a polynomial in signs counts each sign once. If some signs are products of others, the
//! degree in those that are independent is larger: 1 + sign x + sign y + sign(x y) = (1 + sign x)(1 + sign y). So the signs
//! are compared as vectors of bits, one for each lane, and Gauss's elimination over GF(2) finds which ones are products
//! of how many others. The same vectors tell that sign x and sign(2 x) are one sign.

use rustc_hash::FxHashSet;

use crate::graph::{Atom, Coin, Flags, Function, Graph, Id, View};
use crate::value::{FieldId, Key, Quadratic};

use super::sign_degree::{ROOT, node_of, place_of};

/// Vectors of 62 bits don't tell more signs than this apart from random ones.
const MOST_INDEPENDENT: usize = 40;

/// A root in the sine of an inverse function: that of the sine or cosine itself, or that of half of its angle.
pub(super) struct RootOfAngle {
    atom: Atom,
    is_half: bool,
}

impl Graph {
    /// The degree in independent signs of what has this degree in some signs.
    pub(super) fn degree_in_independent(&self, signs: &[u64], degree: usize) -> usize {
        let (mut vectors, mut others) = (Vec::new(), FxHashSet::default());
        for &sign in signs {
            match self.coin(sign) {
                Coin::Vector(vector) => vectors.push(vector),
                Coin::Other(key) => {
                    others.insert(key);
                }
            }
        }
        let (rank, most_factors) = independent(&vectors);
        degree.saturating_mul(most_factors).min(rank + others.len())
    }

    fn coin(&self, sign: u64) -> Coin {
        if let Some(known) = self.lanes.borrow().coin(sign) {
            return known;
        }
        let coin = self.find_coin(sign);
        self.lanes.borrow_mut().insert_coin(sign, coin);
        coin
    }

    fn find_coin(&self, sign: u64) -> Coin {
        let Some(node) = node_of(sign) else { return Coin::Other(sign) };
        let place = place_of(sign);
        if place == ROOT {
            return self.coin_of_root(node);
        }
        let View::Function(function, args) = self.view(node) else { return Coin::Other(sign) };
        let vector = match function {
            Function::Abs | Function::Sign if place == 0 => self.sign_vector(args.get(0)),
            Function::Piecewise => self.sign_vector(args.get(2 * place + 1)),
            Function::Min | Function::Max if args.len() == 2 => {
                let (a, b) = (args.get(0), args.get(1));
                vector(|field| {
                    let f = field.field();
                    let difference = f.sub(&self.value_in(a, field), &self.value_in(b, field));
                    self.sign_of_difference(&difference, a, b, f) == f.one()
                })
            }
            Function::Sin | Function::Cos | Function::Tan => {
                let roots = self.roots_of_angle(args.get(0));
                return roots.get(place).map_or(Coin::Other(sign), |root| self.coin_of_root_of_angle(root));
            }
            Function::Atan2 => {
                let atom = Atom::Atan2(self.representative(args.get(0)), self.representative(args.get(1)));
                return self.coin_of_root_of_angle(&RootOfAngle { atom, is_half: false });
            }
            _ => return Coin::Other(sign),
        };
        Coin::Vector(vector)
    }

    /// The roots that the sine of an argument holds besides those of the argument: the sine of atan(u) has sqrt(1 + u^2).
    pub(super) fn roots_of_angle(&self, argument: Id) -> Vec<RootOfAngle> {
        let is_inverse = |atom: &Atom| matches!(atom, Atom::Asin(_) | Atom::Atan(_) | Atom::Atan2(..));
        let split = self.split_argument(argument, false);
        let parts = split.iter().filter(|(atom, _)| is_inverse(atom));
        parts
            .flat_map(|(atom, factor)| {
                let root = |is_half| RootOfAngle { atom: atom.clone(), is_half };
                [Some(root(false)), (!factor.is_integer()).then(|| root(true))]
            })
            .flatten()
            .collect()
    }

    fn coin_of_root_of_angle(&self, root: &RootOfAngle) -> Coin {
        let name = match root.atom {
            Atom::Asin(_) => "asin",
            Atom::Atan(_) => "atan",
            _ => "atan2",
        };
        let arguments = root.atom.arguments().into_iter();
        let key = arguments.fold(Key::new("root of angle").text(name), |key, argument| {
            key.word(self.representative_up_to_sign(argument).0.0.into())
        });
        Coin::Other(key.word(root.is_half.into()).draw(0))
    }

    /// A root of what holds no signs depends on the sign of that, and a root of anything else on more.
    fn coin_of_root(&self, base: Id) -> Coin {
        if !self.flags(base).has(Flags::BRANCH) {
            return Coin::Vector(self.sign_vector(base));
        }
        let words = |key: Key, value: &Quadratic| value.words().iter().fold(key, |key, &word| key.word(word));
        Coin::Other(self.column(base, 0).iter().fold(Key::new("root of"), words).draw(0))
    }

    fn sign_vector(&self, id: Id) -> u64 {
        vector(|field| !self.is_negative_in(id, field))
    }
}

/// The bits of the other lanes, all of them inverted if the first one is set: a sign and its opposite are one.
fn vector(bit: impl Fn(FieldId) -> bool) -> u64 {
    let bits = FieldId::others(0).fold(0, |bits, field| bits << 1 | u64::from(bit(field)));
    if bits & 1 == 1 { bits ^ ((1 << FieldId::others(0).count()) - 1) } else { bits }
}

/// The rank of vectors over GF(2), and the most vectors of a basis whose product one of them is, at least 1.
fn independent(vectors: &[u64]) -> (usize, usize) {
    // Each with the set of the basis vectors of which it is the sum.
    let mut reduced: Vec<(u64, u64)> = Vec::new();
    let mut most = 1;
    for &vector in vectors {
        let start = (vector, 0);
        let (rest, set) = reduced.iter().fold(start, |(rest, set), &(pivot, of_pivot)| {
            if rest & highest_bit(pivot) == 0 { (rest, set) } else { (rest ^ pivot, set ^ of_pivot) }
        });
        if rest == 0 {
            most = most.max(set.count_ones() as usize);
        } else if reduced.len() < MOST_INDEPENDENT {
            reduced.push((rest, set ^ 1 << reduced.len()));
        } else {
            return (usize::MAX / 2, most);
        }
    }
    (reduced.len(), most)
}

fn highest_bit(word: u64) -> u64 {
    1 << word.ilog2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::{Assumption, NumberId};

    #[test]
    fn sums_of_vectors_have_the_factors_that_they_need() {
        assert_eq!(independent(&[]), (0, 1));
        assert_eq!(independent(&[6, 6, 10]), (2, 1));
        assert_eq!(independent(&[6, 10, 12]), (2, 2));
        assert_eq!(independent(&[2, 4, 8, 14]), (3, 3));
        let unit = |k: usize| 2 << k;
        let many: Vec<u64> = (0..=MOST_INDEPENDENT).map(unit).collect();
        assert_eq!(independent(&many), (usize::MAX / 2, 1));
    }

    /// The sum of the signs of all products of five is zero but where all are positive.
    #[test]
    fn sums_of_signs_of_products_are_not_zero() -> Result<(), Error> {
        let g = &mut Graph::new();
        for trial in 0..20 {
            let factors: Vec<Id> =
                (0..5).map(|k| g.symbol(&format!("x{trial}_{k}"), Assumption::Real)).collect();
            let mut sum = Id::ONE;
            for subset in 1..1usize << factors.len() {
                let mut product = vec![(NumberId::ONE, Id::ONE)];
                for (_, &x) in factors.iter().enumerate().filter(|(k, _)| subset >> k & 1 == 1) {
                    // times x + 1, multiplied out
                    let mut multiplied = product.clone();
                    for &(factor, node) in &product {
                        multiplied.push((factor, g.mul(node, x)?));
                    }
                    product = multiplied;
                }
                let argument = product.iter().fold(Id::ZERO, |sum, &(_, node)| g.add(sum, node));
                let sign = g.apply(Function::Sign, &[argument])?;
                sum = g.add(sum, sign);
            }
            assert_ne!(sum, Id::ZERO);
        }
        Ok(())
    }

    #[test]
    fn scaled_extrema_hold_one_sign() -> Result<(), Error> {
        let g = &mut Graph::new();
        let mut tokens = Vec::new();
        for factor in [1, 7, 67] {
            let mut args = Vec::new();
            for name in ["x", "y"] {
                let symbol = g.symbol(name, Assumption::Real);
                let number = g.integer(factor);
                args.push(g.mul(number, symbol)?);
            }
            let largest = g.apply(Function::Max, &args)?;
            tokens.extend(g.signs(largest).all.iter().flat_map(|all| all.iter().copied()));
        }
        assert_eq!(g.degree_in_independent(&tokens, 9), 1);
        Ok(())
    }
}
