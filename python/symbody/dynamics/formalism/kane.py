"""Kane's equations [Kane & Levinson 1985, sec. 6.1]."""

from __future__ import annotations

from symbody.dynamics.equations.equations import Equations
from symbody.dynamics.equations.independence import check_independent
from symbody.errors import ModelError
from symbody.geometry.given.argument import checked
from symbody.multibody import System
from symbody.symbolic import Expr, add3, cross3, dot3, scale3

from .body_rates import body_rates
from .checked_tree import check_rigid
from .derived import derived
from .virtual_power import Held, along_speeds, power_of_loads, power_of_weight


@checked(ModelError)
def kane(system: System) -> Equations:
    """Return Kane's equations: ``-(F_k + F_k*) - A^T lambda``, one per speed u_k [Kane & Levinson 1985, sec. 6.1].

    The generalised active force is ``F_k = sum(F . dv/du_k) + sum(M . dw/du_k)`` over weight and loads. The generalised
    inertia force is ``F_k* = -sum(m a_G . dv_G/du_k + (J w' + w x J w) . dw/du_k)`` over the bodies. The partial
    velocities ``dv/du_k`` and ``dw/du_k`` are by the speeds of the system, which may be quasi-velocities. Constraints
    keep their multipliers; `embedded` eliminates these with the dependent speeds. The terms take the nodes of
    `newton_euler` if, and only if, both derivations agree.

    Raises:
        FrameError: a frame isn't rigid by itself, as in natural coordinates.

    >>> from symbody import Body, System, Vector, ground, functions_of_time, rotate, symbols, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> pendulum = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))
    >>> kane(pendulum).residuals
    (l*m*(l*theta'' + g*sin(theta)),)
    """
    check_independent(system)
    return derived(system, _residuals, "kane", check_rigid)


def _residuals(system: System) -> tuple[Expr, ...]:
    held = Held()
    power = -power_of_loads(system, held) - power_of_weight(system, held)
    for body in system.bodies:
        w, v, spin_rate, acceleration = body_rates(body, system)
        power += dot3(held.stand_ins(scale3(body.mass, acceleration)), v)
        if not body.is_particle:
            moment = add3(body.spin_momentum(spin_rate), cross3(w, body.spin_momentum(w)))
            power += dot3(held.stand_ins(moment), w)
    return held.released(along_speeds(power, system))
