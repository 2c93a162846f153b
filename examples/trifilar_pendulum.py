"""The trifilar pendulum in natural coordinates: from its description to 21 equations and ten seconds of motion.

A plate, the equilateral triangle ABC of side l, hangs by three threads of length h from A0, B0, C0. The derivation
follows the worksheet "Trifilar Pendulum in Natural Coordinates" (R. Lot, 2004) command by command, twice:

* as the worksheet has it: the plate's centre of mass is a point of ground, so its energy is translational only;
* with the plate's own frame TN, so that its inertia counts: this is the model that is simulated.

Run it with `make demo`, or `python examples/trifilar_pendulum.py`; it writes into the folder out/.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn
from rich.table import Table
from scipy.integrate import solve_ivp
from scipy.linalg import null_space

import symbody as sb
from symbody import Body, Equations, Expr, Frame, Point, System, Vector, dot, ground, origin, project, sqrt

Array: TypeAlias = NDArray[np.float64]
PROGRESS = (
    TextColumn("{task.description}"),
    BarColumn(),
    TextColumn("{task.completed:.1f} of {task.total:g} s"),
)

# --- the pendulum, in the names of the worksheet ---------------------------------------------------------------------

l, h, m, g = sb.symbols("l h m g")
J = Jxx, Jyy, Jzz, Jyz, Jxz, Jxy = sb.symbols("Jxx Jyy Jzz Jyz Jxz Jxy")
omega, zeta = sb.symbols("omega zeta")
q = xA, yA, zA, xB, yB, zB, xC, yC, zC, wx, wy, wz = sb.functions_of_time(
    "xA yA zA xB yB zB xC yC zC wx wy wz"
)
gravity = Vector(ground, 0, 0, -g)


def plate_frame() -> Frame:
    """Return TN, fixed to the plate; its axes u and v are solved for, so that B and C are where q says."""
    ux, vx, uy, vy, uz, vz = unknowns = sb.symbols("ux vx uy vy uz vz")
    TN = Frame([[ux, vx, wx, xA], [uy, vy, wy, yA], [uz, vz, wz, zA], [0, 0, 0, 1]])
    _, B, C = plate_vertices(TN)
    BB, CC = B - Point(ground, xB, yB, zB), C - Point(ground, xC, yC, zC)
    solution = sb.solve([*project(BB, ground).components, *project(CC, ground).components], unknowns)
    return TN.subs(solution).named("TN")


def plate_vertices(TN: Frame) -> tuple[Point, Point, Point]:
    return origin(TN), Point(TN, l * sqrt(3) / 2, -l / 2, 0), Point(TN, l * sqrt(3) / 2, +l / 2, 0)


def ground_vertices(side: int) -> tuple[Point, Point, Point]:
    """Return A0, B0, C0. The worksheet has side = +1, the opposite of the plate's; -1 is straight above the plate."""
    x, y = l * sqrt(3) / 2, side * l / 2
    return Point(ground, 0, 0, h), Point(ground, x, y, h), Point(ground, x, -y, h)


def constraints(TN: Frame, side: int) -> list[Expr]:
    """Return the six of an orthonormal frame and the three of the threads."""
    rotation = [row[:3] for row in TN.matrix.tolist()[:3]]
    u, v, w = (Vector(ground, *column) for column in zip(*rotation, strict=True))
    rigid = [dot(u, v), dot(u, w), dot(v, w), dot(w, w) - 1, dot(v, v) - 1, dot(u, u) - 1]
    threads = [P - P0 for P, P0 in zip(plate_vertices(TN), ground_vertices(side), strict=True)]
    return rigid + [dot(thread, thread) - h**2 for thread in threads]


def worksheet_system() -> System:
    G = Point(ground, (xA + xB + xC) / 3, (yA + yB + yC) / 3, (zA + zB + zC) / 3)
    return suspended(Body(G, m, *J), constraints(plate_frame(), +1))


def physical_system() -> System:
    TN = plate_frame()
    G = Point(TN, l / sqrt(3), 0, 0)
    return suspended(Body(G, m, *J), constraints(TN, -1))


def suspended(plate: Body, conditions: Sequence[Expr]) -> System:
    return System([plate], coordinates=q, constraints=conditions, gravity=gravity)


@dataclass(frozen=True)
class Model:
    """The pendulum's 21 equations: twelve of Lagrange, nine constraints in Baumgarte's form."""

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
    """Return the twelve equations made by hand: of T + sum(lambda phi), less the generalised forces of the weight."""
    (plate,) = motion.system.bodies
    reactions = (k * phi for k, phi in zip(motion.multipliers, motion.constraints, strict=True))
    L = sb.kinetic_energy(plate) + sum(reactions)
    weight = sb.Force(ground, 0, 0, -m * g, at=plate.center_of_mass, on=plate)
    return [sb.lagrange(L, q_i) - Q for q_i, Q in zip(q, sb.generalized_force(weight, q), strict=True)]


