"""Linear systems in languages that have a library for them: the least-squares solution of minimum norm.

Each equation is divided by the power of two below its largest coefficient, as in the other files of this folder. Where
units for the unknowns, too, leave the matrix singular up to rounding, a rank-revealing decomposition takes over.
"""

from __future__ import annotations

__all__ = ["NAMES", "SNIPPETS"]

_NUMPY = '''
def linear_solve(a, b):
    """Return the entries of x, a x = b: the least-squares solution of minimum norm, for any batch of systems."""
    a = np.where(np.isfinite(a).all((-2, -1), keepdims=True), a, np.nan)
    b = np.stack(np.broadcast_arrays(*b), -1).astype(float)[..., None]
    n, batch = a.shape[-1], np.broadcast_shapes(a.shape[:-2], b.shape[:-2])
    unit = units(a)
    weight = power_of_two(np.abs(a * unit).max(-1, keepdims=True))
    unit = unit * power_of_two(np.abs(weight * a * unit).max(-2, keepdims=True))
    a, b = np.broadcast_to(weight * a * unit, (*batch, n, n)), np.broadcast_to(weight * b, (*batch, n, 1))
    unit = np.broadcast_to(np.swapaxes(unit, -2, -1), b.shape)
    # NaN is not treated as singular; it propagates.
    singular = np.linalg.cond(a, 1) > 1 / (64 * n * np.finfo(float).eps)
    x = np.empty(b.shape)
    x[~singular] = unit[~singular] * np.linalg.solve(a[~singular], b[~singular])
    for place in np.ndindex(batch):
        if singular[place]:
            x[place] = least_solution(a[place], b[place], unit[place])
    return np.moveaxis(x[..., 0], -1, 0)


def least_solution(a, b, unit):
    """Return x = unit y of minimum norm, y a least-squares solution of a y = b: x has no part in the null space."""
    rounding = 64 * len(b) * np.finfo(float).eps
    u, s, v = np.linalg.svd(a)
    rank = np.count_nonzero(s > rounding * s[0])
    x = unit * (v[:rank].T @ (u[:, :rank].T @ b / s[:rank, None]))
    directions = np.linalg.qr(unit * np.where(np.abs(v[rank:]) > rounding, v[rank:], 0.0).T)[0]
    # Twice, because what is removed may be much larger than what stays.
    x = x - directions @ (directions.T @ x)
    return x - directions @ (directions.T @ x)


def units(a):
    """Return units for the unknowns, powers of 2^20, that bring the coefficients of each equation closer together."""
    size, unit = np.abs(a), 1.0
    for _ in range(3):
        unit = 1.0 / middle(size / middle(size * unit, -1), -2)
    return 2.0 ** (20 * np.round(np.log2(unit) / 20))


def middle(size, axis):
    """Return the geometric mean of the largest and the smallest number that is not 0; 1 if there is none."""
    most = size.max(axis, keepdims=True)
    least = np.where(size > 0, size, most).min(axis, keepdims=True)
    return np.where(most > 0, np.sqrt(least) * np.sqrt(most), 1.0)


def power_of_two(size):
    """Return the powers of two that bring numbers into [1, 2)."""
    return np.ldexp(1.0, 1 - np.frexp(size)[1])
'''

_JAX = '''
def linear_solve(a, b):
    """Return x, a x = b: the least-squares solution of minimum norm."""
    a = jnp.where(jnp.isfinite(a).all(), a, jnp.nan)
    b = jnp.stack([jnp.asarray(entry, dtype=float) for entry in b])
    identity, rounding = jnp.eye(len(b)), 64 * len(b) * jnp.finfo(float).eps
    weight, unit = jax.lax.stop_gradient(weights_and_units(a))
    a, b = weight * a * unit, weight[:, 0] * b
    # NaN is not treated as singular; it propagates.
    singular = jnp.linalg.cond(jax.lax.stop_gradient(a), 1) > 1 / rounding

    # The way that is not taken gets a matrix without danger: it is computed too where systems are mapped over.
    def regular():
        return unit * jnp.linalg.solve(jnp.where(singular, identity, a), b)

    def least():
        matrix = jnp.where(singular, a, identity)
        inverse = jnp.linalg.pinv(matrix, rounding)
        # x has to lose its part along the directions in which nothing changes.
        _, s, v = jnp.linalg.svd(jax.lax.stop_gradient(matrix))
        takes_part = jnp.abs(v.T @ (jnp.where(s > rounding * s[0], 0.0, 1.0)[:, None] * v)) > rounding
        directions = unit[:, None] * jnp.where(takes_part, identity - inverse @ matrix, 0.0)
        part = directions @ jnp.linalg.pinv(directions, rounding)
        x = unit * (inverse @ b)
        x = x - part @ x
        return x - part @ x

    return jax.lax.cond(singular, least, regular)


def weights_and_units(a):
    """Return weights of equations and units of unknowns, powers of two, that balance the coefficients.

    The units, of 2^20 at first, bring the coefficients of each equation closer together.
    """
    size, unit = jnp.abs(a), 1.0
    for _ in range(3):
        unit = 1.0 / middle(size / middle(size * unit, 1), 0)
    unit = jnp.ldexp(1.0, jnp.asarray(20 * jnp.round(jnp.log2(unit) / 20), int))
    weight = power_of_two((size * unit).max(1, keepdims=True))
    return weight, (unit * power_of_two((weight * size * unit).max(0, keepdims=True)))[0]


def middle(size, axis):
    """Return the geometric mean of the largest and the smallest number that is not 0; 1 if there is none."""
    most = size.max(axis, keepdims=True)
    least = jnp.where(size > 0, size, most).min(axis, keepdims=True)
    return jnp.where(most > 0, jnp.sqrt(least) * jnp.sqrt(most), 1.0)


def power_of_two(size):
    """Return the powers of two that bring numbers into [1, 2)."""
    return jnp.ldexp(1.0, 1 - jnp.frexp(size)[1])
'''

