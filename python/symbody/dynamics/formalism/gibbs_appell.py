"""The equations of Gibbs and Appell [Appell 1899; Greenwood 2003, sec. 4.5]."""

from __future__ import annotations

from symbody.dynamics.equations.equations import Equations
from symbody.dynamics.equations.independence import check_independent
from symbody.errors import ModelError
from symbody.geometry.given.argument import checked
from symbody.multibody import Body, System
from symbody.symbolic import Expr, cross3, dot3, gradient, number

from .body_rates import body_rates
from .checked_tree import check_rigid
from .derived import derived
from .virtual_power import Held, along_speeds, power_of_loads, power_of_weight


@checked(ModelError)
def gibbs_appell(system: System) -> Equations:
    """Return the equations of Gibbs and Appell: ``dS/du_k' - Q_k - A^T lambda`` [Greenwood 2003, sec. 4.5].

    The Gibbs function is the energy of accelerations ``S = sum(m a_G . a_G / 2 + w' . J w' / 2 + w' . (w x J w))``, in
    which terms without accelerations are left out; w' are the rates of the components in the body's axes. Q are the
    generalised forces of weight and loads, and lambda the multipliers of the constraints. The speeds may be
    quasi-velocities. The terms take the nodes of `newton_euler` if, and only if, both derivations agree.

    Raises:
        FrameError: a frame isn't rigid by itself, as in natural coordinates.

    >>> from symbody import Body, System, Vector, ground, functions_of_time, rotate, symbols, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> pendulum = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))
    >>> gibbs_appell(pendulum).residuals
    (l*m*(l*theta'' + g*sin(theta)),)
    """
    check_independent(system)
    return derived(system, _residuals, "gibbs_appell", check_rigid)


def _residuals(system: System) -> tuple[Expr, ...]:
    S = sum((_acceleration_energy(body, system) for body in system.bodies), start=number(0))
    held = Held()
    power = power_of_loads(system, held) + power_of_weight(system, held)
    forces = held.released(along_speeds(power, system))
    slopes = gradient(S, system.accelerations)
    return tuple(slope - force for slope, force in zip(slopes, forces, strict=True))


def _acceleration_energy(body: Body, system: System) -> Expr:
    w, _, spin_rate, acceleration = body_rates(body, system)
    energy = body.mass * dot3(acceleration, acceleration) / 2
    if not body.is_particle:
        energy += dot3(spin_rate, body.spin_momentum(spin_rate)) / 2
        energy += dot3(spin_rate, cross3(w, body.spin_momentum(w)))
    return energy
