"""Canonical equations as text, as `Equations` whose speeds are momenta, and in other containers' company."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    CanonicalEquations,
    Constraint,
    Expr,
    Force,
    Matrix,
    System,
    Torque,
    Vector,
    consistent_state,
    cos,
    describe,
    equilibrium,
    floating_frame,
    forward_dynamics,
    functions_of_time,
    generate,
    ground,
    hamilton,
    latex,
    mechanical_energy,
    newton_euler,
    report,
    rotate,
    simulate,
    sin,
    subs,
    symbols,
    time_derivative,
    translate,
)
from tests.repeated import repeated

a, b, x, y, th, v, n, z = functions_of_time("a b x y th v n z")
m, l, g, J, c, T, H = symbols("m l g J c T H")
xp, yp, thp, ap, bp = map(time_derivative, (x, y, th, a, b))
WEIGHT = Vector(ground, 0, -g, 0)
NUMBERS = {m: 1.2, l: 0.7, g: 9.81, c: 0.3}
ALL = NUMBERS | {J: 0.1, T: 0.4}


def double_pendulum() -> System:
    upper = rotate("Z", a) * translate(0, -l, 0)
    bodies = [Body(upper, m), Body(upper * rotate("Z", b) * translate(0, -l, 0), m)]
    damper = Torque(ground, 0, 0, -c * ap, on=bodies[0])
    return System(bodies, [damper], [a, b], gravity=WEIGHT)


def rod() -> System:
    return System(
        [Body(translate(x, y, 0), m)], [], [x, y], [Constraint(x**2 + y**2 - l**2, name="rod")], WEIGHT
    )


BLADE = translate(x, y, 0) * rotate("Z", th)
SLEIGH = Body(BLADE * translate(l, 0, 0), m, Iz=J)
ALONG = {v: xp * cos(th) + yp * sin(th), n: yp * cos(th) - xp * sin(th)}


def sleigh() -> System:
    """Chaplygin's sleigh with the force across its blade as a multiplier."""
    return System([SLEIGH], [], [x, y, th], [Constraint(n, name="blade")], kinematics=ALONG)


def embedded_sleigh() -> System:
    return System([SLEIGH], [], [x, y, th], speeds=[v], kinematics={xp: v * cos(th), yp: v * sin(th)})


def motor() -> System:
    """A rotor whose torque follows its command by a lag of the first order."""
    rotor = Body(rotate("Z", th), m, Iz=J)
    drive = Torque(ground, 0, 0, z, on=rotor)
    return System([rotor], [drive], [th], states={z: (-c * thp - z) / T})


TEXTS = {
    double_pendulum: """CANONICAL EQUATIONS of a, b, p_a, p_b
    H = (p_b**2 + (p_a - (1 + cos(b))*p_b)**2/(1 + sin(b)**2))/(2*m*l**2) - g*l*m*(2*cos(a) + cos(a + b))
""",
    rod: """CANONICAL EQUATIONS of x, y, p_x, p_y
    H = (p_x**2 + p_y**2)/(2*m) + g*m*y
    x' = p_x/m
    y' = p_y/m
    p_x' = 2*x*lambda1
    p_y' = 2*y*lambda1 - g*m
    constraint rod: x**2 + y**2 - l**2 = 0""",
    embedded_sleigh: """CANONICAL EQUATIONS of x, y, th, p_v, p_th
    H = (p_v**2/m + p_th**2/(J + m*l**2))/2
    x' = cos(th)*p_v/m
    y' = sin(th)*p_v/m
    th' = p_th/(J + m*l**2)
    p_v' = l*m*p_th**2/(J + m*l**2)**2
    p_th' = -l*p_v*p_th/(J + m*l**2)""",
    motor: """CANONICAL EQUATIONS of th, p_th
    H = p_th**2/(2*J)
    th' = p_th/J
    p_th' = z
    z' = -c*p_th/(J*T) - z/T""",
}


@pytest.mark.parametrize("make", TEXTS, ids=lambda make: make.__name__)
def test_as_text(make) -> None:  # type: ignore[no-untyped-def]
    """The sleigh's equations are those of Neimark & Fufaev 1972, ch. 2, with p_v = m v and p_th = (J + m l^2) th'."""
    assert describe(hamilton(make())).startswith(TEXTS[make])


def test_in_notebooks_and_in_latex() -> None:
    found = hamilton(rod())
    assert found.latex().startswith(r"\begin{aligned} H &= \frac{p_{x}^{2} + p_{y}^{2}}{2 m} + g m y \\")
    assert found.latex() == latex(found)
    shown = found._repr_latex_()
    assert shown is not None
    assert found.latex() in shown
    assert found._repr_html_() is None


def test_the_letter_of_the_hamiltonian_may_be_taken() -> None:
    moved = System([Body(translate(x, 0, 0), H)], [], [x])
    assert describe(hamilton(moved)).splitlines()[1] == "    Hamiltonian = p_x**2/(2*H)"


