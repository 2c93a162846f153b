//! Solutions of A x = b for small dense matrices in doubles: one factorisation, many right sides.
//!
//! Each equation is divided by the power of two below its largest coefficient, so that it does not matter in which
//! units it is written. Then A = P L U by partial pivoting [Golub & Van Loan 2013, sec. 3.4]. Where a pivot
//! vanishes against its column, A P = Q [R S; 0 0] by reflections instead, with the largest columns first
//! [sec. 5.4.2]: of the solutions that fit the equations best the least is taken, by removing its part along the
//! directions in which nothing changes, and the equations that follow from the others are named. NaN in, NaN out.

/// A pivot so small against its column may be a rounding error: the decomposition with column pivoting decides.
const DOUBTFUL: f64 = 1e-11;
/// Rounding errors of the coefficients and of the decomposition, for each equation, against the largest pivot.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// An equation follows from others where a combination that vanishes has so large a share of it.
const SHARE: f64 = 1e-3;
/// The state of a factorisation in triangles; that of an orthogonal one is its rank.
const TRIANGULAR: f64 = -1.0;

/// How many doubles a matrix with n rows and its factorisation take.
#[must_use]
pub const fn workspace(n: usize) -> usize {
    2 * n * n + 5 * n + 1
}

/// Factorise the matrix whose rows come first in the workspace; return how many equations follow from others.
pub fn factor(n: usize, work: &mut [f64]) -> usize {
    let (areas, state) = Areas::of(n, work);
    let Areas { matrix, factors, weights, swaps, pivots, sums, columns } = areas;
    weigh_rows(n, matrix, factors, weights, columns);
    *state = TRIANGULAR;
    if eliminate(n, factors, swaps, pivots, columns) {
        return 0;
    }
    if !matrix.iter().all(|entry| entry.is_finite()) {
        *state = f64::NAN;
        return 0;
    }
    take_units(n, matrix, sums, pivots);
    weigh_rows(n, matrix, factors, weights, columns);
    weigh_columns(n, factors, columns, sums);
    let rank = reflect_columns(n, factors, swaps, pivots, sums, columns);
    *state = to_double(rank);
    sums.copy_from_slice(columns);
    if rank < n {
        name_dependent(n, rank, factors, matrix, pivots, columns);
        find_directions(n, rank, factors, sums, matrix);
    }
    n - rank
}

/// Solve for a right side with a factorised matrix; the solution takes its place.
pub fn solve(n: usize, work: &[f64], x: &mut [f64]) {
    let (matrix, rest) = work.split_at(n * n);
    let (factors, rest) = rest.split_at(n * n);
    let (weights, swaps, pivots, units) =
        (&rest[..n], &rest[n..2 * n], &rest[2 * n..3 * n], &rest[3 * n..4 * n]);
    let state = rest[5 * n];
    for (entry, weight) in x.iter_mut().zip(weights) {
        *entry *= weight;
    }
    if state == TRIANGULAR {
        solve_triangular(n, factors, swaps, pivots, x);
    } else if state >= 0.0 {
        let rank = to_index(state);
        fit(n, rank, factors, pivots, x);
        x.iter_mut().zip(units).for_each(|(entry, unit)| *entry *= unit);
        // Twice, because what is removed may be much larger than what stays.
        let directions = &matrix[..n * (n - rank)];
        for direction in directions.chunks_exact(n).chain(directions.chunks_exact(n)) {
            add_scaled(x, -dot(direction, x), direction);
        }
        (0..rank).rev().for_each(|k| x.swap(k, to_index(swaps[k])));
    } else {
        x.fill(f64::NAN);
    }
}

/// The equations that follow from the others, by the factorisation in the workspace.
pub fn dependent(n: usize, work: &[f64]) -> impl Iterator<Item = usize> + '_ {
    let (marks, state) = work[2 * n * n + 4 * n..].split_at(n);
    let deficient = state[0] >= 0.0 && state[0] < to_double(n);
    marks.iter().enumerate().filter(move |&(_, &mark)| deficient && mark > 0.0).map(|(row, _)| row)
}

/// The parts of a workspace.
struct Areas<'a> {
    /// The coefficients, row by row; at last the directions of x in which nothing changes.
    matrix: &'a mut [f64],
    /// The triangles; or R and S, and below them the reflections.
    factors: &'a mut [f64],
    /// What the equations are multiplied by.
    weights: &'a mut [f64],
    /// The row, or column, that changed places with each.
    swaps: &'a mut [f64],
    /// Reciprocal pivots; or factors of the reflections of columns.
    pivots: &'a mut [f64],
    /// Sums along columns; at last the weights of the columns.
    sums: &'a mut [f64],
    /// The largest coefficients of columns, their weights; at last 1 for an equation that follows from others.
    columns: &'a mut [f64],
}

