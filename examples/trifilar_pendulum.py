"""The trifilar pendulum in natural coordinates: 21 equations, generated code, and ten seconds of motion.

A plate, the equilateral triangle ABC of side l, hangs by three threads of length h from A0, B0, C0. The derivation
follows the worksheet "Trifilar Pendulum in Natural Coordinates" (R. Lot, 2004) command by command, for two models:

* as in the worksheet: the plate's centre of mass is a point of ground, so the plate has translational energy only;
* with the plate in its own frame TN, so that its moments of inertia count. This model is simulated and generated as
  code.

Run it with `make demo` or `python examples/trifilar_pendulum.py`. It writes into the folder out/.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table
from scipy.linalg import null_space

import symbody as sb
from symbody import (
    Body,
    Equations,
    Expr,
    Frame,
    Motion,
    Point,
    System,
    Vector,
    dot,
    ground,
    origin,
    project,
    sqrt,
)
from symbody.view import Plate

Array: TypeAlias = NDArray[np.float64]

# --- the pendulum, in the names of the worksheet ---------------------------------------------------------------------

l, h, m, g = sb.symbols("l h m g")
J = Jxx, Jyy, Jzz, Jyz, Jxz, Jxy = sb.symbols("Jxx Jyy Jzz Jyz Jxz Jxy")
omega, zeta = sb.symbols("omega zeta")
q = xA, yA, zA, xB, yB, zB, xC, yC, zC, wx, wy, wz = sb.functions_of_time(
    "xA yA zA xB yB zB xC yC zC wx wy wz"
)
gravity = Vector(ground, 0, 0, -g)


def plate_frame() -> Frame:
    """Return the frame TN of the plate; its axes u and v follow from the coordinates of B and C."""
    ux, vx, uy, vy, uz, vz = unknowns = sb.symbols("ux vx uy vy uz vz")
    TN = Frame([[ux, vx, wx, xA], [uy, vy, wy, yA], [uz, vz, wz, zA], [0, 0, 0, 1]])
    _, B, C = plate_vertices(TN)
    BB, CC = B - Point(ground, xB, yB, zB), C - Point(ground, xC, yC, zC)
    solution = sb.solve([*project(BB, ground).components, *project(CC, ground).components], unknowns)
    return TN.subs(solution).named("TN")


def plate_vertices(TN: Frame) -> tuple[Point, Point, Point]:
    return origin(TN), Point(TN, l * sqrt(3) / 2, -l / 2, 0), Point(TN, l * sqrt(3) / 2, +l / 2, 0)


def ground_vertices(side: int) -> tuple[Point, Point, Point]:
    """Return A0, B0, C0. The worksheet has side = +1, opposite to the plate; with -1 they are above A, B, C."""
    x, y = l * sqrt(3) / 2, side * l / 2
    return Point(ground, 0, 0, h), Point(ground, x, y, h), Point(ground, x, -y, h)


def constraints(TN: Frame, side: int) -> list[Expr]:
    """Return six constraints of an orthonormal frame and three of the threads."""
    rotation = [row[:3] for row in TN.matrix.tolist()[:3]]
    u, v, w = (Vector(ground, *column) for column in zip(*rotation, strict=True))
    rigid = [dot(u, v), dot(u, w), dot(v, w), dot(w, w) - 1, dot(v, v) - 1, dot(u, u) - 1]
    threads = [P - P0 for P, P0 in zip(plate_vertices(TN), ground_vertices(side), strict=True)]
    return rigid + [dot(thread, thread) - h**2 for thread in threads]


def worksheet_system() -> System:
    G = Point(ground, (xA + xB + xC) / 3, (yA + yB + yC) / 3, (zA + zB + zC) / 3)
    return suspended(Body(G, m, *J, name="plate"), constraints(plate_frame(), +1))


def physical_system() -> System:
    TN = plate_frame()
    G = Point(TN, l / sqrt(3), 0, 0)
    return suspended(Body(G, m, *J, name="plate"), constraints(TN, -1))


def suspended(plate: Body, conditions: Sequence[Expr]) -> System:
    return System([plate], coordinates=q, constraints=conditions, gravity=gravity, name="Trifilar pendulum")


@dataclass(frozen=True)
class Model:
    """The pendulum's 21 equations: twelve Lagrange equations and nine constraints in Baumgarte's form."""

    title: str
    motion: Equations
    stabilized: tuple[Expr, ...]
    seconds: float

    @property
    def equations(self) -> tuple[Expr, ...]:
        return (*self.motion.residuals, *self.stabilized)


def derive(title: str, describe: Callable[[], System]) -> Model:
    start = perf_counter()
    motion = sb.lagrange_equations(describe())
    stabilized = motion.baumgarte(omega, zeta)
    return Model(title, motion, stabilized, perf_counter() - start)


def as_in_the_worksheet(motion: Equations) -> list[Expr]:
    """Return Lagrange's equations of T + sum(lambda phi) by hand, minus the generalised forces of the weight."""
    (plate,) = motion.system.bodies
    reactions = (k * phi for k, phi in zip(motion.multipliers, motion.constraints, strict=True))
    L = sb.kinetic_energy(plate) + sum(reactions)
    weight = sb.Force(ground, 0, 0, -m * g, at=plate.center_of_mass, on=plate)
    return [sb.lagrange(L, q_i) - Q for q_i, Q in zip(q, sb.generalized_force(weight, q), strict=True)]


