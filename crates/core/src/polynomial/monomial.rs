//! Products of integer powers of numbered atoms.

use std::cmp::Ordering;

/// Expansions open exponents below a few hundred only, and the budget of terms bounds how often they are multiplied.
const EXPONENT: &str = "an exponent of an expanded term has fewer than 63 bits";

/// A product of integer powers of atoms.
///
/// Invariants: atoms ascend; no exponent is zero.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct Monomial(Vec<(u32, i64)>);

impl Monomial {
    /// The product of powers, whose atoms ascend.
    pub(crate) const fn of(factors: Vec<(u32, i64)>) -> Self {
        Self(factors)
    }

    pub(crate) fn power(atom: u32, exponent: i64) -> Self {
        if exponent == 0 { Self::default() } else { Self(vec![(atom, exponent)]) }
    }

    pub(crate) fn factors(&self) -> &[(u32, i64)] {
        &self.0
    }

    pub(crate) fn is_one(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn exponent(&self, atom: u32) -> i64 {
        self.0.binary_search_by_key(&atom, |&(a, _)| a).map_or(0, |at| self.0[at].1)
    }

    /// The sum of the magnitudes of the exponents.
    pub(crate) fn degree(&self) -> u64 {
        self.0.iter().map(|&(_, e)| e.unsigned_abs()).sum()
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        self.joined(other, |e| e)
    }

    pub(crate) fn over(&self, divisor: &Self) -> Self {
        self.joined(divisor, |e| e.checked_neg().expect(EXPONENT))
    }

    /// The product with another monomial, whose exponents are taken as `sign` says.
    fn joined(&self, other: &Self, sign: impl Fn(i64) -> i64) -> Self {
        let mut out = Vec::with_capacity(self.0.len() + other.0.len());
        let (mut left, mut right) = (&self.0[..], &other.0[..]);
        while let ([(a, e), left_rest @ ..], [(b, f), right_rest @ ..]) = (left, right) {
            match a.cmp(b) {
                Ordering::Less => {
                    out.push((*a, *e));
                    left = left_rest;
                }
                Ordering::Greater => {
                    out.push((*b, sign(*f)));
                    right = right_rest;
                }
                Ordering::Equal => {
                    let sum = e.checked_add(sign(*f)).expect(EXPONENT);
                    if sum != 0 {
                        out.push((*a, sum));
                    }
                    (left, right) = (left_rest, right_rest);
                }
            }
        }
        out.extend_from_slice(left);
        out.extend(right.iter().map(|&(b, f)| (b, sign(f))));
        Self(out)
    }

    pub(crate) fn pow(&self, n: i64) -> Self {
        if n == 0 {
            return Self::default();
        }
        Self(self.0.iter().map(|&(a, e)| (a, e.checked_mul(n).expect(EXPONENT))).collect())
    }

    /// The factors whose atom passes the test, and the others.
    pub(crate) fn split(&self, pick: impl Fn(u32) -> bool) -> (Self, Self) {
        let (picked, rest) = self.0.iter().partition(|&&(atom, _)| pick(atom));
        (Self(picked), Self(rest))
    }

    pub(crate) fn is_natural(&self) -> bool {
        self.0.iter().all(|&(_, e)| e > 0)
    }

    /// The square root, if all exponents are even.
    pub(super) fn halved(&self) -> Option<Self> {
        let half: Vec<_> = self.0.iter().map(|&(a, e)| (a, e / 2)).collect();
        self.0.iter().all(|&(_, e)| e % 2 == 0).then_some(Self(half))
    }
}

/// Compare the exponents of the atoms lexicographically; multiplication keeps this order.
impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> Ordering {
        for position in 0.. {
            let (left, right) = (self.0.get(position), other.0.get(position));
            let decided = match (left, right) {
                (None, None) => return Ordering::Equal,
                (Some((_, e)), None) => e.cmp(&0),
                (None, Some((_, f))) => 0.cmp(f),
                (Some((a, e)), Some((b, f))) => match a.cmp(b) {
                    Ordering::Less => e.cmp(&0),
                    Ordering::Greater => 0.cmp(f),
                    Ordering::Equal => e.cmp(f),
                },
            };
            if decided != Ordering::Equal {
                return decided;
            }
        }
        Ordering::Equal
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_keep_the_order_of_monomials() {
        let monomials: Vec<Monomial> = [&[(0, 1)][..], &[(0, -1), (1, 2)], &[(1, 1)], &[], &[(2, 3)]]
            .map(|f| Monomial::of(f.to_vec()))
            .to_vec();
        for a in &monomials {
            for b in &monomials {
                for c in &monomials {
                    assert_eq!(a.cmp(b), a.times(c).cmp(&b.times(c)));
                }
            }
        }
    }
}
