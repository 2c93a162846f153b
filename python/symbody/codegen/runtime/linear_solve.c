/* Linear systems A x = b. The workspace, of 2 n n + 5 n + 1 numbers, holds A row by row before symbody_factor and its
 * factorisation afterwards; symbody_solve puts x in the place of b. Each equation is divided by the power of two below
 * its largest coefficient. A = P L U by partial pivoting; where a pivot vanishes against its column, A P = Q [R S; 0 0]
 * by reflections, with the largest columns first (Golub & Van Loan, Matrix Computations, 4th ed., 3.4 and 5.4.2): of
 * the x that fit best the least is taken, by removing its part along the directions in which nothing changes, and
 * symbody_factor returns how many equations follow from the others: those with 1 in the n places from 2 n n + 4 n on.
 * NaN in, NaN out. */
#include <float.h>
#include <math.h>

/* The power of two that brings a magnitude into [1, 2); 1 for nothing. */
static double symbody_weight(double size)
{
    if (size < DBL_MIN) return 1.0;
    return size <= DBL_MAX ? ldexp(1.0, -ilogb(size)) : NAN;
}

/* The largest magnitude, in four lanes; NaN is passed over. */
static double symbody_largest(int n, const double *x)
{
    double most[4] = {0.0, 0.0, 0.0, 0.0};
    int i = 0;
    for (; i + 4 <= n; i += 4)
        for (int lane = 0; lane < 4; lane++)
            most[lane] = fabs(x[i + lane]) > most[lane] ? fabs(x[i + lane]) : most[lane];
    for (; i < n; i++) most[0] = fabs(x[i]) > most[0] ? fabs(x[i]) : most[0];
    for (int lane = 1; lane < 4; lane++) most[0] = most[lane] > most[0] ? most[lane] : most[0];
    return most[0];
}

/* x . y, in four lanes. */
static double symbody_dot(int n, const double *x, const double *y)
{
    double sum[4] = {0.0, 0.0, 0.0, 0.0}, rest = 0.0;
    int i = 0;
    for (; i + 4 <= n; i += 4)
        for (int lane = 0; lane < 4; lane++) sum[lane] += x[i + lane] * y[i + lane];
    for (; i < n; i++) rest += x[i] * y[i];
    return (sum[0] + sum[2]) + (sum[1] + sum[3]) + rest;
}

/* x += a y. */
static void symbody_add(int n, double *restrict x, double a, const double *restrict y)
{
    for (int i = 0; i < n; i++) x[i] += a * y[i];
}

static void symbody_swap(int n, double *restrict x, double *restrict y)
{
    for (int i = 0; i < n; i++) {
        double kept = x[i];
        x[i] = y[i];
        y[i] = kept;
    }
}

static void symbody_swap_columns(int rows, int n, double *a, int i, int j)
{
    for (int row = 0; row < rows && i != j; row++) symbody_swap(1, a + row * n + i, a + row * n + j);
}

static void symbody_scale_columns(int n, double *a, const double *scale)
{
    for (int i = 0; i < n; i++, a += n)
        for (int j = 0; j < n; j++) a[j] *= scale[j];
}

/* Copy the equations, each times its weight; find the largest coefficients of the columns. */
static void symbody_weigh(int n, const double *a, double *restrict f, double *weight, double *restrict column)
{
    for (int j = 0; j < n; j++) column[j] = 0.0;
    for (int i = 0; i < n; i++, a += n, f += n) {
        const double w = symbody_weight(symbody_largest(n, a));
        weight[i] = w;
        for (int j = 0; j < n; j++) {
            f[j] = w * a[j];
            column[j] = fabs(f[j]) > column[j] ? fabs(f[j]) : column[j];
        }
    }
}

/* The geometric mean of the largest and the least magnitude of x y, or x / y, that is not 0; 1 if there is none. */
static double symbody_middle(int n, int stride, const double *x, const double *y, int divide)
{
    double least = DBL_MAX, most = 0.0;
    for (int i = 0; i < n; i++) {
        const double size = fabs(divide ? x[i * stride] / y[i] : x[i * stride] * y[i]);
        least = size > 0.0 && size < least ? size : least;
        most = size > most ? size : most;
    }
    return most > 0.0 ? sqrt(least) * sqrt(most) : 1.0;
}

/* Measure the unknowns in units, powers of 2^20, that bring the coefficients of each equation closer together: masses
 * may be small against the geometry in constraints, and are none the less no rounding errors. */
static void symbody_take_units(int n, double *a, double *unit, double *middle)
{
    for (int j = 0; j < n; j++) unit[j] = 1.0;
    for (int pass = 0; pass < 3; pass++) {
        for (int i = 0; i < n; i++) middle[i] = symbody_middle(n, 1, a + i * n, unit, 0);
        for (int j = 0; j < n; j++) unit[j] = 1.0 / symbody_middle(n, n, a + j, middle, 1);
    }
    for (int j = 0; j < n; j++) unit[j] = exp2(20.0 * round(log2(unit[j]) / 20.0));
    symbody_scale_columns(n, a, unit);
}