# --- numbers ---------------------------------------------------------------------------------------------------------

side_length, mass = 0.6, 3.0  # of a thin uniform plate
VALUES: dict[Expr, float] = {
    l: side_length, h: 1.0, m: mass, g: 9.81,
    Jxx: mass * side_length**2 / 24, Jyy: mass * side_length**2 / 24, Jzz: mass * side_length**2 / 12,
    Jyz: 0.0, Jxz: 0.0, Jxy: 0.0,
    omega: 20.0, zeta: 1.0,
}  # fmt: skip
DURATION = 10.0
FOLDER = Path("out")


class Numbers:
    """What the simulation evaluates, as functions of the numbers q and q'."""

    def __init__(self, model: Model, values: Mapping[Expr, float]) -> None:
        motion = model.motion
        unknowns = [*motion.accelerations, *motion.multipliers]
        at_zero = sb.substitute(model.equations, dict.fromkeys(unknowns, 0))

        def compiled(outputs: Any) -> Callable[[Array, Array], Any]:
            f = sb.lambdify([list(values), motion.coordinates, motion.speeds], outputs)
            return partial(f, list(values.values()))

        self.linear_system = compiled([sb.jacobian(model.equations, unknowns), at_zero])
        self.phi = compiled(motion.constraints)
        self.phi_rate = compiled(sb.time_derivatives(motion.constraints))
        self.phi_q = compiled(motion.constraint_jacobian)
        self.mass_matrix = compiled(motion.mass_matrix)
        self.energy = compiled(sb.mechanical_energy(motion.system))

    def unknowns(self, q: Array, u: Array) -> Array:
        """Return the accelerations and multipliers that solve the 21 equations, for one state or many (columns)."""
        A, b = (np.moveaxis(part, -1, 0) if q.ndim == 2 else part for part in self.linear_system(q, u))
        return np.linalg.solve(A, -b[..., np.newaxis])[..., 0].T

    def inertia_of_free_motion(self, q: Array) -> Array:
        """Return the mass matrix of the three motions that the constraints leave."""
        at_rest = np.zeros_like(q)
        N = null_space(self.phi_q(q, at_rest))
        return np.asarray(N.T @ self.mass_matrix(q, at_rest) @ N)


def placed(vertices: Array, normal: Sequence[float]) -> Array:
    """Return the coordinates q of a plate, given A, B, C as rows."""
    return np.array([*vertices.ravel(), *normal])


def hanging(side: int) -> Array:
    """Return q at rest: each vertex straight below its anchor, and the normal that makes the frame right-handed."""
    x, y = VALUES[l] * np.sqrt(3) / 2, side * VALUES[l] / 2
    return placed(np.array([[0, 0, 0], [x, y, 0], [x, -y, 0]]), [0, 0, -side])


def displaced_state(
    numbers: Numbers, angle: float = 0.9, push: float = 0.15, velocity: Sequence[float] = (0, 0.5, 0)
) -> Array:
    """Return a state on the constraints: the plate turned about the vertical, pushed aside and let go with a swing.

    What is asked for is moved onto the constraints by the shortest way: Newton's steps of least norm.
    """
    vertices = hanging(-1)[:9].reshape(3, 3)
    centre, (c, s) = vertices.mean(axis=0), (np.cos(angle), np.sin(angle))
    turned = (vertices - centre) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + centre + [push, 0, 0]
    q, u = placed(turned, [0, 0, 1]), placed(np.tile(velocity, (3, 1)), [0, 0, 0])
    for _ in range(20):
        q = q - np.linalg.pinv(numbers.phi_q(q, u)) @ numbers.phi(q, u)
    phi_q = numbers.phi_q(q, u)
    return np.concatenate([q, u - np.linalg.pinv(phi_q) @ (phi_q @ u)])


@dataclass(frozen=True)
class Motion:
    """The motion at the steps of the integration: a column each."""

    t: Array
    q: Array
    u: Array
    evaluations: int


def integrate(numbers: Numbers, state: Array, duration: float, progress: Callable[[float], None]) -> Motion:
    def rates(t: float, y: Array) -> Array:
        progress(t)
        return np.concatenate([y[12:], numbers.unknowns(y[:12], y[12:])[:12]])

    solution = solve_ivp(rates, (0, duration), state, method="DOP853", rtol=1e-12, atol=1e-13)
    if not solution.success:
        raise SystemExit(f"the integration stopped at t = {solution.t[-1]:.3f} s: {solution.message}")
    return Motion(solution.t, solution.y[:12], solution.y[12:], solution.nfev)