def test_long_equations_are_shown_by_their_sizes() -> None:
    frame, bodies = ground, []
    angles = functions_of_time([f"q{k}" for k in range(6)])
    for k, q in enumerate(angles):
        frame *= rotate("XYZ"[k % 3], q) * translate(l, 0, g)
        bodies.append(Body(frame, m, J, 2 * J, 3 * J))
    found = hamilton(System(bodies, [], angles))
    text = describe(found)
    assert text.startswith("CANONICAL EQUATIONS of 6 momenta: ")
    assert "p_q5': " in text
    assert found._repr_latex_() is None
    table = found._repr_html_()
    assert table is not None
    assert "p_q5" in table
    assert r"\text{Canonical equations of 6 momenta" in found.latex()


def starts(system: System) -> dict[Expr, float]:
    if system.coordinates == (a, b):
        return {a: 0.5, ap: 1.0}
    if system.coordinates == (th,):
        return {th: 0.1, thp: 1.0, z: 0.2}
    return {x: 0.0, y: -0.7, xp: 1.0} if len(system.coordinates) == 2 else {xp: 1.0, thp: 2.0}


@pytest.mark.parametrize(
    ("make", "method"),
    [
        *((make, "dop853") for make in (double_pendulum, rod, sleigh, embedded_sleigh, motor)),
        (double_pendulum, "ida"),
        (motor, "ida"),
        *repeated((make, "ida") for make in (rod, sleigh, embedded_sleigh)),
    ],
)
def test_the_motion_is_that_of_newton_and_euler(make, method: str) -> None:  # type: ignore[no-untyped-def]
    system = make()
    found = hamilton(system)
    outputs = [*system.coordinates, *system.speeds, *system.states, *system.multipliers]
    ends = []
    for equations in (newton_euler(system), found.equations):
        names = {*equations.parameters} | {name for name in ALL if name in system.leaves}
        numbers = {name: value for name, value in ALL.items() if name in names}
        motion = simulate(
            equations, numbers, starts(system), [0, 0.4, 1], rtol=1e-10, atol=1e-10, method=method
        )
        ends.append([motion[name] for name in outputs])
    assert_allclose(ends[1], ends[0], rtol=0, atol=1e-8 if method == "dop853" else 1e-5)
    assert np.ptp(ends[0], axis=1).max() > 0.1


def test_energy_is_the_hamiltonian_and_loads_take_from_it() -> None:
    system = double_pendulum()
    found = hamilton(system)
    motion = simulate(found.equations, NUMBERS, starts(system), (0, 2), rtol=1e-11)
    energy = motion[mechanical_energy(system)]
    assert_allclose(motion[found.hamiltonian], energy, rtol=1e-9)
    assert energy[-1] < energy[0] - 0.1
    assert motion.energy_drift < 1e-9


def test_rates_that_are_not_given_are_zero_unless_a_momentum_is() -> None:
    """One rate alone starts the same motion in all equations; one momentum leaves the others zero."""
    system = double_pendulum()
    found, speeds = hamilton(system), newton_euler(system)
    p_a, p_b = found.momenta
    start = {a: 0.5, b: 0.3, ap: 1.0}
    one, two = (consistent_state(equations, NUMBERS, start) for equations in (speeds, found.equations))
    assert one[bp] == 0
    for p in found.momenta:
        expected = found.momenta_by_speeds[p].evaluate({**NUMBERS, **one})
        assert two[p] == pytest.approx(expected, rel=1e-12)
    assert two[p_b] != 0
    given = consistent_state(found.equations, NUMBERS, {a: 0.5, p_a: 2.0})
    assert (given[p_a], given[p_b]) == (2.0, 0.0)
    both = consistent_state(found.equations, NUMBERS, {a: 0.5, b: 0.3, p_a: 2.0, ap: 1.0})
    (rate,) = (found.rates[ap].evaluate({**NUMBERS, **both}),)
    assert (both[p_a], rate) == (2.0, pytest.approx(1.0))


def test_starts_by_speeds_of_choice() -> None:
    found = hamilton(sleigh())
    numbers = {m: 2.0, J: 0.3, l: 0.2}
    state = consistent_state(found.equations, numbers, {th: 0.3, v: 1.5, thp: 1.0})
    assert [state[p] for p in found.momenta] == pytest.approx([3.0, 0.4, 0.3 + 2 * 0.04])
    rates = consistent_state(
        found.equations, numbers, {th: 0.3, xp: 1.5 * np.cos(0.3), yp: 1.5 * np.sin(0.3), thp: 1.0}
    )
    assert [rates[p] for p in found.momenta] == pytest.approx([state[p] for p in found.momenta])
    p_v, _, p_th = found.momenta
    both = consistent_state(found.equations, numbers, {th: 0.3, p_v: 3.0, thp: 1.0})
    assert [both[p] for p in found.momenta] == pytest.approx([state[p] for p in found.momenta])
    mixed = consistent_state(found.equations, numbers, {th: 0.3, v: 1.5, p_th: state[p_th]})
    assert [mixed[p] for p in found.momenta] == pytest.approx([state[p] for p in found.momenta])


