"""The Python program of a worksheet runs, and gives what the worksheet gives."""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest

import symbody as sb
from symbody.errors import WorksheetError
from symbody.symbolic import symbol, time_function
from symbody.worksheet.convert import convert_file
from symbody.worksheet.convert.names import identifier
from symbody.worksheet.convert.program import Converted, converted
from symbody.worksheet.convert.same import same
from symbody.worksheet.convert.statement_kinds import loop_variables
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading import names_in_code, read_source, statements
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.sheet.source import Remark, SyntaxMistake
from tests.repeated import repeated
from tests.worksheets.test_seeds import FOLDERS, NEWTON, TRIFILAR

VALID = Path(__file__).parents[2] / "worksheets" / "valid"


def program(text: str, title: str) -> str:
    return converted(source_cells(text), title).text


def run(text: str) -> dict[str, Any]:
    """Run a program; other tests of this process use its names for other things."""
    values: dict[str, Any] = {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", sb.ModelNotice)
        warnings.filterwarnings("ignore", "FigureCanvasAgg is non-interactive")
        exec(text, values)
    return values


def session_of(path: Path, folder: Path) -> tuple[Session, set[str]]:
    """Return the session of a sheet, and the variables of its loops."""
    interpreter, loops = Interpreter(Session(folder=folder, source=path.parent)), set[str]()
    cells = read_source(path)
    used = names_in_code(cells)
    for cell in cells:
        for statement in statements(cell, used):
            loops.update(loop_variables(statement))
            if not isinstance(statement, Remark | SyntaxMistake):
                with suppress(WorksheetError):
                    interpreter.execute(statement)
    return interpreter.session, loops


def marked(values: dict[str, Any]) -> Iterator[tuple[sb.Expr, sb.Expr]]:
    """Return the small variables of a program, with those without the mark."""
    for value in values.values():
        if isinstance(value, sb.Expr) and value.is_variable:
            plain = time_function(value.name) if value.kind == "time_function" else symbol(value.name)
            if value == sb.small(plain):
                yield value, plain


QUICK = [
    *(
        "pendulum_newton.mpl",
        "slider_crank.mpl",
        "spherical_joints.mpl",
        "objects_and_copies.mpl",
        "tables.mpl",
    ),
    *("cam_follower.mpl", "late_values.mpl", "motorcycle_linear.mpl", "tyre.mpl", "three_restarts.mpl"),
]
OTHERS = sorted({each.name for each in VALID.iterdir()} - {*QUICK})


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The output folder of all sheets: one reads what another one has saved."""
    return tmp_path_factory.mktemp("sheets")


@cache
def program_of(path: Path, folder: Path) -> Converted:
    return converted(read_source(path), path.stem, Session(folder=folder, source=path.parent))


@pytest.mark.filterwarnings("ignore::symbody.errors.ModelNotice")  # a run prints them as notes
@pytest.mark.parametrize("sheet", [*QUICK, *repeated(OTHERS)])
def test_programs_give_what_the_sheets_give(
    sheet: str,
    folder: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    made, (session, loops) = program_of(VALID / sheet, folder), session_of(VALID / sheet, folder)
    values = run(made.text)
    marks = dict(marked(values))
    # What is left out stays a symbol, and a loop leaves its variable one step behind.
    named = {name: values.get(identifier(name)) for name in session.names if name not in loops}
    checked = {name: value for name, value in named.items() if value is not None and str(value) != name}
    assert len(checked) > 0 or made.values + made.left_out > 0
    assert [
        name for name, value in checked.items() if not same(session, value, session.names[name], marks)
    ] == []


@pytest.mark.parametrize("seed", [NEWTON, *repeated([TRIFILAR])])
def test_seeds_are_converted_completely(seed: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One statement calls a command that doesn't exist: its value is written."""
    if not FOLDERS:
        pytest.skip("the seeds are other people's texts, and not in the repository")
    made = program_of(FOLDERS[0] / f"{seed}.txt", folder)
    run(made.text)
    assert (made.values, made.left_out, made.failed) == (int(seed == NEWTON), 0, 0)


@pytest.mark.repeated
def test_hardly_any_statement_remains_a_remark(folder: Path) -> None:
    """What remains is drawings, comparisons as values, rules of several arguments: 2.1 % of all, and 6.8 % values."""
    seeds = [path for each in FOLDERS[:1] for path in sorted(each.iterdir())]
    made = [program_of(path, folder) for path in (*sorted(VALID.iterdir()), *seeds)]
    total = sum(each.code + each.values + each.left_out for each in made)
    assert sum(each.left_out for each in made) < 0.023 * total
    assert sum(each.values for each in made) < 0.07 * total


def test_long_lines_are_broken() -> None:
    names = ", ".join(f"make_POINT(ground, a{k}, b{k}, c{k})" for k in range(6))
    text = program(f"with(MBSymba_r6): P := [{names}]:\n", "points")
    assert max(map(len, text.splitlines())) <= 100
    assert "P = [\n    sb.Point(sb.ground, a0, b0, c0),\n" in text
    assert len(run(text)["P"]) == 6


def test_procedures_are_functions_and_loops_are_loops() -> None:
    sheet = """restart: with(MBSymba_r6):
arm := proc(T, {m := 0}) local P; P := make_POINT(T, 0, l/2, 0); make_BODY(P, m) end proc:
for i from 1 to 2 do b[i] := arm(translate(i*l, x(t), 0), m = i*mu): od:
f := n -> if n < 2 then 1 else n*f(n-1) end if:
K := kinetic_energy({b[1], b[2]}) + f(4);
"""
    text = program(sheet, "arms")
    assert text == (
        '"""arms, converted from a worksheet of MBSymba."""\n\nimport symbody as sb\n\n'
        'x = sb.functions_of_time("x")\nl, mu = sb.symbols("l mu")\n\n'
        "def arm(T, *, m=0):\n    P = sb.Point(T, 0, l/2, 0)\n    return sb.Body(P, m)\n\n"
        "b = {}\nfor i in range(1, 3):\n    b[i] = arm(sb.translate(i*l, x, 0), m=i*mu)\n\n"
        "def f(n):\n    if n < 2:\n        return 1\n    return n*f(n - 1)\n\n"
        "K = sb.kinetic_energy([b[1], b[2]]) + f(4)\n"
    )
    x, mu = sb.functions_of_time("x"), sb.symbols("mu")
    assert run(text)["K"] == 3 * mu * sb.diff(x, sb.t) ** 2 / 2 + 24


def test_names_that_are_joined_of_pieces_are_written_out() -> None:
    sheet = (
        "with(MBSymba_r6): N := 2: "
        "for n from 1 to N do crank||n := make_BODY(rotate('Z',q||n(t))*translate(r,0,0), m||n): "
        "w||n := n: end do: K := kinetic_energy({seq(crank||n, n=1..2)}): S := add(w||i*m||i, i=1..2):\n"
        "comp_XYZ(velocity(CoM(crank1))), m1;"
    )
    text = program(sheet, "cranks")
    assert 'crank2 = sb.Body(sb.rotate("Z", q2)*sb.translate(r, 0, 0), m2)\nw2 = 2\n' in text
    assert "K = sb.kinetic_energy([crank1, crank2])\nS = sum([w1*m1, w2*m2])\n" in text
    assert "print(*sb.velocity(crank1.center_of_mass).components, m1)" in text
    made = run(text)
    q1, q2, m1, m2, r = (made[each] for each in ("q1", "q2", "m1", "m2", "r"))
    assert made["K"] == r**2 * (m1 * sb.diff(q1, sb.t) ** 2 + m2 * sb.diff(q2, sb.t) ** 2) / 2
    assert made["S"] == m1 + 2 * m2


def test_matrices_of_functions_of_the_indices_are_comprehensions() -> None:
    text = program(
        "q := [x(t), y(t)]: n := 2: M := Matrix(n, 3, (i,j) -> q[i]*j): v := Vector(n, i -> diff(q[i],t)):",
        "m",
    )
    assert "M = sb.Matrix([[q[i - 1]*j for j in range(1, 4)] for i in range(1, n + 1)])\n" in text
    assert "v = sb.Matrix.column([sb.diff(q[i - 1], sb.t) for i in range(1, n + 1)])\n" in text
    made = run(text)
    x, y = made["x"], made["y"]
    assert made["M"] == sb.Matrix([[x, 2 * x, 3 * x], [y, 2 * y, 3 * y]])


def test_names_that_differ_by_an_underscore_are_two() -> None:
    made = run(program("e := theta*2 + theta_(t): f := diff(e, t): g := subs(theta=3, e):", "names"))
    assert made["f"] == sb.diff(made["theta_"], sb.t)
    assert made["g"] == 6 + made["theta_"]


def test_frames_hang_on_the_moving_frame() -> None:
    sheet = """restart: with(MBSymba_r6):
use_moving_frame(u(t), v(t), 0, 0, 0, r(t)):
T := translate(a, 0, 0) * rotate('Z', delta(t)):
V := velocity(make_POINT(T, b, 0, 0)):
w := angular_velocity(T):
"""
    text = program(sheet, "car")
    assert 'master = sb.moving_frame(u, v, 0, 0, 0, r, name="moving_frame")' in text
    assert "V = sb.velocity(sb.Point(master*T, b, 0, 0))\nw = sb.angular_velocity(master*T)\n" in text


def test_small_variables_are_marked() -> None:
    sheet = """restart: with(MBSymba_r6):
linear_modeling({phi(t)}):
b := make_BODY(rotate('X', phi(t)) * translate(0, 0, h), m):
K := kinetic_energy(b):
"""
    assert 'phi = sb.small(phi)\nb = sb.Body(sb.rotate("X", phi)*sb.translate(0, 0, h), m)\n' in program(
        sheet, "lean"
    )


def test_a_program_reads_as_one_would_write_it() -> None:
    sheet = """restart: with(MBSymba_r6):
T := translate(x(t), 0, 0):
b := make_BODY(T, m):
_gravity := make_VECTOR(ground, 0, -g, 0):
E1 := newton_equations({b}):
F := comp_X(E1);
"""
    text = program(sheet, "slide")
    assert text == (
        '"""slide, converted from a worksheet of MBSymba."""\n\nimport symbody as sb\n\n'
        'x = sb.functions_of_time("x")\nm, g = sb.symbols("m g")\n\n'
        "T = sb.translate(x, 0, 0)\nb = sb.Body(T, m)\ngravity = sb.Vector(sb.ground, 0, -g, 0)\n"
        "E1 = sb.newton_equations([b], gravity=gravity)\nF = E1.components[0]\n"
    )


def test_a_value_that_comes_later_reaches_what_was_made_before() -> None:
    values = run(program("T := rotate('Z', a):\nP := make_POINT(T, l, 0, 0):\na := w - b:\n", "late"))
    w, b, l = sb.symbols("w b l")
    assert values["T"].matrix == sb.rotate("Z", w - b).matrix
    assert sb.project(values["P"], sb.ground).coordinates[0] == l * sb.cos(w - b)


def test_what_has_no_text_is_written_as_its_value(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # the sheet draws
    text = program("y := evalc(a + x);\nplot(y, b = 0..1);\n", "values")
    assert "# values of line 1: y := evalc(a + x);\ny = a + x\n" in text
    assert "# left out, line 2: plot(y, b = 0..1);" in text
    a, x = sb.symbols("a x")
    assert run(text)["y"] == a + x


def test_linear_algebra_is_that_of_a_matrix() -> None:
    text = program(
        "with(LinearAlgebra): A := Matrix([[2, 1], [1, k]]): v := <1, 2>:\n"
        "s := LinearSolve(A, v): n := Norm(s, 2): p := DotProduct(v, A . v): r := Row(A, 2):\n"
        "c := Multiply(A, A)[1, 2]:\n"
        "q := CrossProduct(<1, 0, 0>, <0, 1, 0>): T := Trace(A): R := SubMatrix(A, 1..2, 2..2):\n",
        "algebra",
    )
    assert "# values" not in text
    assert "s = A.inverse() @ v\n" in text
    made = run(text)
    assert made["A"] @ made["s"] == made["v"]
    assert made["q"] == sb.Matrix.column([0, 0, 1])


def test_equations_that_are_not_linear_are_solved() -> None:
    text = program(
        "r := solve(x^2 - a, x): y := isolate(a*z + b = 0, z): f := D(u -> u^3): w := f(2):\n"
        "s := fsolve({p^2 + q = 3, p - q = 1}, {p = 0..2, q = 0..1}):\n"
        "m := max(1, 3, 2), min(a, b): g := gcd(12, 18):\n",
        "roots",
    )
    assert "# values" not in text
    assert "y = {z: sb.solve(a*z + b, z)[z]}\n" in text
    made = run(text)
    p, q = sb.symbols("p q")
    assert made["w"] == 12
    assert made["s"][p] ** 2 + made["s"][q] == pytest.approx(3)


def test_pictures_are_those_of_matplotlib() -> None:
    text = program(
        "spacecurve([cos(s), s, s/5], s = 0..4):\n"
        "plot3d(sin(x)*y, x = 0..Pi, y = 0..1), plot3d([x, y, x*y], x = 0..1, y = 0..1):\n"
        "implicitplot(x^2 + y^2 = 1, x = -2..2, y = -2..2):\n"
        "pointplot([[0, 0], [1, 1/2]]): pointplot3d([[0, 0, 0], [1, 1, 1]]):\n",
        "pictures",
    )
    assert "left out" not in text
    assert "print(" not in text
    plt.close("all")  # writing a program evaluates its texts
    run(text)
    curve, surface, mesh, level, _, points = (plt.figure(k).axes[0] for k in plt.get_fignums())
    assert curve.lines[0].get_data_3d()[1].tolist() == np.linspace(0, 4, 200).tolist()
    assert surface.get_zlim()[1] > 0.99
    assert mesh.get_xlim()[1] >= 1
    circle = np.vstack([path.vertices for each in level.collections for path in each.get_paths()])
    assert max(abs(np.hypot(*circle.T) - 1)) < 0.01
    assert len(points.lines[0].get_data_3d()[0]) == 2
    plt.close("all")


def test_quotients_of_integers_are_exact() -> None:
    text = program("T := 1/2*m*v^2 + m/3 + 2/3: y := 1/3 + 0.1*x:\n", "numbers")
    assert 'T = m*v**2/2 + m/3 + sb.number("2/3")' in text
    m, v, x = sb.symbols("m v x")
    values = run(text)
    assert values["T"] == m * v**2 / 2 + m / 3 + sb.number("2/3")
    assert values["y"] == sb.number("1/3") + sb.number("0.1") * x


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    sheet = tmp_path / "a.mpl"
    sheet.write_text("a := 2*b;\nc := (1;\n", encoding="utf-8")
    options = argparse.Namespace(file=sheet, program=tmp_path / "model.py")
    assert convert_file(options) == 1
    assert capsys.readouterr().out == "1 statements written as code, 0 as values, 0 left out, 1 failed\n"
    assert "# line 2 can't be read" in (tmp_path / "model.py").read_text(encoding="utf-8")
    options.file = tmp_path / "missing.mpl"
    assert convert_file(options) == 3
    assert "is not readable" in capsys.readouterr().err


def test_small_variables_mark_what_was_made_before() -> None:
    text = program(
        "with(MBSymba_r6): T := translate(x(t),y(t),0)*rotate('Z',psi(t)): B := make_BODY(T,m,0,0,J): "
        "e := comp_Y(newton_equations({B}),T): linear_modeling({psi(t),y(t)}): lin := linearize(e): "
        "l := lagrange_equations({B},[y(t),psi(t)]):",
        "single track",
    )
    assert "lin = sb.taylor(e)" in text
    assert "l = [sb.lagrange(sb.kinetic_energy([B]), each) for each in [y, psi]]" in text
    values, (x, y, psi), m = run(text), sb.functions_of_time("x y psi"), sb.symbols("m")
    small = {values["psi"]: psi, values["y"]: y}
    assert values["lin"].subs(small) == m * (sb.time_derivative(y, 2) - psi * sb.time_derivative(x, 2))


def test_integrals_and_matrices_are_those_of_sympy() -> None:
    pytest.importorskip("sympy")
    values = run(
        program(
            "J := int(m/L*z^2, z=-L/2..L/2): M := matrix([[1,2],[3,4]]): p := linalg[charpoly](M, s): "
            "R := linalg[rref](matrix([[1,2],[2,4]])): a := `+`(b, c, d): q := ListTools:-Reverse([b, c]):",
            "integrals",
        )
    )
    m, L, s, b, c, d = sb.symbols("m L s b c d")
    assert (values["J"], values["p"]) == (m * L**2 / 12, s**2 - 5 * s - 2)
    assert values["R"] == sb.Matrix([[1, 2], [0, 0]])
    assert (values["a"], values["q"]) == (b + c + d, [c, b])


def test_linear_models_keep_the_model() -> None:
    text = program(
        "with(MBSymba_r6): _gravity := make_VECTOR(ground,0,-g,0): linear_modeling({theta(t),x(t)}): "
        "T := translate(x(t),0,0)*rotate('Z',theta(t)): B := make_BODY(make_POINT(T,0,-L,0),m,0,0,J): "
        "l := lagrange_equations({B},[x(t),theta(t)]): X, eq := first_order(l,[x(t),theta(t)],t): "
        "A, Bm := state_space(eq,t,X,[f(t)]): q := lagrange_equations({B},theta(t)): linear_modeling({}): "
        "K := kinetic_energy(B):",
        "cart",
    )
    assert "parse" not in text
    assert "speeds = {sb.diff(x, sb.t): x_dot, sb.diff(theta, sb.t): theta_dot}\n" in text
    assert "rates = sb.solve(eq, sb.diff(X, sb.t)).values()\nA = sb.jacobian(rates, X)\n" in text
    values, (x, theta), (m, L, J, g) = run(text), sb.functions_of_time("x theta"), sb.symbols("m L J g")
    by_hand = [[0, 0, 1, 0], [0, 0, 0, 1], [0, -g * L * m / J, 0, 0], [0, 0, 0, 0]]
    by_hand[2][1], by_hand[3][1] = g * L**2 * m / J, -g * L * m / J
    assert values["A"] == sb.Matrix(by_hand)
    speed = sb.diff(x, sb.t) + L * sb.cos(theta) * sb.diff(theta, sb.t)
    across = L * sb.sin(theta) * sb.diff(theta, sb.t)
    assert values["K"] == (m * (speed**2 + across**2) + J * sb.diff(theta, sb.t) ** 2) / 2


def test_loops_over_tables_of_objects_keep_the_model() -> None:
    made = converted(
        source_cells(
            "with(MBSymba_r6): T := translate(x(t),0,z(t))*rotate('Y',mu(t)): b := make_BODY(T,m,0,I__y,0): "
            "for nm in [fl,fr] do at[nm] := translate(p[nm],0,0): P[nm] := origin(T*at[nm]): "
            "F[nm] := make_FORCE(make_VECTOR(ground,0,0,-k*comp_Z(P[nm],ground)),P[nm],b): od: "
            "S := {b, seq(F[j], j in [fl,fr])}: N := newton_equations(S): w := fl: F[w][acting][mass]; "
            "G := make_FORCE(ground,0,0,f,origin(b),b): NG := newton_equations({b,G}):"
        ),
        "car",
    )
    assert (made.values, made.left_out) == (0, 0)
    assert "for nm in [fl, fr]:\n    at[str(nm)] = sb.translate(" in made.text
    assert "S = [b, *[F[str(j)] for j in [fl, fr]]]\nN = sb.newton_equations(S)\n" in made.text
    values, (x, z, mu), (m, k) = run(made.text), sb.functions_of_time("x z mu"), sb.symbols("m k")
    places = symbol("p[fl]") + symbol("p[fr]")
    by_hand = [m * sb.diff(x, sb.t, 2), 0, m * sb.diff(z, sb.t, 2) + k * (2 * z - places * sb.sin(mu))]
    assert list(values["N"].components) == by_hand


def test_a_moving_frame_takes_the_gravity_along_that_was_given_before(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)  # the sheet and the program save values
    made = converted(
        source_cells(
            "with(MBSymba_r6): _gravity := make_VECTOR(ground,0,0,g): B := make_BODY(rotate('Z',psi(t)),m): "
            "N := newton_equations(B): use_moving_frame(u(t),v(t),0,0,0,r(t)): "
            "B2 := make_BODY(rotate('X',phi(t))*translate(0,0,-h),m,Ix,0,0): N2 := newton_equations(B2): "
            "w := angular_velocity(rotate('Z',a(t))*rotate('X',b(t)),rotate('Z',a(t))): "
            'L := [comp_X(N), 2] - [1, x]: M := 2*L - L/2: save(M, N, "k.m"):'
        ),
        "modes",
    )
    assert (made.values, made.left_out) == (0, 0)
    assert "gravity = sb.Vector(master, *gravity.components)" in made.text
    values, (phi, b), (m, g, h) = run(made.text), sb.functions_of_time("phi b"), sb.symbols("m g h")
    rise = sb.diff(-h * sb.cos(phi), sb.t, 2)
    assert values["N2"].components[2] == m * rise - m * g
    assert list(values["w"].components) == [sb.diff(b, sb.t), 0, 0]


def test_functions_remember_what_procedures_remember() -> None:
    text = program(
        "f := proc(n) option remember; if n < 2 then n else f(n-1)+f(n-2) fi end: f(60);", "fibonacci"
    )
    assert "import functools\n" in text
    assert "@functools.cache\ndef f(n):\n" in text
    assert run(text)["f"](60) == 1548008755920


def test_small_deviations_are_from_other_variables() -> None:
    text = program(
        "with(MBSymba_r6): T := rotate('Z',phi(t)): linear_modeling({psi(t) = phi(t)}): "
        "v := linearize(sin(psi(t))): linear_modeling({phi(t)}): w := linearize(sin(phi(t)) + cos(psi(t))):",
        "deviations",
    )
    assert (
        "psi = phi + sb.small(psi)  # results print the deviation as psi\nv = sb.taylor(sb.sin(psi))\n"
        in text
    )
    values, (phi, psi) = run(text), sb.functions_of_time("phi psi")
    assert values["v"].subs({sb.small(phi): phi}) == sb.sin(phi) + (psi - phi) * sb.cos(phi)
    assert values["T"].matrix == sb.rotate("Z", sb.small(phi)).matrix


def test_tracking_equations_are_those_of_the_pose() -> None:
    text = program(
        "with(MBSymba_r6): tr := use_moving_frame(V, v(t), 0, 0, 0, r(t), translate(x(t),y(t),0)*rotate('Z',psi(t))): "
        "s := solve(tr, [diff(x(t),t), diff(y(t),t), diff(psi(t),t)]):",
        "track",
    )
    assert "parse" not in text
    v, r, x, psi = sb.functions_of_time("v r x psi")
    ((solved,)) = run(text)["s"]
    assert solved[sb.diff(x, sb.t)] == sb.symbols("V") * sb.cos(psi) - v * sb.sin(psi)
    assert solved[sb.diff(psi, sb.t)] == r


def test_what_is_put_in_is_one_dictionary_of_plain_numbers() -> None:
    text = program(
        "data := [m = 1200, k = 2e5, c = .5]: w := subs(data, sqrt(k/m)*c): r := 0.1: y := 2.5*m*r:", "data"
    )
    assert "data = {m: 1200, k: 2e5, c: 0.5}\nw = sb.subs(sb.sqrt(k/m)*c, data)\n" in text
    assert "y = 2.5*m*r\n" in text
    values, m = run(text), sb.symbols("m")
    assert float(values["w"]) == pytest.approx(0.5 * np.sqrt(2e5 / 1200), rel=1e-12)
    assert values["y"] == m / 4


def test_sides_of_equations_are_those_of_pairs() -> None:
    text = program(
        "s := x^2 = a + b: r := sqrt(rhs(s)): e := y = c: z := rhs(e): L := [p + q = 1, p - q = 3]: v := rhs~(L): "
        "u := subs(e, y^2):",
        "sides",
    )
    assert "# values" not in text
    assert "s = (x**2, a + b)\nr = sb.sqrt(s[1])\ne = {y: c}\nz = e[y]\n" in text
    a, b, c = sb.symbols("a b c")
    made = run(text)
    assert (made["r"], made["z"], made["v"], made["u"]) == (sb.sqrt(a + b), c, [1, 3], c**2)


def test_a_symbol_beside_a_function_of_its_name() -> None:
    text = program("SR := {V(t) = V, v(t) = 0}: e := subs(SR, diff(V(t),t) + V(t)*v(t) + V(t)^2):", "steady")
    assert 'V_ = sb.symbols("V")\n' in text
    assert "SR = {V: V_, v: 0}\n" in text
    assert run(text)["e"] == sb.symbols("V") ** 2


def test_eigenvalues_and_roots_are_those_of_numpy() -> None:
    text = program(
        "with(LinearAlgebra): A := <0,1;-a,-2>: E := evalf(Eigenvalues(subs(a = 5, A))): "
        "R := [fsolve(x^3 - x, x)]: Z := fsolve(s^2 + 2*s + 5, s, complex):",
        "spectrum",
    )
    assert "# values" not in text
    made = run(text)
    assert sorted(made["E"], key=np.imag) == pytest.approx([-1 - 2j, -1 + 2j])
    assert sorted(made["Z"], key=np.imag) == pytest.approx([-1 - 2j, -1 + 2j])
    assert made["R"] == pytest.approx([-1, 0, 1])


def test_entries_of_a_matrix_are_assigned() -> None:
    text = program(
        "M := matrix(2,2): for i to 2 do for j to 2 do M[i,j] := i*x + j end do end do: d := M[2,1]:",
        "entries",
    )
    assert "rows[i - 1][j - 1] = i*x + j\n" in text
    x = sb.symbols("x")
    assert run(text)["M"] == sb.Matrix([[x + 1, x + 2], [2 * x + 1, 2 * x + 2]])


def test_rules_of_derivatives_are_rates() -> None:
    text = program(
        "with(MBSymba_r6): `diff/psi` := proc(t) w(t)/cos(phi(t)) end proc: "
        "K := kinetic_energy(make_BODY(rotate('Z',psi(t)), 0, 0, 0, J)): diff(sin(psi(t)), t);",
        "rules",
    )
    assert "rates_of_time[sb.diff(psi, sb.t)] = w/sb.cos(phi)\n" in text
    w, phi = sb.functions_of_time("w phi")
    assert run(text)["K"] == sb.symbols("J") * (w / sb.cos(phi)) ** 2 / 2


def test_what_prints_only_shows_no_older_value() -> None:
    text = program('a := 3*x: sprintf("%d", 4): lprint(x + 1); codegen[fortran](x^2);', "printed")
    assert "print(x + 1)\n" in text
    assert 'print(sympy.fcode(sb.to_sympy(x**2), assign_to="cg"))\n' in text


def test_the_moving_frame_becomes_small_with_its_velocities() -> None:
    text = program(
        "with(MBSymba_r6): use_moving_frame(V, v(t), 0, 0, 0, r(t)): linear_modeling({v(t), r(t), phi(t)}): "
        "b := make_BODY(rotate('X', phi(t))*translate(0,0,-h), m): y := comp_Y(newton_equations(b)): "
        "e := [subs(diff(phi(t),t) = p(t), y) = F(t), diff(phi(t),t) = p(t), diff(p(t),t) = -k*phi(t)]: "
        "A, B := state_space(e, t, [v(t), phi(t), p(t)], [F(t), r(t)]):",
        "leaning",
    )
    assert "# " not in text
    v, r, phi = sb.functions_of_time("v r phi")
    values, (m, h, V) = run(text), sb.symbols("m h V")
    marks = {sb.small(each): each for each in (v, r, phi)}
    assert values["y"].subs(marks) == m * (sb.diff(v, sb.t) + V * r + h * sb.diff(phi, sb.t, 2))


def test_each_value_of_a_statement_is_compared() -> None:
    """``has`` of Maple finds the time in a rate; the last value alone is the same."""
    text = program(
        "K := diff(psi(t), t)^2: has(K, t), has(K, psi(t)): has(K, t), has(x, x), 3; x, 2*x;\n", "items"
    )
    assert "print(True, x.has(x), 3)\n" in text
    assert "print(x, 2*x)\n" in text


@pytest.mark.parametrize(
    "written",
    [
        'fprintf(fd, "%s", convert(x^2 + 1, string))',
        'fprintf(fd, "%s", convert(x^2 + 1, string));',
        'fprintf(fd, "%s", C(Matrix([[x, 1], [1, x]]), optimize, output=string))',
        'fprintf(fd, "a\\n"): fprintf(fd, "y = %a;", x^2 + 1)',
        'for i to 2 do fprintf(fd, "%a", x^i + 1) od',
        'wr := proc(e) fprintf(fd, "%s", convert(e, string)) end:\nwr(x^2)',
        'fprintf(fd, "a\\n"): wr := proc(f, e) fprintf(f, "%s", convert(e, string)) end:\nwr(fd, x^2)',
    ],
)
def test_no_file_is_emptied(written: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What can't be written to a file as code leaves the user's file alone; other files are written."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "f.m").write_text("kept", encoding="utf-8")
    text = program(
        f'with(CodeGeneration): fd := fopen("g.m", WRITE): writeline(fd, "a", "b"): fprintf(fd, "%d", 3): fclose(fd):\n'
        f'fd := fopen("f.m", WRITE):\n{written}:\nfclose(fd):\n',
        "written",
    )
    (tmp_path / "f.m").write_text("kept", encoding="utf-8")
    assert "# left out, line 2:" in text
    assert text.count("# left out, line ") >= 3
    run(text)
    assert (tmp_path / "f.m").read_text(encoding="utf-8") == "kept"
    assert (tmp_path / "g.m").read_text(encoding="utf-8") == "a\nb\n3"