@dataclass(frozen=True)
class Results:
    """What is looked at, at every step of the motion."""

    centre: Array
    """Position of the centre of mass, a row x, y, z, in m."""
    angle: Array
    """By which the plate has turned about the vertical, in degrees."""
    tension: Array
    """Of the three threads, in N."""
    energy_drift: Array
    """Of the energy above the position of rest, relative."""
    position_error: Array
    velocity_error: Array
    """The largest of the nine constraints, and of their rates; those of the threads in m^2."""


def evaluate(numbers: Numbers, motion: Motion) -> Results:
    q, u = motion.q, motion.u
    A, B, C = q[0:3], q[3:6], q[6:9]
    u_axis = B + C - 2 * A
    energy = numbers.energy(q, u)
    multipliers = numbers.unknowns(q, u)[12:]
    return Results(
        centre=(A + B + C) / 3,
        angle=np.degrees(np.unwrap(np.arctan2(u_axis[1], u_axis[0]))),
        tension=-2
        * VALUES[h]
        * multipliers[6:],  # phi_q lambda = 2 lambda (P - P0), and the thread's length is h
        energy_drift=energy / energy[0] - 1,
        position_error=np.abs(numbers.phi(q, u)).max(axis=0),
        velocity_error=np.abs(numbers.phi_rate(q, u)).max(axis=0),
    )


# --- files and figures: nothing is ever written half -----------------------------------------------------------------


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Give a temporary name to write to, and rename when all is written."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(path.name + ".part")
    yield temporary
    temporary.replace(path)


def equations_text(models: Sequence[Model]) -> str:
    lines = ["Trifilar pendulum in natural coordinates. All 21 expressions are zero; a prime is d/dt."]
    names = [*map(str, q), *(f"constraint {k}" for k in range(1, 10))]
    for model in models:
        definitions, zeros = sb.listing(model.equations)
        lines += ["", "", model.title, "=" * len(model.title)]
        lines += [f"{name} = {value}" for name, value in definitions]
        for k, (name, zero) in enumerate(zip(names, zeros, strict=True), start=1):
            lines += ["", f"{k}, {name}", zero]
    return "\n".join(lines) + "\n"


def equations_latex(models: Sequence[Model]) -> str:
    lines = [r"\documentclass{article}", r"\usepackage{amsmath}"]
    lines += [r"\usepackage[paperwidth=50cm,paperheight=40cm,margin=2cm]{geometry}", r"\allowdisplaybreaks"]
    lines += [r"\begin{document}", r"\title{Trifilar pendulum in natural coordinates}\date{}\maketitle"]
    for model in models:
        definitions, zeros = sb.listing(model.equations, "latex")
        rows = [f"{name} &= {value}" for name, value in definitions] + [f"0 &= {zero}" for zero in zeros]
        lines += [rf"\section*{{{model.title}}}", r"\begin{align*}", " \\\\\n".join(rows), r"\end{align*}"]
    return "\n".join([*lines, r"\end{document}"]) + "\n"


def figure(motion: Motion, results: Results) -> Figure:
    picture = Figure(figsize=(13, 9), layout="constrained")
    axes = picture.subplot_mosaic([["above", "centre"], ["above", "angle"], ["drift", "tension"]])
    turned = f"turned by {results.angle[0]:.0f} degrees"
    picture.suptitle(f"Trifilar pendulum: the plate is {turned}, pushed aside and let go with a swing")
    draw_from_above(axes["above"], motion)
    rest = hanging(-1)[:9].reshape(3, 3).mean(axis=0)
    draw_rows(axes["centre"], motion.t, results.centre - rest[:, None], ("$x_G$", "$y_G$", "$z_G$"))
    axes["centre"].set(title="Centre of mass, from its position at rest", ylabel="displacement [m]")
    axes["angle"].plot(motion.t, results.angle, color="C3")
    axes["angle"].set(title="Rotation about the vertical", ylabel="angle [deg]", yticks=range(-60, 61, 30))
    draw_rows(axes["tension"], motion.t, results.tension, ("$A_0A$", "$B_0B$", "$C_0C$"))
    axes["tension"].set(title="Tension of the threads", ylabel="tension [N]", ylim=(0, None))
    errors = np.abs([results.energy_drift, results.position_error, results.velocity_error])
    names = ("energy,\nrelative", "constraints\n$|\\varphi|$", "their rates\n$|\\dot\\varphi|$")
    draw_rows(axes["drift"], motion.t, np.maximum(errors, 1e-17), names)
    axes["drift"].set(title="Drift", ylabel="largest error [SI units]", yscale="log", ylim=(1e-17, 1e-11))
    for name in ("centre", "angle", "tension", "drift"):
        axes[name].set(xlabel="time [s]", xlim=(0, motion.t[-1]))
        axes[name].grid(alpha=0.3)
    return picture


def draw_rows(axes: Axes, t: Array, rows: Array, names: Sequence[str]) -> None:
    for row, name in zip(rows, names, strict=True):
        axes.plot(t, row, label=name)
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)


