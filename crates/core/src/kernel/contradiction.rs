//! Equations that contradict others: a combination of them vanishes on the left side but not on the right side.
//!
//! Where the rank of A is deficient, some y != 0 have y^T A = 0, and A x = b has a solution only if y^T b = 0 for all
//! of them [Golub & Van Loan 2013, sec. 5.3]. The last columns of Q span these y. They are combined so that each of
//! the equations that `factorization` names has a y of its own, which names the equations that it follows from, or
//! contradicts.

use super::factorization::dependent;

/// The largest y^T b, relative to its terms, that counts as zero: half of the digits.
///
/// Right sides are sums themselves, as those of redundant constraints along a motion: they agree to rounding errors of
/// terms that may be much larger than what is left of them.
const INCONSISTENT: f64 = 1.5e-8;
/// The rounding errors of all entries and of the decomposition, per equation; the same as for the rank.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// An equation takes part in a combination if its share of the combination is at least this large.
const SHARE: f64 = 1e-3;

/// An equation that contradicts others.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Contradiction {
    /// The row of the equation.
    pub equation: usize,
    /// The rows of the equations that it contradicts.
    pub others: Vec<usize>,
}

/// Find the equations that contradict others for a right side, from the factorisation in the workspace.
#[must_use]
pub fn contradictions(n: usize, work: &[f64], right: &[f64]) -> Vec<Contradiction> {
    let named: Vec<usize> = dependent(n, work).collect();
    if named.is_empty() {
        return Vec::new();
    }
    let rank = n - named.len();
    let weights = &work[2 * n * n..][..n];
    let b: Vec<f64> = right.iter().zip(weights).map(|(entry, weight)| entry * weight).collect();
    let size = largest(&b).max(largest_term(n, rank, work, &b));
    vanishing_combinations(n, rank, work, &named)
        .iter()
        .zip(&named)
        .filter(|(y, _)| is_inconsistent(y, &b, size))
        .map(|(y, &equation)| {
            let others = (0..n).filter(|&row| row != equation && y[row].abs() > SHARE * largest(y));
            Contradiction { equation, others: others.collect() }
        })
        .collect()
}

/// Whether y^T b is more than rounding errors, both of its own terms and of all numbers in the system.
#[allow(clippy::cast_precision_loss, reason = "numbers of rows are small")]
fn is_inconsistent(y: &[f64], b: &[f64], size: f64) -> bool {
    let terms: Vec<f64> = y.iter().zip(b).map(|(share, entry)| share * entry).collect();
    let (left, all) = (terms.iter().sum::<f64>(), terms.iter().map(|term| term.abs()).sum::<f64>());
    let length = y.iter().map(|share| share.abs()).sum::<f64>();
    left.abs() > INCONSISTENT * all + ROUNDING * y.len() as f64 * size * length
}

/// The combinations of equations that vanish on the left, one for each of the named equations, in which it has the
/// share 1 and the other named ones have none.
fn vanishing_combinations(n: usize, rank: usize, work: &[f64], named: &[usize]) -> Vec<Vec<f64>> {
    let mut combinations: Vec<Vec<f64>> =
        (rank..n).map(|column| column_of_q(n, rank, work, column)).collect();
    for (c, &equation) in named.iter().enumerate() {
        let share = |y: &[f64]| y[equation].abs();
        let pivot = (c..named.len()).fold(c, |best, other| {
            if share(&combinations[other]) > share(&combinations[best]) { other } else { best }
        });
        combinations.swap(c, pivot);
        let reciprocal = 1.0 / combinations[c][equation];
        combinations[c].iter_mut().for_each(|entry| *entry *= reciprocal);
        let own = combinations[c].clone();
        for (other, y) in combinations.iter_mut().enumerate() {
            if other != c {
                let ratio = y[equation];
                y.iter_mut().zip(&own).for_each(|(entry, part)| *entry -= ratio * part);
            }
        }
    }
    combinations
}

/// A column of Q: the reflections applied to a unit vector, last reflection first.
fn column_of_q(n: usize, rank: usize, work: &[f64], column: usize) -> Vec<f64> {
    let mut y = vec![0.0; n];
    y[column] = 1.0;
    (0..rank).rev().for_each(|k| reflect(n, k, work, &mut y));
    y
}

