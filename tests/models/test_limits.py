"""Models of which no numbers of motions are printed, in limits in which they are other machines, whose numbers are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from symbody import Expr, models, newton_euler
from symbody.models import ClassicSystem
from tests.models.running import LATERAL, Motorcycle, flexible
from tests.models.test_published import frequencies, linear
from tests.reference.mechanisms.problem import reference

# --- the full car ---

_WHEELS_AT_REST = {"kt": 1e10, "mu": 1.0}


def test_a_full_car_on_wheels_at_rest_is_the_automobile_of_rao() -> None:
    """Heave and pitch at 5.8593 and 9.4341 rad/s, as Rao prints for both axles on a spring; and roll.

    One wheel has half of the spring of its axle. The body rolls on springs at w/2: ``Ix phi'' = -w^2/2 (kf + kr) phi``.
    """
    rao = {"m": 1000.0, "Iy": 810.0, "a": 1.0, "b": 1.5, "kf": 9000.0, "kr": 11000.0, "cf": 0.0, "cr": 0.0}
    found = frequencies(models.full_car(), {}, **rao, **_WHEELS_AT_REST)[:3]
    roll = np.sqrt(3.0**2 / 2 * (9000 + 11000) / 460)
    assert_allclose(found, [5.8593, 9.4341, roll], atol=5e-5)


def strut_response(car: ClassicSystem, w: float, **numbers: float) -> NDArray[np.complex128]:
    """Return the answer of the coordinates to forces ``exp(i w t)`` of actuators in all struts."""
    M, C, K = linear(newton_euler(car.system), car, {}, **numbers)
    answer: NDArray[np.complex128] = np.linalg.solve(K - w**2 * M + 1j * w * C, [4, 0, 0, -1, -1, -1, -1])
    return answer


@pytest.mark.parametrize(("k", "c"), [(16000.0, 1000.0), (30000.0, 400.0)])
def test_a_full_car_of_four_equal_corners_has_the_frequencies_of_a_published_quarter_car(
    k: float, c: float
) -> None:
    """At 56.27 rad/s (tyre hop) actuators do not move the body, at 22.97 rad/s (rattle space) not the struts.

    Both are printed for bodies of 300 kg, wheels of 60 kg and tyres of 190 000 N/m, whatever the strut, in [MathWorks,
    Robust Control Toolbox, Robust control of an active suspension].
    """
    corners = {"m": 1200.0, "mu": 60.0, "kt": 190000.0, "b": 1.4, "kf": k, "kr": k, "cf": c, "cr": c}
    car = models.full_car()

    def body(w: float) -> complex:
        return complex(strut_response(car, w, **corners)[0])

    def strut(w: float) -> complex:
        answer = strut_response(car, w, **corners)
        return complex(answer[0] - answer[3])

    for moved, printed, beside in ((body, 56.27, 50.0), (strut, 22.97, 20.0)):
        around = [moved(printed + shift) / moved(beside) for shift in (-0.01, 0.01)]
        assert np.abs(around).max() < 0.01
        assert around[0].real * around[1].real < 0


# --- the flexible motorcycle ---


def stiffened(speed: float) -> Motorcycle:
    """Return the machine of 1994 with the numbers of that of 1971: one body for the frame, and springs that are stiff.

    Lengths along the steering axis become heights: the fork has its centre of mass at jj, and steers about a point at
    the height ss; front wheel and rear wheel touch the ground at ll and -bb.
    """
    rigid = {str(symbol): value for symbol, value in models.motorcycle().parameters.items()}
    ce, se = np.cos(rigid["eps"]), np.sin(rigid["eps"])
    same = {
        "Ifx": "Ifx",
        "Ifz": "Ifz",
        "Ify": "Ify",
        "Irx": "Irx",
        "Irz": "Irz",
        "Iry": "Iry",
        "Irxz": "Crxz",
    }
    same |= {"Mf": "mf", "Mr": "mr", "bb": "b", "ee": "e", "hh": "h", "Rf": "Rf", "Rr": "Rr", "trail": "tn"}
    same |= {"eps": "eps", "irwy": "iry", "ifwy": "ify", "Dsteer": "K", "sigmar": "sigma", "sigmaf": "sigma"}
    same |= {name: name for name in ("Cr1", "Cr2", "Cf1", "Cf2", "g")}
    given = {name: rigid[source] for name, source in same.items()}
    given |= {"ll": (rigid["a"] - rigid["tn"]) / ce, "jj": (rigid["a"] + rigid["e"]) * se + rigid["f"] * ce}
    given |= dict.fromkeys(("Mb", "Mp", "Ipy", "Ipz", "Ipxz", "iry", "ksteer", "Dc", "Lc"), 0.0)
    given |= {"Irx": rigid["Irx"] - 2.0, "Ipx": 1.0, "irwx": 1.0}  # rider and arm have a part of the frame's
    given |= {f"C{wheel}{k}": 0.0 for wheel in "rf" for k in (3, 4, 5)}
    given |= dict.fromkeys(("kv", "klambda", "kgamma", "kzeta"), 1e10)
    model = flexible(speed).model
    parameters: dict[Expr, float] = model.parameters | {model[name]: each for name, each in given.items()}
    return Motorcycle(replace(model, parameters=parameters), LATERAL)


@pytest.mark.parametrize("row", [1, 3, 5, 7])
def test_a_flexible_motorcycle_that_is_stiff_has_the_eigenvalues_of_sharps_tables(row: int) -> None:
    """Weave, wobble and capsize of 1971, with two or three printed digits."""
    printed = reference("sharp1971")
    speed = printed["speeds"][row] * printed["units"]["ft"]
    machine = stiffened(speed)
    values = np.linalg.eigvals(machine.linearised(machine.moving(speed)))
    modes = [
        printed[name]["real"][row] + 1j * printed[name]["imaginary"][row] for name in ("weave", "wobble")
    ]
    for expected in (printed["capsize"][row] + 0j, *modes):
        found = values[np.argmin(np.abs(values - expected))]
        assert found.real == pytest.approx(expected.real, abs=0.016)
        assert found.imag == pytest.approx(expected.imag, abs=0.02 if expected.imag < 10 else 0.055)
