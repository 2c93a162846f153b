"""The balance of energy of IDA's motions: what their tolerances explain has no notice, large losses always have one."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable

import numpy as np
import pytest

from symbody import (
    Body,
    Force,
    Link,
    ModelNotice,
    System,
    assemble,
    equilibrium,
    free,
    functions_of_time,
    ground,
    newton_euler,
    simulate,
    symbols,
    time_derivative,
    translate,
)
from tests.reference.mechanisms.double_pendulum import natural_double_pendulum
from tests.reference.mechanisms.heavy_top import heavy_top
from tests.reference.mechanisms.problem import Problem
from tests.reference.mechanisms.simple_pendulum import natural_simple_pendulum, simple_pendulum
from tests.repeated import repeated

from .singular_mechanisms import kite
from .singular_scan import moved


def notices(problem: Problem, **options: object) -> tuple[float, list[str]]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        motion = simulate(problem.equations, problem.parameters, problem.initial, progress=False, **options)  # type: ignore[arg-type]
    said = [str(each.message) for each in caught]
    return motion.energy_drift, [text for text in said if "the energy balance" in text]


@pytest.mark.parametrize(
    ("method", "rtol"),
    [
        ("ida", 1e-9),
        ("ida2", 1e-3),
        *repeated([("ida", 1e-3), ("ida", 1e-6), ("ida2", 1e-6), ("ida2", 1e-9)]),
    ],
)
@pytest.mark.parametrize(
    ("make", "end"), [(simple_pendulum, 100), (natural_double_pendulum, 10), (heavy_top, 2)]
)
def test_regular_motions_have_no_notice(
    make: Callable[[], Problem], end: float, rtol: float, method: str
) -> None:
    assert notices(make(), t=(0, end), method=method, rtol=rtol)[1] == []


@pytest.mark.parametrize(("make", "rtol"), [(simple_pendulum, 1e-6), (natural_double_pendulum, 1e-10)])
def test_speeds_of_index_3_err_by_the_coordinates_over_a_step(
    make: Callable[[], Problem], rtol: float
) -> None:
    drift, said = notices(make(), t=(0, 10), method="ida3", rtol=rtol)
    assert drift > 100 * rtol
    assert said == []


def test_a_motion_smaller_than_the_tolerances_has_no_notice() -> None:
    still = simple_pendulum()
    still.initial.update(dict.fromkeys(still.initial, 0.0))
    still.initial[still.equations.coordinates[0]] = 1e-9 - np.pi / 2
    for method in ("ida", "ida3"):
        assert notices(still, t=(0, 10), method=method, rtol=1e-3)[1] == []


@pytest.mark.parametrize("method", ["dop853", "tsit5", "bdf", "esdirk34", "tr_bdf2"])
@pytest.mark.parametrize("away", [0.0, 1e-9, *repeated([1e-6])])
def test_a_body_at_rest_on_loads_alone_has_no_notice(method: str, away: float) -> None:
    """Its weight is a load here, so that what moves is rounding, of work as well."""
    m, k, z = *symbols("m k"), functions_of_time("z")
    body = Body(translate(0, z, 0), m)
    load = Force(ground, 0, -k * z - 9.81 * m, 0, at=body.center_of_mass, on=body)
    equations = newton_euler(System([body], [load], [z]))
    for stiffness in (7.0, 40.0, 123.0):
        values = {m: 1, k: stiffness}
        start = {z: equilibrium(equations, values).coordinates[z] + away}
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            simulate(equations, values, start, t=(0, 10), method=method)


@pytest.mark.parametrize("instants", [3, 5, 1001])
def test_large_losses_have_a_notice_at_loose_tolerances(instants: int) -> None:
    """A kite loses a quarter of its energy at singular positions, more or less, or nearly all: rounding decides."""
    motion, said = moved(kite(), -5.1, t=np.linspace(0, 10, instants), method="ida3", rtol=1e-4)
    assert motion.energy_drift > 0.2
    off = [re.search(r"the energy balance, including work, is off by ([\d.]+) of", text) for text in said]
    (told,) = [float(found[1]) for found in off if found]
    assert told == float(f"{motion.energy_drift:.1g}")


@pytest.mark.parametrize(("make", "end"), [(natural_simple_pendulum, 100), (heavy_top, 2)])
def test_so_have_large_losses_of_regular_motions(make: Callable[[], Problem], end: float) -> None:
    drift, said = notices(make(), t=(0, end), method="ida3", rtol=1e-3)
    assert drift > 0.5
    assert any("the energy balance" in text for text in said)


def test_so_have_motions_that_begin_beside_a_singular_position() -> None:
    """Rates of Euler angles are 1e9 rad/s there for a while, so that one tolerance is much energy."""
    rotor = Link("rotor", 1, 1, 2, 3)
    joint = free("F", ground, rotor)
    psi, theta, _ = joint.coordinates[3:]
    start = {theta: np.pi / 2 - 1e-9, time_derivative(psi): 1.0, time_derivative(theta): 0.3}
    equations = newton_euler(assemble([joint]).system())
    with pytest.warns(ModelNotice, match=r"the energy balance, including work, is off by 0\.\d"):
        motion = simulate(equations, {}, start, t=(0, 1))
    assert motion.energy_drift > 1e-2