impl<'a> Areas<'a> {
    fn of(n: usize, work: &'a mut [f64]) -> (Self, &'a mut f64) {
        let (matrix, rest) = work.split_at_mut(n * n);
        let (factors, rest) = rest.split_at_mut(n * n);
        let (weights, rest) = rest.split_at_mut(n);
        let (swaps, rest) = rest.split_at_mut(n);
        let (pivots, rest) = rest.split_at_mut(n);
        let (sums, rest) = rest.split_at_mut(n);
        let (columns, rest) = rest.split_at_mut(n);
        (Self { matrix, factors, weights, swaps, pivots, sums, columns }, &mut rest[0])
    }
}

/// Copy the equations, each multiplied by its weight; find the largest coefficients of the columns.
fn weigh_rows(n: usize, matrix: &[f64], factors: &mut [f64], weights: &mut [f64], columns: &mut [f64]) {
    columns.fill(0.0);
    let rows = matrix.chunks_exact(n.max(1)).zip(factors.chunks_exact_mut(n.max(1)));
    for ((row, weighted), weight) in rows.zip(weights) {
        *weight = power_of_two(largest(row));
        for ((entry, &coefficient), column) in weighted.iter_mut().zip(row).zip(columns.iter_mut()) {
            *entry = coefficient * *weight;
            *column = greater(*column, entry.abs());
        }
    }
}

/// Measure the unknowns in units, powers of 2^20, that bring the coefficients of each equation closer together.
///
/// Masses may be small against the geometry in constraints: they are none the less no rounding errors.
fn take_units(n: usize, matrix: &mut [f64], units: &mut [f64], middles: &mut [f64]) {
    units.fill(1.0);
    for _ in 0..3 {
        for (row, mean) in matrix.chunks_exact(n).zip(&mut *middles) {
            *mean = middle(row.iter().zip(&*units).map(|(entry, unit)| entry * unit));
        }
        for (column, unit) in units.iter_mut().enumerate() {
            let entries = matrix.chunks_exact(n).map(|row| row[column]);
            *unit = 1.0 / middle(entries.zip(&*middles).map(|(entry, mean)| entry / mean));
        }
    }
    for unit in &mut *units {
        *unit = (20.0 * (unit.log2() / 20.0).round()).exp2();
    }
    for row in matrix.chunks_exact_mut(n) {
        row.iter_mut().zip(&*units).for_each(|(entry, unit)| *entry *= unit);
    }
}

/// The geometric mean of the largest and the least magnitude that is not 0; 1 if there is none.
fn middle(entries: impl Iterator<Item = f64>) -> f64 {
    let sizes = entries.map(f64::abs).filter(|&size| size > 0.0);
    let (least, most) = sizes.fold((f64::MAX, 0.0), |(least, most), size| (size.min(least), size.max(most)));
    if most > 0.0 { least.sqrt() * most.sqrt() } else { 1.0 }
}

/// Multiply each column by a weight; leave in place of its largest coefficient its weight in all.
fn weigh_columns(n: usize, factors: &mut [f64], columns: &mut [f64], units: &[f64]) {
    for column in &mut *columns {
        *column = power_of_two(*column);
    }
    for row in factors.chunks_exact_mut(n) {
        row.iter_mut().zip(&*columns).for_each(|(entry, weight)| *entry *= weight);
    }
    columns.iter_mut().zip(units).for_each(|(weight, unit)| *weight *= unit);
}

/// P A = L U in place; false where a pivot is doubtful.
fn eliminate(n: usize, factors: &mut [f64], swaps: &mut [f64], pivots: &mut [f64], columns: &[f64]) -> bool {
    for k in 0..n {
        let (mut pivot, mut size) = (k, factors[k * n + k].abs());
        for (row, entries) in factors.chunks_exact(n).enumerate().skip(k + 1) {
            if entries[k].abs() > size {
                (pivot, size) = (row, entries[k].abs());
            }
        }
        // A pivot that is NaN is not greater either.
        let certain = size > DOUBTFUL * columns[k];
        if !certain {
            return false;
        }
        swaps[k] = to_double(pivot);
        let (above, below) = factors.split_at_mut((k + 1) * n);
        let row = &mut above[k * n..];
        if pivot > k {
            row.swap_with_slice(&mut below[(pivot - k - 1) * n..(pivot - k) * n]);
        }
        pivots[k] = 1.0 / row[k];
        for other in below.chunks_exact_mut(n) {
            other[k] *= pivots[k];
            if other[k] != 0.0 {
                let multiplier = other[k];
                add_scaled(&mut other[k + 1..], -multiplier, &row[k + 1..]);
            }
        }
    }
    true
}