def test_rest_and_small_motions() -> None:
    """The eigenvalues of a double pendulum of equal links and masses: w^2 = (2 +- sqrt(2)) g/l [Goldstein, ch. 6]."""
    rest = equilibrium(hamilton(double_pendulum()).equations, NUMBERS | {c: 0}, guess={a: 0.1, b: -0.1})
    assert_allclose([rest.coordinates[q] for q in (a, b)], 0, atol=1e-9)
    expected = np.sqrt((2 + np.sqrt(2) * np.array([-1, 1])) * 9.81 / 0.7)
    assert_allclose(np.sort(rest.eigenvalues.imag)[2:], expected, rtol=1e-9)


def test_accelerations_need_no_solution_without_constraints() -> None:
    found = hamilton(double_pendulum())
    solved = forward_dynamics(found.equations)
    assert solved.accelerations == tuple(found.rates[time_derivative(p)] for p in found.momenta)
    assert found.equations.mass_matrix == Matrix([[1, 0], [0, 1]])


@pytest.mark.parametrize("make", [double_pendulum, rod, sleigh, motor])
def test_substitution_and_pickles(make) -> None:  # type: ignore[no-untyped-def]
    found = hamilton(make())
    copied = pickle.loads(pickle.dumps(found))
    assert isinstance(copied, CanonicalEquations)
    assert copied.equations.residuals == found.equations.residuals
    numeric, other = subs(found, {J: 2, m: 3}), hamilton(subs(make(), {J: 2, m: 3}))
    assert numeric.hamiltonian == other.hamiltonian
    assert numeric.rates == other.rates
    assert numeric.equations.residuals == subs(found.equations, {J: 2, m: 3}).residuals
    assert subs(found.equations, {J: 2, m: 3}).kinematics == other.equations.kinematics
    assert m not in subs(found.equations, {J: 2, m: 3}).parameters


def test_a_free_body_turns_as_euler_has_it() -> None:
    """p' = p x w for the angular momentum in the axes of the body [Goldstein, Poole & Safko 2002, sec. 5.5]."""
    I = symbols("I_x I_y I_z")
    found = hamilton(System([Body(floating_frame("hull"), m, *I)]))
    P = found.momenta[3:]
    w = [p / i for p, i in zip(P, I, strict=True)]
    expected = [P[1] * w[2] - P[2] * w[1], P[2] * w[0] - P[0] * w[2], P[0] * w[1] - P[1] * w[0]]
    assert [found.rates[time_derivative(p)] for p in P] == expected


def test_a_bead_on_a_turning_wire() -> None:
    """Goldstein, Poole & Safko 2002, sec. 8.2: H = p^2/(2 m) - m w^2 r^2/2 is not the energy."""
    w = symbols("w")
    from symbody import t  # noqa: PLC0415 - a letter that other tests use

    wire = rotate("Z", w * t)
    bead = Body(wire * translate(x, 0, 0), m)
    pull = Force(wire, -c * x, 0, 0, at=bead.center_of_mass, on=bead)
    found = hamilton(System([bead], [pull], [x]))
    (p,) = found.momenta
    assert found.hamiltonian == p**2 / (2 * m) - m * w**2 * x**2 / 2
    assert list(found.rates.values()) == [p / m, m * w**2 * x - c * x]


@pytest.mark.parametrize("make", [double_pendulum, rod, sleigh, embedded_sleigh, motor])
def test_reports_prove_their_laws(make, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    """The formalisms are compared in the speeds that momenta replaced; the power is along these speeds."""
    text = Path(report(hamilton(make()).equations, tmp_path / "report.md")).read_text(encoding="utf-8")
    assert text.count("| proved |") == 3
    assert "The momenta are $p_{" in text
    assert "quasi-velocit" not in text


@pytest.mark.parametrize("make", [double_pendulum, rod, sleigh, motor])
def test_python_code_computes_the_rates(make, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    """The generated module agrees with the numbers of its check, which the expressions gave."""
    generate(hamilton(make()).equations, "python", tmp_path)
    (check,) = tmp_path.glob("*_check.py")
    done = subprocess.run(
        [sys.executable, check.name], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_systems_in_momenta_say_so() -> None:
    equations = hamilton(sleigh()).equations
    assert repr(equations) == "Equations(3 equations of motion, 1 constraint, momenta p_v, p_n, p_th)"
    assert repr(equations.system) == "System(1 body, 0 loads, 3 coordinates, 3 momenta, 1 constraint)"
    assert "    momenta: p_v, p_n, p_th\n" in describe(equations.system)
    assert "momenta" in equations.system._repr_html_()  # type: ignore[attr-defined]
    assert repr(hamilton(sleigh())) == "CanonicalEquations(x, y, th, p_v, p_n, p_th)"
    assert describe(equations.system).endswith("(l**2/J + 1/m)*p_n - l*p_th/J = 0, multiplier lambda1")
