"""The motorcycle against the linear equations that Sharp printed in 1971."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, sin

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from symbody import Expr, jacobian, newton_euler, time_derivative
from symbody.models import motorcycle

MODEL = motorcycle()
P = {str(symbol): value for symbol, value in MODEL.parameters.items()}
Array = NDArray[np.float64]


def sharp(V: float) -> Array:
    """Return A of s' = A s, s = (v, yaw, lean and steering rate, lean, steering, Yf, Yr), z down, y to the right.

    [Sharp 1971]; the load Zf of the front wheel follows from the weight.
    """
    ce, se = cos(P["eps"]), sin(P["eps"])
    mr, mf, h, b, e, t, g = (P[name] for name in ("mr", "mf", "h", "b", "e", "tn", "g"))
    k = (P["a"] + e) * ce + P["f"] * se
    j = (P["a"] + e) * se - P["f"] * ce
    l = (P["a"] - t) / ce
    Zf = -g * (mr * b + mf * (b + k)) / (b + l)
    Ifx, Ifz = P["Ifx"], P["Ifz"]
    m12, m13, m14 = mf * k, mf * j + mr * h, mf * e
    m23 = mf * j * k - P["Crxz"] + (Ifz - Ifx) * se * ce
    m24, m34 = mf * e * k + Ifz * ce, mf * e * j + Ifz * se
    M = np.array(
        [
            [mr + mf, m12, m13, m14],
            [m12, mf * k**2 + P["Irz"] + Ifx * se**2 + Ifz * ce**2, m23, m24],
            [m13, m23, mr * h**2 + mf * j**2 + P["Irx"] + Ifx * ce**2 + Ifz * se**2, m34],
            [m14, m24, m34, Ifz + mf * e**2],
        ]
    )
    front, rear = P["ify"] / P["Rf"], P["iry"] / P["Rr"]
    C = V * np.array(
        [
            [0, mr + mf, 0, 0],
            [0, m12, -(front + rear), -front * se],
            [0, m13 + front + rear, 0, front * ce],
            [0, m14 + front * se, -front * ce, P["K"] / V],
        ]
    )
    lean = t * Zf - mf * e * g
    K = np.array([[0, 0], [0, 0], [-m13 * g, lean], [lean, lean * se]])
    forces = np.array([[1, 1], [l, -b], [0, 0], [-t, 0]])
    A = np.zeros((8, 8))
    A[:4, :4], A[:4, 4:6], A[:4, 6:] = (
        np.linalg.solve(M, -C),
        np.linalg.solve(M, -K),
        np.linalg.solve(M, forces),
    )
    A[4, 2] = A[5, 3] = 1
    slip = np.array([[1, l, 0, -t, 0, -V * ce, 0, 0], [1, -b, 0, 0, 0, 0, 0, 0]])
    camber = np.array([[0, 0, 0, 0, 1, se, 0, 0], [0, 0, 0, 0, 1, 0, 0, 0]])
    A[6] = (-P["Cf1"] * slip[0] + V * P["Cf2"] * camber[0]) / P["sigma"]
    A[7] = (-P["Cr1"] * slip[1] + V * P["Cr2"] * camber[1]) / P["sigma"]
    A[6, 6] = A[7, 7] = -V / P["sigma"]
    return A


def linearised(V: float) -> Array:
    """Return A of the small motions of the model in y, yaw, lean and steering, their rates, and the lateral forces.

    Straight running is symmetric, so that these move height, pitch and the wheels in second order alone. The
    multipliers keep their values, of which those that carry the weight turn with the wheels.
    """
    equations = newton_euler(MODEL.system)
    q = [MODEL[name] for name in ("y", "psi", "phi", "delta")]
    rates, accelerations = ([time_derivative(each, n) for each in q] for n in (1, 2))
    Y = [MODEL["Yf"], MODEL["Yr"]]
    rows = [equations.residuals[equations.coordinates.index(each)] for each in q]

    known = {time_derivative(each, n): 0.0 for each in MODEL.system.coordinates for n in (0, 1, 2)}
    known |= dict.fromkeys((*equations.multipliers, *Y), 0.0)
    known |= {**MODEL.parameters, **MODEL.inputs, time_derivative(MODEL["x"]): V}
    known |= {time_derivative(MODEL[f"phi{k}"]): V / P[f"R{k}"] for k in "rf"}

    def slopes(entries: Sequence[Expr], variables: Sequence[Expr]) -> Array:
        found = jacobian(entries, variables)
        size = range(len(entries)), range(len(variables))
        return np.array([[found[i, j].evaluate(known) for j in size[1]] for i in size[0]])

    left = np.array([each.evaluate(known) for each in equations.residuals])
    balance = slopes(equations.residuals, equations.multipliers)
    loads, *_ = np.linalg.lstsq(balance, -left)
    known |= dict(zip(equations.multipliers, loads, strict=True))
    assert_allclose(balance @ loads, -left, atol=1e-9)
    motion = np.linalg.solve(slopes(rows, accelerations), -slopes(rows, [*q, *rates, *Y]))
    lag = slopes([equations.state_rates[time_derivative(each)] for each in Y], [*q, *rates, *Y])
    return np.vstack([np.eye(4, 10, 4), motion, lag])


@pytest.mark.parametrize("V", [5.0, 15.0, 40.0])
def test_small_motions_are_those_of_sharp(V: float) -> None:
    """Two eigenvalues more are zero: those of the place across the road, and of the direction."""
    found, expected = np.linalg.eigvals(linearised(V)), np.linalg.eigvals(sharp(V))
    found = found[np.argsort(np.abs(found))]
    assert_allclose(found[:2], 0, atol=1e-6)
    assert_allclose(np.sort_complex(found[2:]), np.sort_complex(expected), rtol=1e-8, atol=1e-8)


def test_weave_wobble_and_capsize() -> None:
    """At 40 m/s: a wobble of 8 to 10 Hz, a weave of 2 to 4 Hz, and a capsize that takes seconds."""
    values = np.linalg.eigvals(sharp(40.0))
    hertz = np.sort(np.abs(values.imag[values.imag > 0])) / (2 * np.pi)
    assert 2 < hertz[0] < 4
    assert 8 < hertz[-1] < 10
    (capsize,) = values[(values.imag == 0) & (np.abs(values) < 1)]
    assert 0 < capsize.real < 0.5