# --- numbers ---------------------------------------------------------------------------------------------------------

side_length, mass = 0.6, 3.0  # of a thin uniform plate
PARAMETERS: dict[Expr, float] = {
    l: side_length, h: 1.0, m: mass, g: 9.81,
    Jxx: mass * side_length**2 / 24, Jyy: mass * side_length**2 / 24, Jzz: mass * side_length**2 / 12,
    Jyz: 0.0, Jxz: 0.0, Jxy: 0.0,
}  # fmt: skip
DURATION = 10.0
FOLDER = Path("out")


def hanging(side: int) -> Array:
    """Return q at rest: each vertex below its anchor, and the normal of a right-handed frame."""
    x, y = PARAMETERS[l] * np.sqrt(3) / 2, side * PARAMETERS[l] / 2
    return np.array([0, 0, 0, x, y, 0, x, -y, 0, 0, 0, -side])


def thrown(
    angle: float = 0.9, push: float = 0.15, velocity: Sequence[float] = (0, 0.5, 0)
) -> dict[Expr, float]:
    """Return a guess of the initial state: the plate turned about the vertical, displaced, and moving sideways.

    It violates the constraints, as the threads would be too long. `simulate` moves it to the nearest consistent state.
    """
    vertices = hanging(-1)[:9].reshape(3, 3)
    centre, (c, s) = vertices.mean(axis=0), (np.cos(angle), np.sin(angle))
    turned = (vertices - centre) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + centre + [push, 0, 0]
    speeds = sb.time_derivatives(q)
    values = [*turned.ravel(), 0, 0, 1, *np.tile(velocity, 3), 0, 0, 0]
    return dict(zip((*q, *speeds), map(float, values), strict=True))


def inertia_of_free_motion(motion: Equations, place: Array) -> Array:
    """Return the mass matrix of the three motions that the constraints allow."""
    f = sb.lambdify([list(PARAMETERS), motion.coordinates], [motion.constraint_jacobian, motion.mass_matrix])
    phi_q, M = f(list(PARAMETERS.values()), place)
    N = null_space(phi_q)
    return np.asarray(N.T @ M @ N)


@dataclass(frozen=True)
class Outputs:
    """The quantities of interest, as expressions."""

    displacement: tuple[Expr, ...]
    """Displacement of the centre of mass from its position at rest, along x, y and z, in m."""
    angle: Expr
    """Rotation of the plate about the vertical, in degrees."""
    tension: tuple[Expr, ...]
    """Tensions of the threads of A, B and C, in N: phi_q lambda = 2 lambda (P - P0), with |P - P0| = h."""
    energies: dict[str, Expr]


def outputs(motion: Equations) -> Outputs:
    (plate,) = motion.system.bodies
    rest = Point(ground, l / sqrt(3), 0, 0)
    T, V = sb.kinetic_energy(plate), sb.gravitational_energy(plate, gravity)
    return Outputs(
        displacement=project(plate.center_of_mass - rest, ground).components,
        angle=180 / sb.pi * sb.atan2(yB + yC - 2 * yA, xB + xC - 2 * xA),
        tension=tuple(-2 * h * multiplier for multiplier in motion.multipliers[6:]),
        energies={"kinetic energy": T, "potential energy": V, "total energy": T + V},
    )


