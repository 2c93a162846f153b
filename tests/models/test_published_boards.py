"""The sleigh and the snakeboard against equations or numbers that were published, or a closed form."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from symbody import (
    System,
    cos,
    models,
    newton_euler,
    simulate,
    sin,
    time_derivative,
)
from symbody import t as time

TIGHT = {"rtol": 1e-11, "atol": 1e-12}


def test_chaplygins_sleigh() -> None:
    """v = V tanh(k (t - t0)), where V is the speed of straight running with the same energy [Bloch 2003]."""
    model = models.chaplygin_sleigh()
    m, I, a = model.parameters.values()
    motion = simulate(newton_euler(model.system), model.parameters, model.initial, (0, 5), **TIGHT)
    x, y, psi = model.system.coordinates
    ahead = motion[cos(psi) * time_derivative(x) + sin(psi) * time_derivative(y)]
    V = np.sqrt(ahead[0] ** 2 + (I / m + a**2) * 2.0**2)
    k = m * a * V / (I + m * a**2)
    assert_allclose(ahead, V * np.tanh(k * motion.t + np.arctanh(ahead[0] / V)), atol=1e-8)
    assert ahead[-1] > 0.9 * V


def test_snakeboard_turns_about_the_intersection_of_its_axles() -> None:
    model = models.snakeboard()
    start = {**model.initial, time_derivative(model["phi"]): 0.0, model["theta"]: 0.0}
    motion = simulate(
        newton_euler(model.system), model.parameters, start, (0, 1e-3), inputs=model.inputs, **TIGHT
    )
    x, theta = (time_derivative(model[name]) for name in ("x", "theta"))
    assert_allclose(motion[x][0] / motion[theta][0], 0.2 / np.tan(0.5), rtol=1e-9)


def test_a_snakeboard_of_a_textbook() -> None:
    """The rates that [Moore, Learn Multibody Dynamics, ch. Equations of Motion with Nonholonomic Constraints] prints.

    Three bodies of 1 kg and 0.1 kg m^2, the axles 0.7 m apart and steered by 5 and -5 degrees. They turn freely on the
    board there, so that they do not resist its yaw, as the rotor does not here.
    """
    model = models.snakeboard()
    values = {"m": 3.0, "J": 0.1 + 2 * 0.35**2 - 2 * 0.01, "Jr": 0.03, "Jw": 0.01, "l": 0.35}
    parameters = {model[name]: value for name, value in values.items()}
    phi, theta, x = (model[name] for name in ("phi", "theta", "x"))
    start = {phi: np.deg2rad(5.0), theta: 0.0, time_derivative(theta): 0.1 / 0.35, time_derivative(phi): 0.01}
    still = dict.fromkeys((model["Mr"], model["Ms"]), 0.0)
    motion = simulate(newton_euler(model.system), parameters, start, (0, 1e-3), inputs=still, **TIGHT)
    assert_allclose(motion[time_derivative(x)][0], 1.14300523, rtol=1e-8)
    assert_allclose(0.35 * motion[time_derivative(theta, 2)][0], 0.01143537, rtol=1e-6)


def test_reduced_equations_of_the_snakeboard() -> None:
    """p' = 2 Jr cos(phi)^2 phi' psi' - tan(phi) phi' p, where J + Jr + 2 Jw = m l^2 [Ostrowski et al. 1994].

    The others have the form of [Bloch, Krishnaprasad, Marsden & Murray 1996]: the connection, which gives the velocity
    of the board by p and psi', and the equations of the shape (psi, phi) by the torques.
    """
    model = models.snakeboard()
    m, J, Jr, Jw, l = (model[name] for name in ("m", "J", "Jr", "Jw", "l"))
    assert_allclose((J + Jr + 2 * Jw - m * l**2).evaluate(model.parameters), 0, atol=1e-12)
    theta, psi, phi = model["theta"], model["psi"], model["phi"]
    dx, dy, dtheta, dpsi, dphi = map(time_derivative, model.system.coordinates)
    # Steering by phi at the front turns the board to the left there; the paper's axles steer by -phi at the front.
    ahead = cos(theta) * dx + sin(theta) * dy
    p = 2 * m * l * cos(phi) ** 2 * ahead + m * l**2 * sin(2 * phi) * dtheta + Jr * sin(2 * phi) * dpsi
    torques = {model["Mr"]: 0.05, model["Ms"]: -0.002}
    share = Jr / (m * l**2)
    reduced = {
        time_derivative(p): 2 * Jr * cos(phi) ** 2 * dphi * dpsi - sin(phi) / cos(phi) * dphi * p,
        ahead: p / (2 * m * l) - l * share / 2 * sin(2 * phi) * dpsi,
        dtheta: sin(phi) / cos(phi) * p / (2 * m * l**2) - share * sin(phi) ** 2 * dpsi,
        (1 - share * sin(phi) ** 2) * time_derivative(psi, 2): (
            share / 2 * sin(2 * phi) * dphi * dpsi - dphi * p / (2 * m * l**2) + torques[model["Mr"]] / Jr
        ),
        2 * Jw * time_derivative(phi, 2): 2 * torques[model["Ms"]],
    }
    start = {phi: 0.3, theta: 0.2, dtheta: 0.5, dpsi: 2.0, dphi: 1.0}
    motion = simulate(newton_euler(model.system), model.parameters, start, (0, 0.5), inputs=torques, **TIGHT)
    for left, right in reduced.items():
        assert_allclose(motion[left - right], 0, atol=1e-7)


def test_the_snakeboard_goes_along_a_circle_by_the_turns_of_its_rotor() -> None:
    """At rest and with fixed axles p is zero: by a turn psi, the heading changes by -Jr sin(phi)^2 psi/(m l^2).

    The way is ``-Jr sin(2 phi) psi/(2 m l)``, whatever the torque was.
    """
    model = models.snakeboard()
    m, _, Jr, _, l = (model.parameters[model[name]] for name in ("m", "J", "Jr", "Jw", "l"))
    x, y, theta, psi, phi = model.system.coordinates
    inputs = {model["Mr"]: 0.02 + 0.1 * sin(3 * time) * cos(time), model["Ms"]: 0.0}
    start = {**dict.fromkeys(map(time_derivative, model.system.coordinates), 0.0), theta: 0.3, phi: 0.4}
    motion = simulate(newton_euler(model.system), model.parameters, start, (0, 12), inputs=inputs, **TIGHT)
    turned = motion[psi] - motion[psi][0]
    assert np.abs(turned).max() > 2 * np.pi
    assert_allclose(motion[phi], 0.4, atol=1e-9)
    assert_allclose(motion[theta] - 0.3, -Jr / (m * l**2) * np.sin(0.4) ** 2 * turned, atol=1e-8)
    radius, way = l / np.tan(0.4), -Jr * np.sin(0.8) / (2 * m * l) * turned
    heading = 0.3 + way / radius
    assert_allclose(motion[x] - motion[x][0], radius * (np.sin(heading) - np.sin(0.3)), atol=1e-8)
    assert_allclose(motion[y] - motion[y][0], radius * (np.cos(0.3) - np.cos(heading)), atol=1e-8)


def by_the_momentum_equation(A: float, B: float, values: dict[str, float], end: float) -> np.ndarray:
    """Return x, y and theta of the snakeboard at an instant of the drive gait, ``psi = A sin t, phi = B sin t``.

    By the published equation of the momentum p; the wheels give ``theta' = v tan(phi)/l``, and p the forward speed v,
    ``p = 2 m l v + Jr sin(2 phi) psi'``.
    """
    m, Jr, l = (values[name] for name in ("m", "Jr", "l"))

    def rates(t: float, state: np.ndarray) -> list[float]:
        p, _, _, theta = state
        phi, dphi, dpsi = B * np.sin(t), B * np.cos(t), A * np.cos(t)
        v = (p - Jr * np.sin(2 * phi) * dpsi) / (2 * m * l)
        dp = 2 * Jr * np.cos(phi) ** 2 * dphi * dpsi - np.tan(phi) * dphi * p
        return [dp, v * np.cos(theta), v * np.sin(theta), v * np.tan(phi) / l]

    found = solve_ivp(rates, (0, end), np.zeros(4), method="DOP853", rtol=1e-11, atol=1e-13)
    return found.y[1:, -1]


@pytest.mark.parametrize("cycles", [1, 3])
def test_the_drive_gait_of_the_snakeboard_goes_as_far_as_the_momentum_equation_says(cycles: int) -> None:
    """The gait with one frequency, which gains speed along the board [Ostrowski et al. 1994, sec. 5]."""
    model, A, B = models.snakeboard(), 0.7, 0.3
    system, psi, phi = model.system, model["psi"], model["phi"]
    gait = [psi - A * sin(time), phi - B * sin(time)]
    driven = System(system.bodies, (), system.coordinates, [*system.conditions, *gait])
    end = 2 * np.pi * cycles
    start = dict.fromkeys(system.coordinates, 0.0)
    motion = simulate(newton_euler(driven), model.parameters, start, [0, end], **TIGHT)
    values = {name: model.parameters[model[name]] for name in ("m", "Jr", "l")}
    expected = by_the_momentum_equation(A, B, values, end)
    found = [motion[model[name]][-1] for name in ("x", "y", "theta")]
    assert_allclose(found, expected, rtol=1e-7, atol=1e-9)
    assert abs(expected[0]) > 0.01