def draw_from_above(axes: Axes, motion: Motion) -> None:
    """Draw the paths of the vertices, the plate at the start, and where it hangs at rest."""
    for k, name in enumerate("ABC"):
        axes.plot(motion.q[3 * k], motion.q[3 * k + 1], color=f"C{k}", linewidth=0.8, label=f"path of {name}")
    start, rest = (state[:9].reshape(3, 3).T[:2] for state in (motion.q[:, 0], hanging(-1)))
    axes.fill(*start, facecolor="0.85", edgecolor="0.2", alpha=0.8, label="at the start")
    axes.fill(*rest, fill=False, edgecolor="0.4", linestyle="--", label="at rest, below\nthe anchors")
    axes.set(title="Seen from above", xlabel="x [m]", ylabel="y [m]", aspect="equal")
    axes.grid(alpha=0.3)
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)


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
    row("9 in Baumgarte's form", [sb.cost(model.stabilized).total for model in models])
    costs = [sb.cost(model.equations) for model in models]
    row("all 21 together", [cost.total for cost in costs])
    for kind in ("additions", "multiplications", "divisions"):
        row(f"  {kind}", [getattr(cost, kind) for cost in costs])
    table.add_section()
    row("free motions at rest", [len(inertia) for inertia in free_inertia])
    row("  that have inertia", [np.linalg.matrix_rank(inertia, tol=1e-9) for inertia in free_inertia])
    return table


def result_table(motion: Motion, results: Results, seconds: float) -> Table:
    table = Table(title=f"The motion of {DURATION:g} s", title_justify="left", show_header=False)
    start = f"{results.position_error[0]:.1e}, their rates {results.velocity_error[0]:.1e}"
    for name, value in (
        ("integrated in", milliseconds(seconds)),
        ("steps, evaluations", f"{len(motion.t) - 1}, {motion.evaluations}"),
        ("constraints at the start", start),
        ("largest drift of the constraints", f"{results.position_error.max():.1e}"),
        ("of their rates", f"{results.velocity_error.max():.1e}"),
        ("largest drift of the energy, relative", f"{np.abs(results.energy_drift).max():.1e}"),
        ("rotation about the vertical", f"{results.angle.min():.1f} to {results.angle.max():.1f} deg"),
        ("tension of the threads", f"{results.tension.min():.2f} to {results.tension.max():.2f} N"),
    ):
        table.add_row(name, value)
    return table


NOTE = """\
The worksheet puts the plate's centre of mass in a frame parallel to ground. Its energy is translational only: at \
rest the plate turns about the vertical without inertia, and the equations leave its acceleration open. So what is \
simulated is the plate in its own frame.
The worksheet's B0 and C0 have the opposite y of the plate's B and C. A plate that hangs from them straight has its \
normal down (or is mirrored). In the model that is simulated they are above B and C, and the normal points up.
"""


def main() -> None:
    console = Console(highlight=False)
    console.rule("Trifilar pendulum in natural coordinates")
    worksheet = derive("as in the worksheet", worksheet_system)
    physical = derive("plate in its own frame", physical_system)
    with step(console, "the worksheet's commands, one by one, give the same twelve equations"):
        assert as_in_the_worksheet(worksheet.motion) == list(worksheet.motion.residuals)
    with step(console, "both models compiled to functions of numbers"):
        singular, numbers = Numbers(worksheet, VALUES), Numbers(physical, VALUES)
    inertia = [singular.inertia_of_free_motion(hanging(+1)), numbers.inertia_of_free_motion(hanging(-1))]
    console.print(size_table([worksheet, physical], inertia))
    console.print(NOTE)
    write_equations(console, [worksheet, physical])
    simulate(console, numbers)


def write_equations(console: Console, models: Sequence[Model]) -> None:
    for name, text in (("txt", equations_text), ("tex", equations_latex)):
        path = FOLDER / f"trifilar_equations.{name}"
        with step(console, f"equations written to {path}"), whole_file(path) as file:
            file.write_text(text(models), encoding="utf-8")


def simulate(console: Console, numbers: Numbers) -> None:
    with step(console, "a state found that satisfies the nine constraints and their rates"):
        state = displaced_state(numbers)
    start = perf_counter()
    with Progress(*PROGRESS, console=console) as progress:
        task = progress.add_task("integrating", total=DURATION)
        motion = integrate(numbers, state, DURATION, lambda t: progress.update(task, completed=t))
    results = evaluate(numbers, motion)
    console.print(result_table(motion, results, perf_counter() - start))
    path = FOLDER / "trifilar_motion.png"
    with step(console, f"motion drawn in {path}"), whole_file(path) as file:
        figure(motion, results).savefig(file, format="png", dpi=150)


if __name__ == "__main__":
    main()
