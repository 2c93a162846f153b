//! Solutions of A x = b for small symmetric positive definite matrices: A = L D L^T without pivoting.
//!
//! A pivot is what elimination leaves of its diagonal entry, and that fraction does not depend on units. Where nearly
//! nothing is left, or the matrix isn't symmetric, the system needs pivoting (`factorization`). The sizes are constants
//! of the compiler, which unrolls the loops: multipliers of a few constraints take half of the time
//! [Golub & Van Loan 2013, sec. 4.1].

use super::factorization::workspace;

/// The smallest fraction of a diagonal entry that is accepted as its pivot.
const CERTAIN: f64 = 1e-9;
/// The state that marks a factorisation of this kind, in the place where `factorization` keeps its own.
const SYMMETRIC: f64 = -2.0;

/// Factorise the matrix whose rows come first in the workspace; false if it needs `factorization`.
pub fn factor(n: usize, work: &mut [f64]) -> bool {
    let done = match n {
        1 => eliminate::<1>(work),
        2 => eliminate::<2>(work),
        3 => eliminate::<3>(work),
        4 => eliminate::<4>(work),
        5 => eliminate::<5>(work),
        6 => eliminate::<6>(work),
        7 => eliminate::<7>(work),
        8 => eliminate::<8>(work),
        _ => false,
    };
    if done {
        work[workspace(n) - 1] = SYMMETRIC;
    }
    done
}

/// Solve for a right side with a factorised matrix; false if `factorization` factorised it.
pub fn solve(n: usize, work: &[f64], x: &mut [f64]) -> bool {
    if work[workspace(n) - 1] != SYMMETRIC {
        return false;
    }
    match n {
        1 => substitute::<1>(work, x),
        2 => substitute::<2>(work, x),
        3 => substitute::<3>(work, x),
        4 => substitute::<4>(work, x),
        5 => substitute::<5>(work, x),
        6 => substitute::<6>(work, x),
        7 => substitute::<7>(work, x),
        8 => substitute::<8>(work, x),
        _ => return false,
    }
    true
}

/// Write the multipliers below the diagonal and the reciprocal pivots on it, after the matrix in the workspace.
#[allow(clippy::needless_range_loop, reason = "the indices are those of the formulas")]
#[allow(clippy::float_cmp, reason = "entries of one value are one expression, the same to the last bit")]
fn eliminate<const N: usize>(work: &mut [f64]) -> bool {
    let (matrix, rest) = work.split_at_mut(N * N);
    let at = |i: usize, j: usize| matrix[i * N + j];
    let mut left = [[0.0; N]; N];
    for i in 0..N {
        for j in 0..=i {
            if at(i, j) != at(j, i) {
                return false;
            }
            left[i][j] = at(i, j);
        }
    }
    for k in 0..N {
        // The comparison is false for NaN, too.
        let certain = left[k][k] > CERTAIN * at(k, k);
        if !certain {
            return false;
        }
        let reciprocal = 1.0 / left[k][k];
        let column: [f64; N] = std::array::from_fn(|i| left[i][k]);
        for i in k + 1..N {
            let multiplier = column[i] * reciprocal;
            for j in k + 1..=i {
                left[i][j] -= multiplier * column[j];
            }
            left[i][k] = multiplier;
        }
        left[k][k] = reciprocal;
    }
    rest[..N * N].copy_from_slice(left.as_flattened());
    true
}

fn substitute<const N: usize>(work: &[f64], x: &mut [f64]) {
    let factors = &work[N * N..2 * N * N];
    let mut values: [f64; N] = std::array::from_fn(|i| x[i]);
    for k in 0..N {
        for i in k + 1..N {
            values[i] -= factors[i * N + k] * values[k];
        }
    }
    for k in (0..N).rev() {
        values[k] *= factors[k * N + k];
        for i in k + 1..N {
            values[k] -= factors[i * N + k] * values[i];
        }
    }
    x[..N].copy_from_slice(&values);
}
