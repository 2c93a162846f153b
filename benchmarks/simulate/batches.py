"""The many motions that are measured: double pendulums, slider-cranks, arms that fall."""

from __future__ import annotations

import numpy as np

from symbody import newton_euler, simulate_many
from symbody.models import slider_crank

from . import by_diffrax, by_jax, by_mujoco
from .panda import arm, panda
from .panda import starts as arm_starts
from .problem import Array, Problem, first_state
from .throughput import (
    FINER,
    TOLERANCES,
    Batch,
    Manner,
    by_simulate_many,
    loop_of_simulate,
    native,
    one_at_a_time,
    one_by_one,
    solve_ivp,
)

ERROR = 1e-6
"""What each contender may miss at the end of a pendulum or a linkage, in rad or in lengths."""

ANGLES = (0.1, 0.8)
"""From where the rods are let go, in rad: small to medium swings, none of which is chaotic."""

CRANKS = (0.6, 2.5)
"""The angles at which cranks are let go, in rad."""

PENDULUMS = (
    "motions of the double pendulum over {duration:g} s, released from rest at angles of 0.1 to 0.8 rad."
)
LINKAGES = (
    "motions of the slider-crank with spring and damper of SUNDIALS' examples over {duration:g} s, from crank angles "
    "between 0.6 and 2.5 rad. simulate_many gets these angles and solves for the other coordinates; its motions keep "
    "the constraints. So does simulate_many one motion at a time, which finds all initial states together as well. "
    "*One by one*, it solves for each of them alone, as simulate does; a sample tells. The native integrator "
    "and solve_ivp get the whole states; solve_ivp's motions drift off the constraints."
)
ARMS = (
    "motions of the Franka Panda arm over {duration:g} s, released from rest at random angles up to 0.5 rad: seven "
    "joints, no friction. MuJoCo runs the same arm by `mujoco.rollout` with its method of order 4, without contacts; "
    "it returns the states of all steps."
)


def starts(side: int, size: int = 4) -> Array:
    """Return initial states at rest, from a square grid of angles."""
    angles = np.linspace(*ANGLES, side)
    states = np.zeros((side * side, size))
    states[:, :2] = np.stack(np.meshgrid(angles, angles, indexing="ij"), axis=-1).reshape(-1, 2)
    return states


def pendulums(problem: Problem, side: int) -> Batch:
    """Return double pendulums, by all ways that this machine has.

    Args:
        problem: the pendulum.
        side: the number of angles of each rod.
    """
    manners = [
        *by_simulate_many(problem),
        *native(problem),
        *one_at_a_time(problem),
        loop_of_simulate(problem),
    ]
    manners += [solve_ivp(problem, method) for method in ("DOP853", "LSODA")]
    if not by_jax.missing():
        steps = tuple(float(round(80 * problem.duration * FINER**k)) for k in range(12))
        manners += [
            Manner("JAX, vmap of odeint", by_jax.by_odeint(problem), _from(1e-7)),
            Manner("JAX, vmap of RK4 in lax.scan", by_jax.by_runge_kutta(problem), steps, "steps"),
        ]
    if not by_diffrax.missing():
        manners.append(Manner("JAX, vmap of diffrax's Tsit5", by_diffrax.by_tsit5(problem), _from(1e-6)))
    return Batch(problem, starts(side), tuple(manners), ERROR, PENDULUMS, by_diffrax.missing())


def _from(loosest: float) -> tuple[float, ...]:
    """Return the tolerances from one on: what compiles for each should not try those that are far too loose."""
    return tuple(tolerance for tolerance in TOLERANCES if tolerance <= loosest)


def linkages(count: int, duration: float = 5.0) -> Batch:
    """Return slider-cranks: three coordinates, two constraints."""
    model = slider_crank()
    problem = Problem(
        "slider-crank", newton_euler(model.system), model.parameters, first_state(model), duration
    )
    states = _closed(problem, np.linspace(*CRANKS, count))
    manners = [*by_simulate_many(problem, given=1), *native(problem), *one_at_a_time(problem, given=1)]
    manners += [one_by_one(problem, given=1), loop_of_simulate(problem), solve_ivp(problem, "DOP853")]
    return Batch(problem, states, tuple(manners), ERROR, LINKAGES)


def _closed(problem: Problem, cranks: Array) -> Array:
    """Return the states at rest with these angles of the crank."""
    q = problem.equations.coordinates[0]
    guess = {name: value for name, value in problem.initial.items() if name != q}
    runs = simulate_many(
        problem.equations, problem.parameters, {q: cranks}, [0.0, 1e-9, 2e-9], guess=guess, progress=False
    )
    return np.asarray(runs.states[:, 0])


def arms(count: int, duration: float = 1.0) -> Batch:
    """Return arms that fall freely, by symbody and MuJoCo with as many threads."""
    problem = panda(duration)
    manners = [*by_simulate_many(problem), loop_of_simulate(problem)]
    if not by_mujoco.missing():
        steps = tuple(float(round(1500 * duration * FINER**k)) for k in range(24))
        manners += [
            Manner(f"MuJoCo, rollout, {threads} thread{'s' * (threads > 1)}", many, steps, "steps")
            for threads in (1, 2)
            for many in [by_mujoco.by_rollout(arm(), duration, threads)]
        ]
    return Batch(problem, arm_starts(count), tuple(manners), 1e-4, ARMS, by_mujoco.missing())
