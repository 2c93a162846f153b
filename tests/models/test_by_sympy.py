"""Models for which no numbers are published: their accelerations are those that SymPy's mechanics finds for them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from symbody import forward_dynamics, lambdify, models, newton_euler
from symbody.models import ClassicSystem

sympy = pytest.importorskip("sympy")
mechanics = pytest.importorskip("sympy.physics.mechanics")


def accelerations(model: ClassicSystem, q: list[float], u: list[float]) -> NDArray[np.float64]:
    """Return the accelerations by symbody, with the numbers and inputs of the model."""
    eqs = newton_euler(model.system)
    known = {**model.parameters, **model.inputs}
    found = [each.subs(known) for each in forward_dynamics(eqs).accelerations]
    return np.array(lambdify([eqs.coordinates, eqs.speeds], found)(q, u))


class Sketch:
    """A model in SymPy: coordinates with their rates as speeds, bodies, and loads."""

    def __init__(self, model: ClassicSystem) -> None:
        self.N, self.O = mechanics.ReferenceFrame("N"), mechanics.Point("O")
        self.O.set_vel(self.N, 0)
        self.names = [str(each) for each in model.system.coordinates]
        self.q, self.u = (
            mechanics.dynamicsymbols(" ".join(f"{k}_{name}" for name in self.names)) for k in "qu"
        )
        self.bodies: list[Any] = []
        self.loads: list[Any] = []

    def at(self, name: str) -> Any:
        return self.q[self.names.index(name)]

    def rate(self, name: str) -> Any:
        return self.u[self.names.index(name)]

    def body(self, point: Any, frame: Any, mass: float, moments: tuple[float, float, float]) -> None:
        tensor = mechanics.inertia(frame, *moments)
        self.bodies.append(mechanics.RigidBody(f"B{len(self.bodies)}", point, frame, mass, (tensor, point)))

    def accelerations(
        self, q: list[float], u: list[float], constraints: tuple[Any, ...] = ()
    ) -> NDArray[np.float64]:
        """Return the accelerations, by Kane's equations with the first speeds dependent on the others."""
        kinematics = [each.diff() - speed for each, speed in zip(self.q, self.u, strict=True)]
        count = len(constraints)
        method = mechanics.KanesMethod(
            self.N,
            self.q,
            self.u[count:],
            kinematics,
            u_dependent=self.u[:count] or None,
            velocity_constraints=list(constraints) or None,
        )
        method.kanes_equations(self.bodies, self.loads)
        values = dict(zip([*self.q, *self.u], [*q, *u], strict=True))
        matrix, forcing = (
            np.array(part.subs(values).evalf(), dtype=float)
            for part in (method.mass_matrix_full, method.forcing_full)
        )
        found = np.linalg.solve(matrix, forcing).ravel()[len(q) :]
        return np.concatenate([found[len(q) - count :], found[: len(q) - count]])


@pytest.mark.repeated
def test_full_car() -> None:
    """Beside its published equations. In a position far from rest, at speeds that bend nothing into the linear."""
    model = models.full_car()
    p = {str(symbol): value for symbol, value in model.parameters.items()}
    car = Sketch(model)
    B = car.N.orientnew("B", "Body", (car.at("theta"), car.at("phi"), 0), "YXZ")
    B.set_ang_vel(car.N, car.rate("theta") * car.N.y + car.rate("phi") * B.x)
    center = car.O.locatenew("C", car.at("z") * car.N.z)
    center.set_vel(car.N, car.rate("z") * car.N.z)
    car.body(center, B, p["m"], (p["Ix"], p["Iy"], p["Iz"]))
    car.loads.append((center, -p["m"] * p["g"] * car.N.z))
    whole = p["a"] + p["b"]
    for k, (x, side, end) in enumerate(
        [("a", 1, "f"), ("a", -1, "f"), ("b", 1, "r"), ("b", -1, "r")], start=1
    ):
        along, across = p[x] if x == "a" else -p[x], side * p["w"] / 2
        weight = p["m"] * p["g"] * p["b" if x == "a" else "a"] / (2 * whole)
        corner = center.locatenew(f"P{k}", along * B.x + across * B.y)
        corner.v2pt_theory(center, car.N, B)
        height, sinking = car.at(f"z{k}"), car.rate(f"z{k}")
        wheel = car.O.locatenew(f"W{k}", along * car.N.x + across * car.N.y + (height - p["h"]) * car.N.z)
        wheel.set_vel(car.N, sinking * car.N.z)
        car.bodies.append(mechanics.Particle(f"wheel{k}", wheel, p["mu"]))
        strut = corner.pos_from(wheel)
        length = sympy.sqrt(strut.dot(strut))
        lengthening = strut.dot(corner.vel(car.N) - wheel.vel(car.N)) / length
        stretch = length - p["h"] - weight / p[f"k{end}"]
        push = -(p[f"k{end}"] * stretch + p[f"c{end}"] * lengthening) * strut / length
        tyre = weight + p["mu"] * p["g"] - p["kt"] * height
        car.loads += [(corner, push), (wheel, -push + (tyre - p["mu"] * p["g"]) * car.N.z)]
    q, u = [0.04, 0.15, -0.2, 0.01, -0.02, 0.03, 0.01], [0.3, -0.5, 0.7, 0.2, -0.4, 0.1, 0.6]
    assert_allclose(accelerations(model, q, u), car.accelerations(q, u), rtol=1e-9)


def test_snakeboard() -> None:
    """While it turns, with torques on the rotor and on the axles."""
    model = models.snakeboard()
    p = {str(symbol): value for symbol, value in model.parameters.items()}
    Mr, Ms = 0.03, -0.004
    board = Sketch(model)
    N, (x, y, theta, psi, phi), (dx, dy, dtheta, dpsi, dphi) = board.N, board.q, board.u

    def turned(parent: Any, name: str, angle: Any, rate: Any) -> Any:
        frame = parent.orientnew(name, "Axis", [angle, parent.z])
        frame.set_ang_vel(parent, rate * parent.z)
        return frame

    A = turned(N, "A", theta, dtheta)
    rotor, front, rear = turned(A, "R", psi, dpsi), turned(A, "F", phi, dphi), turned(A, "H", -phi, -dphi)
    center = board.O.locatenew("C", x * N.x + y * N.y)
    center.set_vel(N, dx * N.x + dy * N.y)
    board.body(center, A, p["m"], (0, 0, p["J"]))
    board.body(center, rotor, 0, (0, 0, p["Jr"]))
    slips = []
    for axle, side in ((front, 1), (rear, -1)):
        pin = center.locatenew(f"P{side}", side * p["l"] * A.x)
        pin.v2pt_theory(center, N, A)
        board.body(pin, axle, 0, (0, 0, p["Jw"]))
        board.loads.append((axle, side * Ms * N.z))
        slips.append(pin.vel(N).dot(axle.y))
    board.loads += [(rotor, Mr * N.z), (A, -Mr * N.z)]
    q, others = [0.3, -0.2, 0.7, 0.4, 0.5], [0.5, 2.0, 0.8]
    given = dict(zip([*board.q, *board.u[2:]], [*q, *others], strict=True))
    ahead = sympy.solve([slip.subs(given) for slip in slips], board.u[:2])
    u = [float(ahead[dx]), float(ahead[dy]), *others]
    model.inputs.update({model["Mr"]: Mr, model["Ms"]: Ms})
    assert_allclose(accelerations(model, q, u), board.accelerations(q, u, tuple(slips)), rtol=1e-9)