_CASADI = '''
def orthonormal(rows):
    """Return orthonormal rows that span the rows; zeros for one that follows from those before it."""
    basis = ca.MX(0, rows.shape[1])
    for row in ca.vertsplit(rows):
        rest = row
        for _ in range(2):
            rest = rest - ca.mtimes(ca.mtimes(rest, basis.T), basis)
        vanishes = ca.sumsqr(rest) <= (64 * rows.shape[0] * 2.0**-52) ** 2 * ca.sumsqr(row)
        length = ca.sqrt(ca.if_else(vanishes, 1.0, ca.sumsqr(rest)))
        basis = ca.vertcat(basis, ca.if_else(vanishes, 0.0, rest / length))
    return basis


def linear_solve(a, b):
    """Return x, a x = b: the least-squares solution of minimum norm."""
    largest = [ca.norm_inf(row.T) for row in ca.vertsplit(a)]
    exponents = [ca.floor(ca.log(ca.if_else(m > 0.0, m, 1.0)) / ca.log(2.0) + 1e-13) for m in largest]
    weight = ca.power(2.0, -ca.vertcat(*exponents))
    a, b = ca.repmat(weight, 1, a.shape[1]) * a, weight * ca.vertcat(*b)
    # a = columns.T @ triangle @ rows, with orthonormal rows or zeros in both.
    rows = orthonormal(a)
    lower = ca.mtimes(a, rows.T)
    columns = orthonormal(lower.T)
    triangle, c = ca.mtimes(columns, lower), ca.mtimes(columns, b)
    x = ca.MX(0, 1)
    for k in reversed(range(b.shape[0])):
        pivot = triangle[k, k]
        rest = c[k] - ca.mtimes(triangle[k, k + 1 :], x)
        x = ca.vertcat(ca.if_else(pivot == 0.0, 0.0, rest / ca.if_else(pivot == 0.0, 1.0, pivot)), x)
    return ca.mtimes(rows.T, x)
'''

_MATLAB = """
function x = linear_solve(a, b)
% Return x, a x = b: the least-squares solution of minimum norm.
    if ~all(isfinite(a(:)))
        x = NaN(size(b));
        return
    end
    unit = units_of_unknowns(a);
    weight = power_of_two(max(abs(a.*unit), [], 2));
    unit = unit.*power_of_two(max(abs(weight.*a.*unit), [], 1));
    a = weight.*a.*unit;
    b = weight.*b;
    unit = unit.';
    rounding = 64*numel(b)*eps;
    if rcond(a) >= rounding
        x = unit.*(a\\b);
        return
    end
    [u, s, v] = svd(a);
    s = diag(s);
    rank = sum(s > rounding*s(1));
    x = unit.*(v(:, 1:rank)*((u(:, 1:rank).'*b)./s(1:rank)));
    v(abs(v) <= rounding) = 0;
    [directions, ~] = qr(unit.*v(:, rank + 1:end), 0);
    for pass = 1:2    % because what is removed may be much larger than what stays
        x = x - directions*(directions.'*x);
    end
end

function unit = units_of_unknowns(a)
% Return units, powers of 2^20, that bring the coefficients of each equation closer together.
    unit = ones(1, size(a, 2));
    for pass = 1:3
        unit = 1./middle(abs(a)./middle(abs(a).*unit, 2), 1);
    end
    unit = pow2(20*round(log2(unit)/20));
end

function mean = middle(magnitude, dimension)
% Return the geometric mean of the largest and the smallest number that is not 0; 1 if there is none.
    most = max(magnitude, [], dimension);
    magnitude(magnitude == 0) = Inf;
    least = min(magnitude, [], dimension);
    mean = ones(size(most));
    mean(most > 0) = sqrt(least(most > 0)).*sqrt(most(most > 0));
end

function weight = power_of_two(magnitude)
% Return the powers of two that bring magnitudes into [1, 2).
    [~, exponent] = log2(magnitude);
    weight = pow2(1 - exponent);
end
"""

