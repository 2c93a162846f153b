"""The rate of angular momentum, ``J al + w x J w``, by the entries of the field of accelerations F (`turning.py`)."""

from __future__ import annotations

from symbody.geometry.component.triple import NULL, Triple, is_null
from symbody.geometry.component.turning import Turning
from symbody.multibody import Body
from symbody.symbolic import Expr


def spin_momentum_rate(body: Body, turning: Turning) -> Triple:
    """Return ``dH_G/dt = J al + w x J w`` in the body's axes."""
    return NULL if body.is_particle else momentum_rate(body.moments, body.products, turning)


def momentum_rate(moments: Triple, products: Triple, turning: Turning) -> Triple:
    """Return ``J al + w x J w`` by the moments of inertia, and the products with the sign of `Body`.

    Its x component is ``Ix al_x + (Iz - Iy) w_y w_z + Cxy F_zx - Cxz F_yx + Cyz (F_zz - F_yy)``; the others follow by
    cyclic exchange.
    """
    x, y, z = (_of_moments(axis, moments, turning) for axis in range(3))
    return _with_products((x, y, z), products, turning)


def second_moment_rate(seconds: Triple, products: Triple, turning: Turning) -> Triple:
    """Return the same by the second moments of mass, of which a body may lack some: ``S_yy F_zy - S_zz F_yz + ...``."""
    x, y, z = (_of_seconds(axis, seconds, turning) for axis in range(3))
    return _with_products((x, y, z), products, turning)


def _with_products(rate: Triple, products: Triple, turning: Turning) -> Triple:
    if is_null(products):
        return rate
    x, y, z = (_of_products(axis, rate[axis], products, turning) for axis in range(3))
    return x, y, z


def _of_moments(i: int, I: Triple, turning: Turning) -> Expr:
    j, k = (i + 1) % 3, (i + 2) % 3
    w = turning.velocity
    return I[i] * turning.acceleration[i] + (I[k] - I[j]) * (w[j] * w[k])


def _of_seconds(i: int, S: Triple, turning: Turning) -> Expr:
    j, k = (i + 1) % 3, (i + 2) % 3
    F = turning.field
    return S[j] * F[3 * k + j] - S[k] * F[3 * j + k]


def _of_products(i: int, rate: Expr, C: Triple, turning: Turning) -> Expr:
    j, k = (i + 1) % 3, (i + 2) % 3
    F = turning.field
    rate += C[k] * F[3 * k + i] - C[j] * F[3 * j + i]
    return rate + C[i] * (F[4 * k] - F[4 * j])