/* P A = L U in place; 0 where a pivot is so small against its column that it may be a rounding error. */
static int symbody_eliminate(int n, double *f, double *swap, double *pivot, const double *column)
{
    for (int k = 0; k < n; k++) {
        double *row = f + k * n;
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(f[i * n + k]) > fabs(f[best * n + k])) best = i;
        if (!(fabs(f[best * n + k]) > 1e-11 * column[k])) return 0;
        swap[k] = best;
        if (best > k) symbody_swap(n, row, f + best * n);
        pivot[k] = 1.0 / row[k];
        for (double *other = row + n; other < f + n * n; other += n) {
            other[k] *= pivot[k];
            if (other[k] != 0.0) symbody_add(n - k - 1, other + k + 1, -other[k], row + k + 1);
        }
    }
    return 1;
}

/* A P = Q R by reflections of the columns, the longest first, until rounding errors are left. Return the rank. */
static int symbody_reflect_columns(int n, double *f, double *swap, double *tau, double *sum, double *column)
{
    double first = 0.0;
    int k;
    for (k = 0; k < n; k++) {
        double *row = f + k * n, norm, scale;
        int longest = k;
        for (int j = k; j < n; j++) sum[j] = 0.0;
        for (int i = k; i < n; i++)
            for (int j = k; j < n; j++) sum[j] += f[i * n + j] * f[i * n + j];
        for (int j = k + 1; j < n; j++)
            if (sum[j] > sum[longest]) longest = j;
        norm = sqrt(sum[longest]);
        if (k == 0) first = norm;
        if (norm <= 64.0 * DBL_EPSILON * n * first) break;
        swap[k] = longest;
        symbody_swap_columns(1, n, column, k, longest);
        symbody_swap_columns(n, n, f, k, longest);
        norm = -copysign(norm, row[k]);
        scale = 1.0 / (row[k] - norm);
        tau[k] = (norm - row[k]) / norm;
        row[k] = norm;
        for (int j = k + 1; j < n; j++) sum[j] = row[j];
        for (int i = k + 1; i < n; i++) {
            f[i * n + k] *= scale;
            symbody_add(n - k - 1, sum + k + 1, f[i * n + k], f + i * n + k + 1);
        }
        symbody_add(n - k - 1, row + k + 1, -tau[k], sum + k + 1);
        for (int i = k + 1; i < n; i++)
            symbody_add(n - k - 1, f + i * n + k + 1, -tau[k] * f[i * n + k], sum + k + 1);
    }
    return k;
}

/* R x = b in place, with 0 from the rank on. */
static void symbody_back_substitute(int n, int rank, const double *f, double *x)
{
    for (int k = rank - 1; k >= 0; k--)
        x[k] = (x[k] - symbody_dot(n - k - 1, f + k * n + k + 1, x + k + 1)) / f[k * n + k];
}

static void symbody_normalize(int n, double *x)
{
    const double size = symbody_largest(n, x);
    double sum = 0.0;
    for (int i = 0; i < n; i++) sum += (x[i] / size) * (x[i] / size);
    for (int i = 0; i < n; i++) x[i] /= size * sqrt(sum);
}

/* Orthonormal directions of x in which nothing changes: [-R^-1 S; 1], without what is rounding error in them. */
static void symbody_find_directions(int n, int rank, const double *f, const double *unit, double *direction)
{
    double *x = direction;
    for (int c = rank; c < n; c++, x += n) {
        for (int i = 0; i < n; i++) x[i] = i == c;
        symbody_back_substitute(n, rank, f, x);
        const double rounding = 64.0 * DBL_EPSILON * n * symbody_largest(n, x);
        for (int i = 0; i < n; i++) x[i] = fabs(x[i]) > rounding ? x[i] * unit[i] : 0.0;
        symbody_normalize(n, x);
        for (int pass = 0; pass < 2; pass++)
            for (double *other = direction; other < x; other += n) symbody_add(n, x, -symbody_dot(n, other, x), other);
        symbody_normalize(n, x);
    }
}

/* Mark the equations that follow from the others, late ones rather than early ones: the last columns of Q are the
 * combinations c of equations that vanish; elimination leaves each of them an equation. */
