"""The contenders: each returns the derivatives of the state at the end, 4 x 6, for tolerances of 1e-8 and 1e-10."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from symbody import newton_euler, simulate
from symbody.models import n_pendulum

Array = NDArray[np.float64]
Solve = Callable[[], Array]

RTOL, ATOL, DURATION = 1e-8, 1e-10, 10.0
START = (1.2, -0.5, 0.3, 0.0)
MODEL = n_pendulum(2)
EQUATIONS = newton_euler(MODEL.system)
NAMES = ("m1", "m2", "l1", "l2", "g")
BY = [*(MODEL[name] for name in NAMES), EQUATIONS.coordinates[0]]
VALUES = {**MODEL.parameters, MODEL["m2"]: 0.7, MODEL["l2"]: 0.8}
INITIAL = dict(zip((*EQUATIONS.coordinates, *EQUATIONS.speeds), START, strict=True))
NUMBERS = np.array([*(VALUES[MODEL[name]] for name in NAMES), START[0]])


@dataclass(frozen=True)
class Contender:
    """A way to the sensitivities: a label, and a function that prepares it and returns the one that is timed."""

    label: str
    prepare: Callable[[], Solve]
    needs: str = ""

    @property
    def is_installed(self) -> bool:
        """Whether its package is there."""
        return not self.needs or find_spec(self.needs) is not None


def alone() -> Solve:
    """Return the motion alone, which has no derivatives."""

    def solve() -> Array:
        simulate(EQUATIONS, VALUES, INITIAL, (0, DURATION), rtol=RTOL, atol=ATOL)
        return np.empty((4, 0))

    return solve


def forward(rtol: float = RTOL, atol: float = ATOL) -> Solve:
    """Return `simulate(..., sensitivities=...)`."""

    def solve() -> Array:
        motion = simulate(
            EQUATIONS, VALUES, INITIAL, (0, DURATION), rtol=rtol, atol=atol, sensitivities=BY, progress=False
        )
        assert motion.slopes is not None
        return np.asarray(motion.slopes[-1])

    return solve


def differences() -> Solve:
    """Return central differences of twelve motions."""

    def end(p: Array) -> Array:
        parameters = {**VALUES, **{MODEL[name]: value for name, value in zip(NAMES, p[:-1], strict=True)}}
        initial = {**INITIAL, BY[-1]: p[-1]}
        motion = simulate(EQUATIONS, parameters, initial, (0, DURATION), rtol=RTOL, atol=ATOL)
        return np.asarray(motion.states[-1])

    return lambda: _central(end)


def _central(end: Callable[[Array], Array]) -> Array:
    columns = []
    for k, value in enumerate(NUMBERS):
        step = np.zeros(len(NUMBERS))
        step[k] = 1e-4 * abs(value)
        columns.append((end(NUMBERS + step) - end(NUMBERS - step)) / (2 * step[k]))
    return np.array(columns).T


def _rates(library: Any, y: Any, p: Any) -> list[Any]:
    """Return the rates by hand, for libraries that differentiate them; absolute angles from the vertical."""
    m1, m2, l1, l2, g = (p[k] for k in range(5))
    a, b, u, v = (y[k] for k in range(4))
    sine, cosine = library.sin(a - b), library.cos(a - b)
    M11, M12, M22 = (m1 + m2) * l1**2, m2 * l1 * l2 * cosine, m2 * l2**2
    f1 = -m2 * l1 * l2 * sine * v**2 - (m1 + m2) * g * l1 * library.sin(a)
    f2 = m2 * l1 * l2 * sine * u**2 - m2 * g * l2 * library.sin(b)
    det = M11 * M22 - M12**2
    return [u, v, (M22 * f1 - M12 * f2) / det, (M11 * f2 - M12 * f1) / det]


def by_scipy() -> Solve:
    """Return central differences of twelve motions by SciPy's DOP853, with the rates in NumPy."""

    def end(p: Array) -> Array:
        start = [p[-1], *START[1:]]
        found = solve_ivp(
            lambda _t, y: _rates(np, y, p), (0, DURATION), start, "DOP853", rtol=RTOL, atol=ATOL
        )
        return np.asarray(found.y[:, -1])

    return lambda: _central(end)


def by_casadi() -> Solve:
    """Return the forward sensitivities of CVODES by CasADi, whose virtual machine evaluates the rates."""
    import casadi  # noqa: PLC0415 - only if it is installed

    p = casadi.MX.sym("p", 6)
    y0, q = casadi.SX.sym("y", 4), casadi.SX.sym("p", 6)
    problem = {"x": y0, "p": q, "ode": casadi.vertcat(*_rates(casadi, y0, q))}
    # Adams' methods with functional iteration take a third of the time of the default, for stiff equations.
    options = {
        "reltol": RTOL,
        "abstol": ATOL,
        "fsens_err_con": True,
        "max_num_steps": 100000,
        "linear_multistep_method": "adams",
        "nonlinear_solver_iteration": "functional",
    }
    motion = casadi.integrator("motion", "cvodes", problem, 0.0, DURATION, options)
    start = casadi.vertcat(p[5], *START[1:])
    ends = motion(x0=start, p=p)["xf"]
    seeds = casadi.MX.eye(6)
    slopes = casadi.jtimes(ends, p, seeds)
    function = casadi.Function("slopes", [p], [slopes])
    return lambda: np.array(function(NUMBERS))


@cache  # XLA compiles for seconds
def by_jax() -> Solve:
    """Return forward differentiation of a Dormand-Prince method of JAX's odeint, compiled by XLA."""
    import jax  # noqa: PLC0415 - only if it is installed
    import jax.numpy as jnp  # noqa: PLC0415
    from jax.experimental.ode import odeint  # noqa: PLC0415

    jax.config.update("jax_enable_x64", val=True)
    instants = jnp.asarray([0.0, DURATION])

    def augmented(p: Any) -> Any:
        def rates(x: Any, _t: Any) -> Any:
            y, S = x[:4], x[4:].reshape(4, 6)
            f = lambda y, p: jnp.stack(_rates(jnp, y, p))  # noqa: E731 - differentiated twice below
            return jnp.concatenate([f(y, p), (jax.jacfwd(f)(y, p) @ S + jax.jacfwd(f, 1)(y, p)).ravel()])

        start = jnp.concatenate([p[5:], jnp.asarray(START[1:]), jnp.zeros(24).at[5].set(1.0)])
        return odeint(rates, start, instants, rtol=RTOL, atol=ATOL)[-1, 4:].reshape(4, 6)

    compiled = jax.jit(augmented)
    given = jnp.asarray(NUMBERS)
    return lambda: np.asarray(compiled(given))


CONTENDERS = (
    Contender("symbody, the motion alone", alone),
    Contender("symbody, sensitivities", forward),
    Contender("symbody, central differences", differences),
    Contender("SciPy DOP853, central differences", by_scipy),
    Contender("CasADi, CVODES (Adams)", by_casadi, "casadi"),
    Contender("JAX, odeint of S' = f_x S + f_p", by_jax, "jax"),
)
