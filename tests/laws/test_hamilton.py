"""Hamilton's equations on random systems, in any speeds, against those of Newton and Euler: by value."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    CanonicalEquations,
    Matrix,
    System,
    Vector,
    functions_of_time,
    gradient,
    ground,
    hamilton,
    jacobian,
    moving_frame,
    newton_euler,
    rotate,
    substitute,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ModelError
from tests.laws.random_speeds import KINDS, drawn
from tests.laws.random_system import random_constrained_system, random_floating_system, random_system
from tests.repeated import repeated

RATES = {
    "rates": random_system,
    "twists": random_floating_system,
    "rates and constrained": random_constrained_system,
}


def made(seed: int, kind: str) -> System:
    return RATES[kind](seed) if kind in RATES else drawn(seed, kind)


def hamilton_of(system: System) -> CanonicalEquations | None:
    """Return Hamilton's equations; none where random bodies leave some motion without inertia."""
    if newton_euler(system).mass_matrix.rank() < len(system.speeds):
        with pytest.raises(ModelError, match="the mass matrix is singular"):
            hamilton(system)
        return None
    return hamilton(system)


def check(found: CanonicalEquations) -> None:
    """Put ``p = dT/du`` in: then q' are the kinematics, and ``d/dt dT/du - p'`` the residuals."""
    system, known = found.system, found.momenta_by_speeds
    rates = substitute([*found.rates.values()], known)
    n = len(system.coordinates)
    assert rates[:n] == tuple(system.kinematics.values())
    changes = system.rate([*known.values()])
    residuals = newton_euler(system).residuals
    for change, rate, residual in zip(changes, rates[n:], residuals, strict=True):
        assert change - rate == residual
    assert gradient(found.hamiltonian, found.momenta) == tuple(found.speeds.values())


@pytest.mark.parametrize("kind", [*RATES, *KINDS])
def test_most_draws_have_inertia_in_every_motion(kind: str) -> None:
    """The laws below say nothing about the others."""
    assert sum(hamilton_of(made(seed, kind)) is not None for seed in range(3)) >= 2


@pytest.mark.parametrize("kind", [*RATES, *KINDS])
@pytest.mark.parametrize("seed", [0, 1, *repeated(range(2, 6))])
def test_the_same_equations_as_newton_and_euler(seed: int, kind: str) -> None:
    found = hamilton_of(made(seed, kind))
    if found is not None:
        check(found)


@pytest.mark.parametrize("kind", ["tree", "embedded", "floating and constrained"])
@pytest.mark.parametrize("seed", [0, 1, *repeated([2, 3])])
def test_as_equations_in_momenta_they_are_projected(seed: int, kind: str) -> None:
    """With W = du/dp, constrained equations are ``W r``, and the Jacobian of the constraints is ``A W``."""
    found = hamilton_of(made(seed, kind))
    if found is None:
        return
    equations, reference = found.equations, newton_euler(found.system)
    known = dict(found.momenta_by_speeds)
    changes = dict(zip(map(time_derivative, known), found.system.rate([*known.values()]), strict=True))
    residuals = substitute(equations.residuals, known | changes)
    W = jacobian([*found.speeds.values()], found.momenta)
    assert equations.speeds == found.momenta
    assert jacobian(equations.residuals, equations.accelerations) == equations.mass_matrix
    assert equations.constraint_jacobian == reference.constraint_jacobian @ W
    if found.constraints:
        r = Matrix([[residual] for residual in reference.residuals])
        assert residuals == (W @ r).entries
        assert equations.mass_matrix == W
    else:
        assert residuals == reference.residuals


@pytest.mark.parametrize("seed", range(4))
def test_on_moving_frames(seed: int) -> None:
    """A driven master frame, whose weight is a load, and a pose whose twist holds a rate in other speeds."""
    u, w, s, x, y, th = functions_of_time("u w s x y th")
    m, I_x, I_y, I_z, V, g, k = symbols("m I_x I_y I_z V g k")
    turning = w + k * time_derivative(s)
    pose = translate(x, y, 0) * rotate("Z", th) if seed % 2 else None
    frame = moving_frame(V + u, 0, 0, 0, 0, turning, **({} if pose is None else {"pose": pose}))
    load = Body(frame * translate(1, s, 0) * rotate("Y", s), m, I_x, I_y, I_z)
    kinematics = {time_derivative(s): u * (1 + s**2) + t} if seed // 2 else {}
    weight = Vector(ground if pose else frame.ancestor, 0, g, 0)
    check(hamilton(System([load], (), [s], gravity=weight, speeds=[u, w], kinematics=kinematics)))
