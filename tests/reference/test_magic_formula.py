"""The Magic Formula against published forces of three tyres, computed by two other implementations."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from symbody import lambdify, magic_formula, symbols

SETS: dict[str, Any] = json.loads((Path(__file__).parent / "magic_formula.json").read_text(encoding="utf-8"))
N, kappa, slip, camber, pressure, speed = symbols("N kappa slip camber pressure speed")


def rows(name: str) -> dict[str, np.ndarray]:
    given = SETS[name]
    return dict(zip(given["columns"], np.array(given["rows"]).T, strict=True))


def computed(name: str) -> np.ndarray:
    """Fx, Fy, Mx, My and Mz at all rows of a set."""
    given, at = SETS[name], rows(name)
    inflated = {"pressure": pressure} if "pressure" in at else {}
    law = magic_formula(given["coefficients"], version=given["version"], **inflated)
    f = lambdify([N, kappa, slip, camber, pressure], list(law(N, kappa, slip, camber)))
    count = len(at["load"])
    values = (at["load"], at["kappa"], np.tan(at["alpha"]), at["camber"], at.get("pressure", np.ones(count)))
    return np.array([np.broadcast_to(each, count) for each in f(*values)])


@pytest.mark.parametrize("name", ["set 5.2", "set 6.1"])
def test_forces_and_moments_are_those_of_mfeval(name: str) -> None:
    at = rows(name)
    Fx, Fy, Mx, My, Mz = computed(name)
    np.testing.assert_allclose(Fx, at["Fx"], rtol=3e-9)
    np.testing.assert_allclose(Fy, at["Fy"], rtol=1e-9)
    np.testing.assert_allclose(Mx, at["Mx"], rtol=1e-8)
    assert ("My" in at) == (name == "set 5.2")
    if "My" in at:
        np.testing.assert_allclose(My, at["My"], rtol=1e-12)
    as_in_the_book = at["Mzr"] * (np.cos(at["alpha"]) / np.cos(np.tan(at["alpha"])) - 1)
    np.testing.assert_allclose(Mz, at["Mz"] + as_in_the_book, rtol=1e-6, atol=1e-6)


def test_rolling_resistance_at_speeds_is_that_of_mfeval() -> None:
    given, at = SETS["rolling resistance"], rows("rolling resistance")
    law = magic_formula(given["coefficients"], version=given["version"], pressure=pressure)
    f = lambdify([N, camber, speed, pressure], [law(N, 0, 0, camber, speed=speed).rolling])
    (found,) = f(at["load"], at["camber"], at["speed"], at["pressure"])
    np.testing.assert_allclose(found, at["My"], rtol=1e-9)


def test_relaxation_lengths_are_those_of_mfeval() -> None:
    given, at = SETS["set 5.2"], rows("set 5.2")
    law = magic_formula(given["coefficients"])
    f = lambdify([N, camber], list(law.relaxation_lengths(N, camber)))
    scaled = magic_formula(given["coefficients"] | {"LSGKP": 2, "LSGAL": 3}).relaxation_lengths(N, camber)
    assert scaled == tuple(
        k * each for k, each in zip((2, 3), law.relaxation_lengths(N, camber), strict=True)
    )
    along, across = f(at["load"], at["camber"])
    np.testing.assert_allclose(along, at["sigma_x"], rtol=1e-12)
    np.testing.assert_allclose(across, at["sigma_y"], rtol=1e-12)


def test_forces_of_the_tyre_of_the_book() -> None:
    """By another implementation; where the slip angle is zero, exactly: see the note in the file."""
    at = rows("tyre of the book")
    Fx, Fy, *_ = computed("tyre of the book")
    np.testing.assert_allclose(Fx, at["Fx"], rtol=2e-9)
    np.testing.assert_allclose(Fy, at["Fy"], rtol=2e-3)
    straight = at["alpha"] == 0
    np.testing.assert_allclose(Fy[straight], at["Fy"][straight], rtol=1e-4)


def test_the_sources_are_named() -> None:
    for given in SETS.values():
        assert "github.com" in given["source"]