def swing(motion: Equations, guess: dict[Expr, float], duration: float = DURATION) -> Motion:
    return sb.simulate(motion, PARAMETERS, t=(0, duration), guess=guess, rtol=1e-12, atol=1e-13)


# --- pictures --------------------------------------------------------------------------------------------------------


def draw(motion: Motion, shown: Outputs) -> None:
    """Write a plot of the motion over time, and an animation for a browser."""
    panels = (
        {f"displacement ${x}_G$": u for x, u in zip("xyz", shown.displacement, strict=True)},
        {"rotation": shown.angle},
        {f"tension ${P}_0{P}$": F for P, F in zip("ABC", shown.tension, strict=True)},
        shown.energies,
    )
    units = {shown.angle: "deg"} | dict.fromkeys(shown.displacement, "m")
    units |= dict.fromkeys(shown.tension, "N") | dict.fromkeys(shown.energies.values(), "J")
    motion.plot(*panels, units=units, path=FOLDER / "trifilar_motion.png")
    (plate,) = motion.system.bodies
    A, B, C = [(-l / sqrt(3), 0), (l / sqrt(12), -l / 2), (l / sqrt(12), l / 2)]
    vertices = [Point(plate.frame, x, y, 0) for x, y in (A, B, C)]
    motion.animate(
        FOLDER / "trifilar_motion.html",
        shapes={plate: Plate((A, B, C), l / 40)},
        traces=vertices,
        reactions=True,  # of the threads
    )


# --- equations as files ----------------------------------------------------------------------------------------------


def equations_text(models: Sequence[Model]) -> str:
    lines = ["Trifilar pendulum in natural coordinates. All 21 expressions are zero; a prime is d/dt."]
    names = [*map(str, q), *(f"constraint {k}" for k in range(1, 10))]
    for model in models:
        lines += ["", "", model.title, "=" * len(model.title)]
        for k, (name, zero) in enumerate(zip(names, model.equations, strict=True), start=1):
            lines += ["", f"{k}, {name}", sb.describe(zero)]
    return "\n".join(lines) + "\n"


def equations_latex(models: Sequence[Model]) -> str:
    lines = [r"\documentclass{article}", r"\usepackage{amsmath}"]
    lines += [r"\usepackage[paperwidth=70cm,paperheight=40cm,margin=2cm]{geometry}", r"\allowdisplaybreaks"]
    lines += [r"\begin{document}", r"\title{Trifilar pendulum in natural coordinates}\date{}\maketitle"]
    for model in models:
        definitions, zeros = sb.listing(model.equations, "latex")
        rows = [f"{name} &= {value}" for name, value in definitions] + [f"0 &= {zero}" for zero in zeros]
        lines += [rf"\section*{{{model.title}}}", r"\begin{align*}", " \\\\\n".join(rows), r"\end{align*}"]
    return "\n".join([*lines, r"\end{document}"]) + "\n"


# --- the story -------------------------------------------------------------------------------------------------------


@contextmanager
def step(console: Console, title: str) -> Iterator[None]:
    start = perf_counter()
    yield
    console.print(f"[dim]{milliseconds(perf_counter() - start):>9}[/]  {title}")


def milliseconds(seconds: float) -> str:
    return f"{1000 * seconds:.1f} ms" if seconds < 1 else f"{seconds:.2f} s"


def size_table(models: Sequence[Model], free_inertia: Sequence[Array]) -> Table:
    table = Table(title="The system", title_justify="left")
    table.add_column()
    for model in models:
        table.add_column(model.title, justify="right")

    def row(name: str, entries: Sequence[object]) -> None:
        table.add_row(name, *map(str, entries))

    row("coordinates q", [len(model.motion.coordinates) for model in models])
    row("constraints, multipliers", [len(model.motion.constraints) for model in models])
    row("equations", [len(model.equations) for model in models])
    row("derived in", [milliseconds(model.seconds) for model in models])
    table.add_section()
    row("operations: 12 of Lagrange", [sb.cost(model.motion.residuals).total for model in models])
    row("  9 in Baumgarte's form", [sb.cost(model.stabilized).total for model in models])
    costs = [sb.cost(model.equations) for model in models]
    row("  all 21 together", [cost.total for cost in costs])
    for kind in ("additions", "multiplications", "divisions"):
        row(f"    {kind}", [getattr(cost, kind) for cost in costs])
    table.add_section()
    row("free motions at rest", [len(inertia) for inertia in free_inertia])
    row("  with inertia", [np.linalg.matrix_rank(inertia, tol=1e-9) for inertia in free_inertia])
    return table