fn solve_triangular(n: usize, factors: &[f64], swaps: &[f64], pivots: &[f64], x: &mut [f64]) {
    for (k, &swap) in swaps.iter().enumerate() {
        x.swap(k, to_index(swap));
    }
    for (k, row) in factors.chunks_exact(n.max(1)).enumerate() {
        x[k] -= dot(&row[..k], &x[..k]);
    }
    for (k, row) in factors.chunks_exact(n.max(1)).enumerate().rev() {
        x[k] = (x[k] - dot(&row[k + 1..], &x[k + 1..])) * pivots[k];
    }
}

/// A P = Q R by reflections of the columns, the longest first, until rounding errors are left; the rank.
fn reflect_columns(
    n: usize,
    factors: &mut [f64],
    swaps: &mut [f64],
    taus: &mut [f64],
    sums: &mut [f64],
    columns: &mut [f64],
) -> usize {
    let (mut rank, mut first) = (0, 0.0);
    while rank < n {
        let k = rank;
        let (column, norm) = longest_column(n, k, factors, sums);
        first = greater(first, norm);
        if norm <= ROUNDING * to_double(n) * first {
            break;
        }
        swaps[k] = to_double(column);
        columns.swap(k, column);
        factors.chunks_exact_mut(n).for_each(|row| row.swap(k, column));
        reflect_column(n, k, norm, factors, taus, sums);
        rank += 1;
    }
    rank
}

/// The column that is longest from row k on, and its length there.
fn longest_column(n: usize, k: usize, factors: &[f64], sums: &mut [f64]) -> (usize, f64) {
    sums.fill(0.0);
    for row in factors.chunks_exact(n).skip(k) {
        sums[k..].iter_mut().zip(&row[k..]).for_each(|(sum, entry)| *sum += entry * entry);
    }
    let (mut longest, mut square) = (k, sums[k]);
    for (column, &sum) in sums.iter().enumerate().skip(k + 1) {
        if sum > square {
            (longest, square) = (column, sum);
        }
    }
    (longest, square.sqrt())
}

/// Reflect a column onto its entry k, and with it the columns behind [Golub & Van Loan, sec. 5.1].
fn reflect_column(n: usize, k: usize, norm: f64, factors: &mut [f64], taus: &mut [f64], sums: &mut [f64]) {
    let (above, below) = factors.split_at_mut((k + 1) * n);
    let row = &mut above[k * n..];
    let reflected = -norm.copysign(row[k]);
    let scale = 1.0 / (row[k] - reflected);
    taus[k] = (reflected - row[k]) / reflected;
    row[k] = reflected;
    let sums = &mut sums[k + 1..];
    sums.copy_from_slice(&row[k + 1..]);
    for other in below.chunks_exact_mut(n) {
        other[k] *= scale;
        add_scaled(sums, other[k], &other[k + 1..]);
    }
    add_scaled(&mut row[k + 1..], -taus[k], sums);
    for other in below.chunks_exact_mut(n) {
        let share = -taus[k] * other[k];
        add_scaled(&mut other[k + 1..], share, sums);
    }
}

/// The x with no part in the last columns that fits best: R x = Q^T b.
fn fit(n: usize, rank: usize, factors: &[f64], taus: &[f64], x: &mut [f64]) {
    for (k, tau) in taus.iter().enumerate().take(rank) {
        let below = || factors.chunks_exact(n).map(|row| row[k]).skip(k + 1);
        let sum = tau * (x[k] + below().zip(&x[k + 1..]).map(|(v, entry)| v * entry).sum::<f64>());
        x[k] -= sum;
        x[k + 1..].iter_mut().zip(below()).for_each(|(entry, v)| *entry -= sum * v);
    }
    // NaN in the right side must survive, although equations are left out.
    let lost = x[rank..].iter().map(|entry| 0.0 * entry).sum::<f64>();
    x[rank..].fill(lost);
    back_substitute(n, rank, factors, x);
}

/// R x = b in place, with 0 from the rank on.
fn back_substitute(n: usize, rank: usize, factors: &[f64], x: &mut [f64]) {
    for (k, row) in factors.chunks_exact(n).enumerate().take(rank).rev() {
        x[k] = (x[k] - dot(&row[k + 1..], &x[k + 1..])) / row[k];
    }
}

/// Orthonormal directions of x in which nothing changes: [-R^-1 S; 1], without what is rounding error in them.
fn find_directions(n: usize, rank: usize, factors: &[f64], units: &[f64], directions: &mut [f64]) {
    for c in 0..n - rank {
        let (found, rest) = directions.split_at_mut(c * n);
        let direction = &mut rest[..n];
        direction.fill(0.0);
        direction[rank + c] = 1.0;
        back_substitute(n, rank, factors, direction);
        let rounding = ROUNDING * to_double(n) * largest(direction);
        for (entry, unit) in direction.iter_mut().zip(units) {
            *entry = if entry.abs() > rounding { *entry * unit } else { 0.0 };
        }
        normalize(direction);
        for other in found.chunks_exact(n).chain(found.chunks_exact(n)) {
            add_scaled(direction, -dot(other, direction), other);
        }
        normalize(direction);
    }
}