/// Reflect a vector by the reflection of column k, whose part below the diagonal stands there.
fn reflect(n: usize, k: usize, work: &[f64], y: &mut [f64]) {
    let (factors, tau) = (&work[n * n..2 * n * n], work[2 * n * n + 2 * n + k]);
    let below = || factors.chunks_exact(n).map(|row| row[k]).skip(k + 1);
    let sum = tau * (y[k] + below().zip(&y[k + 1..]).map(|(v, entry)| v * entry).sum::<f64>());
    y[k] -= sum;
    y[k + 1..].iter_mut().zip(below()).for_each(|(entry, v)| *entry -= sum * v);
}

/// The largest term of the left side, coefficient times unknown: the first pivot is the largest coefficient.
fn largest_term(n: usize, rank: usize, work: &[f64], b: &[f64]) -> f64 {
    let factors = &work[n * n..2 * n * n];
    let mut x = b.to_vec();
    (0..rank).for_each(|k| reflect(n, k, work, &mut x));
    for k in (0..rank).rev() {
        let row = &factors[k * n..][..rank];
        let known: f64 = row[k + 1..].iter().zip(&x[k + 1..]).map(|(entry, x)| entry * x).sum();
        x[k] = (x[k] - known) / row[k];
    }
    if rank == 0 { 0.0 } else { factors[0].abs() * largest(&x[..rank]) }
}

fn largest(entries: &[f64]) -> f64 {
    entries.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::factorization::{factor, workspace};

    fn found(rows: &[f64], right: &[f64]) -> Vec<(usize, Vec<usize>)> {
        let n = right.len();
        let mut work = rows.to_vec();
        work.resize(workspace(n), 0.0);
        factor(n, &mut work);
        contradictions(n, &work, right).into_iter().map(|c| (c.equation, c.others)).collect()
    }

    #[test]
    fn equal_left_sides_with_unequal_right_ones() {
        assert_eq!(found(&[1.0; 4], &[1.0, 2.0]), [(1, vec![0])]);
        assert_eq!(found(&[1.0; 4], &[1.0, 1.0]), []);
        assert_eq!(found(&[1.0, 1.0, 2.0, 2.0], &[1.0, 2.0]), []);
    }

    #[test]
    fn rounding_is_no_contradiction() {
        assert_eq!(found(&[1.0; 4], &[1.0, 1.0 + 1e-12]), []);
        assert_eq!(found(&[1.0; 4], &[1.0, 1.0 + 1e-6]), [(1, vec![0])]);
        // What is left of terms that cancel, beside an unknown that is not small.
        let rows = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0];
        assert_eq!(found(&rows, &[9.81, 1e-17, -3e-17]), []);
        assert_eq!(found(&rows, &[9.81, 1e-3, -3e-3]), [(2, vec![1])]);
    }

    #[test]
    fn units_do_not_matter() {
        for unit in [1e-12, 1e-6, 1e6, 1e12] {
            assert_eq!(found(&[1.0, 1.0, unit, unit], &[1.0, 2.0 * unit]), [(1, vec![0])]);
            assert_eq!(found(&[1.0, 1.0, unit, unit], &[1.0, unit]), []);
            assert_eq!(found(&[unit; 4], &[unit, 2.0 * unit]), [(1, vec![0])]);
            assert_eq!(found(&[1.0; 4], &[unit, 2.0 * unit]), [(1, vec![0])]);
        }
    }

    #[test]
    fn each_contradiction_names_its_own_equations() {
        let rows = [
            [1.0, 0.0, 0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0, 0.0],
        ]
        .concat();
        assert_eq!(found(&rows, &[1.0, 1.0, 5.0, 2.0, 3.0]), []);
        assert_eq!(found(&rows, &[1.0, 4.0, 5.0, 2.0, 3.0]), [(1, vec![0])]);
        assert_eq!(found(&rows, &[1.0, 1.0, 6.0, 2.0, 3.0]), [(4, vec![2, 3])]);
        assert_eq!(found(&rows, &[1.0, 4.0, 6.0, 2.0, 3.0]), [(1, vec![0]), (4, vec![2, 3])]);
    }

    #[test]
    fn an_equation_without_unknowns_contradicts_itself() {
        assert_eq!(found(&[0.0; 4], &[1.0, 0.0]), [(0, vec![])]);
        assert_eq!(found(&[0.0; 4], &[0.0, 0.0]), []);
    }
}