_JULIA = """
import LinearAlgebra

# The power of two that brings a magnitude into [1, 2); 1 for nothing.
power_of_two(magnitude) = iszero(magnitude) ? one(magnitude) : exp2(-floor(log2(magnitude)))

# The geometric mean of the largest and the smallest magnitude that is not 0; 1 if there is none.
function middle(entries)
    sizes = [abs(entry) for entry in entries if !iszero(entry)]
    return isempty(sizes) ? 1.0 : sqrt(minimum(sizes)) * sqrt(maximum(sizes))
end

# Units for the unknowns, powers of 2^20, that bring the coefficients of each equation closer together.
function units_of_unknowns(a)
    unit = ones(eltype(a), size(a, 2))
    for pass in 1:3
        means = [middle(row .* unit) for row in eachrow(a)]
        unit = [1 / middle(column ./ means) for column in eachcol(a)]
    end
    return exp2.(20 .* round.(log2.(unit) ./ 20))
end

# Return x, a x = b: the least-squares solution of minimum norm.
function linear_solve(a, b)
    all(isfinite, a) || return NaN .* b
    unit = units_of_unknowns(a)
    weight = power_of_two.(vec(maximum(abs, a .* unit'; dims=2)))
    unit = unit .* power_of_two.(vec(maximum(abs, weight .* a .* unit'; dims=1)))
    a, b = weight .* a .* unit', weight .* b
    triangles = LinearAlgebra.lu(a; check=false)
    rounding = 64 * length(b) * eps()
    if all(abs.(LinearAlgebra.diag(triangles.factors)) .> rounding)
        return unit .* (triangles \\ b)
    end
    u, s, v = LinearAlgebra.svd(a)
    rank = count(s .> rounding * s[1])
    x = unit .* (v[:, 1:rank] * ((u[:, 1:rank]' * b) ./ s[1:rank]))
    null = [abs(entry) > rounding ? entry : zero(entry) for entry in v[:, rank+1:end]]
    directions = Matrix(LinearAlgebra.qr(unit .* null).Q)
    for pass in 1:2  # because what is removed may be much larger than what stays
        x = x - directions * (directions' * x)
    end
    return x
end
"""

_MODELICA = """
function linear_solve "The least-squares solution of minimum norm of a x = b"
  input Real a[:, size(a, 1)];
  input Real b[size(a, 1)];
  output Real x[size(a, 1)];
protected
  Real weighted[size(a, 1), size(a, 1)];
  Real balanced[size(a, 1), size(a, 1)];
  Real right[size(a, 1)];
  Real scale[size(a, 1)];
algorithm
  for i in 1:size(a, 1) loop
    scale[i] := power_of_two(max(abs(a[i, :])));
    weighted[i, :] := scale[i]*a[i, :];
    right[i] := scale[i]*b[i];
  end for;
  for j in 1:size(a, 1) loop
    scale[j] := power_of_two(max(abs(weighted[:, j])));
    balanced[:, j] := scale[j]*weighted[:, j];
  end for;
  if Modelica.Math.Matrices.rcond(balanced) > 64*size(a, 1)*Modelica.Constants.eps then
    x := scale .* Modelica.Math.Matrices.solve(balanced, right);
  else
    x := Modelica.Math.Matrices.leastSquares(weighted, right, 64*size(a, 1)*Modelica.Constants.eps);
  end if;
end linear_solve;

function power_of_two "The power of two that brings a magnitude into [1, 2); 1 for nothing"
  input Real magnitude;
  output Real weight;
algorithm
  weight := if magnitude > 0 then 2.0^(-floor(log(magnitude)/log(2.0) + 1e-13)) else 1.0;
end power_of_two;
"""

SNIPPETS = {
    "numpy": _NUMPY,
    "jax": _JAX,
    "casadi": _CASADI,
    "matlab": _MATLAB,
    "julia": _JULIA,
    "modelica": _MODELICA,
}
"""By language, the text of a function ``linear_solve(a, b)`` and of those that it calls."""

NAMES = frozenset(
    {
        "least_solution",
        "linear_solve",
        "middle",
        "orthonormal",
        "power_of_two",
        "units",
        "units_of_unknowns",
        "weights_and_units",
    }
)
"""The names of all these functions, which generated code has to avoid."""
