"""How linear systems are solved in languages that have a library for it: the least x among those that fit best.

Each equation is divided by the power of two below its largest coefficient, as in the files beside this one. Where
units for the unknowns, too, leave the matrix singular but for rounding, a decomposition that tells the rank takes over.
"""

from __future__ import annotations

__all__ = ["SNIPPETS"]

_NUMPY = '''
def linear_solve(a, b):
    """Return the entries of x, a x = b: the least x among those that fit best, for any batch of systems."""
    b = np.stack(np.broadcast_arrays(*b), -1).astype(float)[..., None]
    a = np.where(np.isfinite(a).all((-2, -1), keepdims=True), a, np.nan)
    n, batch = a.shape[-1], np.broadcast_shapes(a.shape[:-2], b.shape[:-2])
    rounding = 64 * n * np.finfo(float).eps
    weight = np.ldexp(1.0, 1 - np.frexp(np.abs(a).max(-1))[1])[..., None]
    a, b = np.broadcast_to(weight * a, (*batch, n, n)), np.broadcast_to(weight * b, (*batch, n, 1))
    scale = np.ldexp(1.0, 1 - np.frexp(np.abs(a).max(-2))[1])[..., None, :]
    # What is no number is not singular either: it stays what it is.
    singular = np.linalg.cond(a * scale, 1) > 1 / rounding
    regular = ~singular
    x = np.empty(b.shape)
    x[regular] = np.swapaxes(scale, -2, -1)[regular] * np.linalg.solve((a * scale)[regular], b[regular])
    x[singular] = np.linalg.pinv(a[singular], rounding) @ b[singular]
    return np.moveaxis(x[..., 0], -1, 0)
'''

_JAX = '''
def linear_solve(a, b):
    """Return x, a x = b: the least x among those that fit best."""
    a = jnp.where(jnp.isfinite(a).all(), a, jnp.nan)
    b = jnp.stack([jnp.asarray(entry, dtype=float) for entry in b])
    weight = jax.lax.stop_gradient(jnp.ldexp(1.0, 1 - jnp.frexp(jnp.abs(a).max(1))[1]))
    a, b = weight[:, None] * a, weight * b
    scale = jax.lax.stop_gradient(jnp.ldexp(1.0, 1 - jnp.frexp(jnp.abs(a).max(0))[1]))
    unit, rounding = jnp.eye(len(b)), 64 * len(b) * jnp.finfo(float).eps
    # What is no number is not singular either: it stays what it is.
    singular = jnp.linalg.cond(jax.lax.stop_gradient(a * scale), 1) > 1 / rounding

    # The way that is not taken gets a matrix without danger: it is computed too where systems are mapped over.
    def regular():
        return scale * jnp.linalg.solve(jnp.where(singular, unit, a * scale), b)

    def least():
        return jnp.linalg.pinv(jnp.where(singular, a, unit), rounding) @ b

    return jax.lax.cond(singular, least, regular)
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
    """Return x, a x = b: the least x among those that fit best."""
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
% Return x, a x = b: the least x among those that fit best.
    rounding = 64*numel(b)*eps;
    weight = power_of_two(max(abs(a), [], 2));
    a = weight.*a;
    b = weight.*b;
    scale = power_of_two(max(abs(a), [], 1));
    if ~all(isfinite(a(:)))
        x = NaN(size(b));
    elseif rcond(a.*scale) < rounding
        x = pinv(a, rounding*norm(a))*b;
    else
        x = scale.'.*((a.*scale)\\b);
    end
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

# Return x, a x = b: the least x among those that fit best.
function linear_solve(a, b)
    all(isfinite, a) || return NaN .* b
    weight = power_of_two.(vec(maximum(abs, a; dims=2)))
    a, b = weight .* a, weight .* b
    scale = power_of_two.(vec(maximum(abs, a; dims=1)))
    triangles = LinearAlgebra.lu(a .* scale'; check=false)
    rounding = 64 * length(b) * eps()
    if any(abs.(LinearAlgebra.diag(triangles.factors)) .<= rounding)
        return LinearAlgebra.pinv(a; rtol=rounding) * b
    end
    return scale .* (triangles \\ b)
end
"""

_MODELICA = """
function linear_solve "The least x among those that fit a x = b best"
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
"""By language, the text of a function ``linear_solve(a, b)``; its files are those of the printers."""