static void symbody_mark(int n, int rank, const double *f, double *c, const double *tau, double *mark)
{
    const int count = n - rank;
    double *sum = mark;
    for (int i = 0; i < n * count; i++) c[i] = 0.0;
    for (int j = 0; j < count; j++) c[(rank + j) * count + j] = 1.0;
    for (int k = rank - 1; k >= 0; k--) {
        for (int j = 0; j < count; j++) sum[j] = c[k * count + j];
        for (int i = k + 1; i < n; i++) symbody_add(count, sum, f[i * n + k], c + i * count);
        symbody_add(count, c + k * count, -tau[k], sum);
        for (int i = k + 1; i < n; i++) symbody_add(count, c + i * count, -tau[k] * f[i * n + k], sum);
    }
    for (int i = 0; i < n; i++) mark[i] = 0.0;
    for (int j = 0; j < count; j++) {
        double most = 0.0;
        int late = n - 1, pivot = j;
        for (int i = 0; i < n; i++) most = fmax(most, symbody_largest(count - j, c + i * count + j));
        while (late > 0 && symbody_largest(count - j, c + late * count + j) < 1e-3 * most) late--;
        mark[late] = 1.0;
        for (int l = j + 1; l < count; l++)
            if (fabs(c[late * count + l]) > fabs(c[late * count + pivot])) pivot = l;
        symbody_swap_columns(n, count, c, j, pivot);
        for (int l = j + 1; l < count; l++) {
            const double ratio = c[late * count + l] / c[late * count + j];
            for (int i = 0; i < n; i++) c[i * count + l] -= ratio * c[i * count + j];
        }
    }
}

static int symbody_factor(int n, double *work)
{
    double *f = work + n * n, *weight = f + n * n, *swap = weight + n, *pivot = swap + n;
    double *unit = pivot + n, *column = unit + n, *state = column + n, finite = 0.0;
    int rank;
    symbody_weigh(n, work, f, weight, column);
    *state = -1.0;
    if (symbody_eliminate(n, f, swap, pivot, column)) return 0;
    for (int i = 0; i < n * n; i++) finite += 0.0 * work[i];
    *state = finite;
    if (finite != 0.0) return 0;
    symbody_take_units(n, work, unit, pivot);
    symbody_weigh(n, work, f, weight, column);
    for (int j = 0; j < n; j++) column[j] = symbody_weight(column[j]);
    symbody_scale_columns(n, f, column);
    for (int j = 0; j < n; j++) column[j] *= unit[j];
    rank = symbody_reflect_columns(n, f, swap, pivot, unit, column);
    *state = rank;
    for (int j = 0; j < n; j++) unit[j] = column[j];
    if (rank < n) {
        symbody_mark(n, rank, f, work, pivot, column);
        symbody_find_directions(n, rank, f, unit, work);
    }
    return n - rank;
}

static void symbody_solve_triangular(int n, const double *f, const double *swap, const double *pivot, double *x)
{
    for (int k = 0; k < n; k++) {
        const int other = (int)swap[k];
        const double kept = x[other];
        x[other] = x[k];
        x[k] = kept;
    }
    for (int k = 1; k < n; k++) x[k] -= symbody_dot(k, f + k * n, x);
    for (int k = n - 1; k >= 0; k--) x[k] = (x[k] - symbody_dot(n - k - 1, f + k * n + k + 1, x + k + 1)) * pivot[k];
}

static void symbody_solve_orthogonal(int n, int rank, const double *work, double *x)
{
    const double *f = work + n * n, *swap = f + n * n + n, *tau = swap + n, *unit = tau + n;
    double lost = 0.0;
    for (int k = 0; k < rank; k++) {
        double sum = x[k];
        for (int i = k + 1; i < n; i++) sum += f[i * n + k] * x[i];
        x[k] -= tau[k] * sum;
        for (int i = k + 1; i < n; i++) x[i] -= tau[k] * sum * f[i * n + k];
    }
    /* NaN in b must survive, although equations are left out. */
    for (int i = rank; i < n; i++) lost += 0.0 * x[i];
    for (int i = rank; i < n; i++) x[i] = lost;
    symbody_back_substitute(n, rank, f, x);
    for (int i = 0; i < n; i++) x[i] *= unit[i];
    /* Twice, because what is removed may be much larger than what stays. */
    for (int pass = 0; pass < 2; pass++)
        for (const double *direction = work; direction < work + n * (n - rank); direction += n)
            symbody_add(n, x, -symbody_dot(n, direction, x), direction);
    for (int k = rank - 1; k >= 0; k--) symbody_swap_columns(1, n, x, k, (int)swap[k]);
}

static void symbody_solve(int n, const double *work, double *x)
{
    const double *f = work + n * n, *weight = f + n * n, *swap = weight + n, *pivot = swap + n, *state = weight + 5 * n;
    for (int i = 0; i < n; i++) x[i] *= weight[i];
    if (*state == -1.0)
        symbody_solve_triangular(n, f, swap, pivot, x);
    else if (*state >= 0.0)
        symbody_solve_orthogonal(n, (int)*state, work, x);
    else
        for (int i = 0; i < n; i++) x[i] = *state;
}