def result_table(motion: Motion, shown: Outputs, seconds: float) -> Table:
    table = Table(title=f"The motion of {DURATION:g} s", title_justify="left", show_header=False)
    angle, tension = motion[shown.angle], motion.evaluate(shown.tension)
    for name, value in (
        ("compiled and simulated in", milliseconds(seconds)),
        ("steps, evaluations", f"{motion.statistics.steps}, {motion.statistics.evaluations}"),
        ("largest drift of the energy, relative", f"{motion.energy_drift:.1e}"),
        ("largest drift of the constraints", f"{motion.constraint_drift:.1e}"),
        ("rotation about the vertical", f"{angle.min():.1f} to {angle.max():.1f} deg"),
        ("tension of the threads", f"{tension.min():.2f} to {tension.max():.2f} N"),
    ):
        table.add_row(name, value)
    return table


NOTE = """\
The worksheet puts the plate's centre of mass in a frame parallel to ground. Its energy is \
translational only: at rest, rotation about the vertical has no inertia, and the equations do not determine its \
acceleration. The simulated model therefore has the plate in its own frame.
The worksheet's B0 and C0 have y coordinates opposite to those of the plate's B and C, so the normal of a plate at \
rest points down (or the plate is mirrored). In the simulated model they are above B and C, and the normal points up.
"""


def main() -> None:
    console = Console(highlight=False)
    console.rule("Trifilar pendulum in natural coordinates")
    worksheet = derive("as in the worksheet", worksheet_system)
    physical = derive("plate in its own frame", physical_system)
    with step(console, "the worksheet's commands give the same twelve equations"):
        assert as_in_the_worksheet(worksheet.motion) == list(worksheet.motion.residuals)
    show_equations(console, worksheet.motion)
    inertia = [
        inertia_of_free_motion(worksheet.motion, hanging(+1)),
        inertia_of_free_motion(physical.motion, hanging(-1)),
    ]
    console.print(size_table([worksheet, physical], inertia))
    console.print(NOTE)
    write_equations(console, [worksheet, physical])
    for target in ("fortran", "matlab"):
        with step(console, f"code written to {FOLDER / target}/, with a program that checks it"):
            sb.generate(physical.motion, target=target, path=FOLDER / target)
    simulate(console, physical.motion)


def show_equations(console: Console, motion: Equations) -> None:
    """Print one equation of each kind."""
    zeros = dict(zip(map(str, q), motion.residuals, strict=True))
    rows = {f"Lagrange, {name}": zeros[name] for name in ("xA", "zA", "wx")}
    rows |= {"thread A0A": motion.constraints[6], "frame, w w = 1": motion.constraints[3]}
    console.print("\nFive of the worksheet's 21 equations (a prime is d/dt); the files contain all of them:")
    for name, zero in rows.items():
        console.print(f"  {name}:", style="bold")
        console.print(f"    0 = {zero}", markup=False, soft_wrap=True)
    console.print()


def write_equations(console: Console, models: Sequence[Model]) -> None:
    for name, text in (("txt", equations_text), ("tex", equations_latex)):
        path = FOLDER / f"trifilar_equations.{name}"
        path.parent.mkdir(parents=True, exist_ok=True)
        with step(console, f"equations written to {path}"):
            path.write_text(text(models), encoding="utf-8")


def simulate(console: Console, equations: Equations) -> None:
    shown = outputs(equations)
    start = perf_counter()
    motion = swing(equations, thrown())
    console.print(result_table(motion, shown, perf_counter() - start))
    with step(console, f"report written to {FOLDER}/trifilar_report.html"):
        sb.report(equations, FOLDER / "trifilar_report.html", motion=motion)
    with step(console, f"plot and animation written to {FOLDER}/trifilar_motion.png and .html"):
        draw(motion, shown)


if __name__ == "__main__":
    main()
