"""The rate of a body's own angular momentum."""

from __future__ import annotations

from symbody.geometry.acceleration_field import Turning
from symbody.geometry.triple import NULL, Triple
from symbody.multibody import Body
from symbody.symbolic import Expr


def spin_momentum_rate(body: Body, turning: Turning) -> Triple:
    """Return ``dH_G/dt = J al + w x J w`` in the body's axes, by the products that the field F has made already.

    Its x component is ``Ix al_x + (Iz - Iy) w_y w_z + Cxy F_zx - Cxz F_yx + Cyz (F_zz - F_yy)``; the others follow by
    cyclic exchange.
    """
    if body.is_particle:
        return NULL
    x, y, z = (_moment_about(axis, body, turning) for axis in range(3))
    return x, y, z


def _moment_about(i: int, body: Body, turning: Turning) -> Expr:
    j, k = (i + 1) % 3, (i + 2) % 3
    w, F, I, C = turning.velocity, turning.field, body.moments, body.products
    moment = I[i] * turning.acceleration[i] + (I[k] - I[j]) * (w[j] * w[k])
    if not body.has_products:
        return moment
    moment += C[k] * F[3 * k + i] - C[j] * F[3 * j + i]
    return moment + C[i] * (F[4 * k] - F[4 * j])