fn normalize(direction: &mut [f64]) {
    let size = largest(direction);
    let length = size * direction.iter().map(|entry| (entry / size).powi(2)).sum::<f64>().sqrt();
    for entry in direction {
        *entry /= length;
    }
}

/// Mark the equations that follow from the others, late ones rather than early ones.
///
/// The last columns of Q are the combinations of equations that vanish; elimination leaves each of them an equation.
fn name_dependent(
    n: usize,
    rank: usize,
    factors: &[f64],
    combinations: &mut [f64],
    taus: &[f64],
    marks: &mut [f64],
) {
    let count = n - rank;
    let (combinations, sums) = (&mut combinations[..n * count], &mut marks[..count]);
    combinations.fill(0.0);
    (0..count).for_each(|c| combinations[(rank + c) * count + c] = 1.0);
    for k in (0..rank).rev() {
        sums.copy_from_slice(&combinations[k * count..][..count]);
        for (row, other) in combinations.chunks_exact(count).enumerate().skip(k + 1) {
            add_scaled(sums, factors[row * n + k], other);
        }
        add_scaled(&mut combinations[k * count..][..count], -taus[k], sums);
        for (row, other) in combinations.chunks_exact_mut(count).enumerate().skip(k + 1) {
            add_scaled(other, -taus[k] * factors[row * n + k], sums);
        }
    }
    marks.fill(0.0);
    for c in 0..count {
        let share = |row: &[f64]| largest(&row[c..]);
        let most = combinations.chunks_exact(count).map(share).fold(0.0, greater);
        let late = combinations.chunks_exact(count).rposition(|row| share(row) >= SHARE * most);
        let equation =
            late.expect("the largest share is that of an equation, because `largest` passes over NaN");
        marks[equation] = 1.0;
        remove_equation(count, c, equation, combinations);
    }
}

/// Combine the combinations from c on so that the later ones are without an equation.
fn remove_equation(count: usize, c: usize, equation: usize, combinations: &mut [f64]) {
    let row = &combinations[equation * count..][..count];
    let size = largest(&row[c..]);
    // If all shares are NaN, any of them does: it makes the other combinations NaN, too.
    let pivot = c + row[c..].iter().position(|share| share.abs() >= size).unwrap_or(0);
    combinations.chunks_exact_mut(count).for_each(|row| row.swap(c, pivot));
    for other in c + 1..count {
        let ratio = combinations[equation * count + other] / combinations[equation * count + c];
        combinations.chunks_exact_mut(count).for_each(|row| row[other] -= ratio * row[c]);
    }
}

/// x += a y.
fn add_scaled(x: &mut [f64], a: f64, y: &[f64]) {
    x.iter_mut().zip(y).for_each(|(x, y)| *x += a * y);
}

/// x . y, in four sums side by side.
fn dot(x: &[f64], y: &[f64]) -> f64 {
    let (first, second) = (x.chunks_exact(4), y.chunks_exact(4));
    let rest: f64 = first.remainder().iter().zip(second.remainder()).map(|(x, y)| x * y).sum();
    let mut sums = [0.0; 4];
    for (x, y) in first.zip(second) {
        for lane in 0..4 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    (sums[0] + sums[2]) + (sums[1] + sums[3]) + rest
}

/// The largest magnitude; NaN is passed over.
fn largest(entries: &[f64]) -> f64 {
    let fours = entries.chunks_exact(4);
    let rest = fours.remainder().iter().fold(0.0, |most, entry| greater(most, entry.abs()));
    let mut most = [0.0; 4];
    for four in fours {
        for lane in 0..4 {
            most[lane] = greater(most[lane], four[lane].abs());
        }
    }
    most.into_iter().fold(rest, greater)
}

fn greater(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// The power of two that brings a magnitude into [1, 2); 1 for nothing.
fn power_of_two(magnitude: f64) -> f64 {
    if magnitude < f64::MIN_POSITIVE {
        return 1.0;
    }
    let exponent = magnitude.to_bits() >> 52;
    if exponent == 0x7ff { f64::NAN } else { f64::from_bits((0x7fe - exponent).max(1) << 52) }
}

#[allow(clippy::cast_precision_loss, reason = "numbers of rows are small")]
fn to_double(index: usize) -> f64 {
    index as f64
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "written by to_double")]
fn to_index(number: f64) -> usize {
    number as usize
}
