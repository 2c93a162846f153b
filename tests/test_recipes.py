"""A half-followed recipe of docs/extending.md fails here: additions are checked against the laws of their kind."""

import inspect
import os
import re
import shutil
import subprocess
import sys
import typing
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from importlib.util import find_spec
from inspect import getfile, isabstract, isfunction
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

import symbody
from symbody import (
    Body,
    describe,
    dynamics,
    functions_of_time,
    lagrange_equations,
    lambdify,
    multibody,
    newton_euler,
    project,
    rotate,
    simulate,
    simulate_many,
    symbols,
    time_derivative,
    translate,
)
from symbody.dynamics import Equations
from symbody.errors import ModelError, SimulationError
from symbody.geometry.motion.frame_motion import FrameMotion
from symbody.multibody import Element, Load, System
from symbody.multibody.joint.joint import Joint
from symbody.simulation.given.options import Options
from symbody.simulation.integrate.methods import METHODS
from symbody.simulation.integrate.outcome import FailureKind
from symbody.simulation.integrate.task import Task
from symbody.simulation.model.model import model_of
from symbody.symbolic import free_symbols
from symbody.symbolic.expression import functions
from tests.laws import test_formalisms, test_rewrites
from tests.laws.random_element import MADE
from tests.laws.random_mechanism import BY_QUATERNION, KINDS, MESHES
from tests.laws.random_system import random_floating_system, random_system
from tests.reference import test_robots
from tests.symbolic import test_textbook_forms
from tests.test_documents import DOCUMENTS, PRINTED, TITLED
from tests.type_check import checked_types

ROOT = Path(__file__).parents[1]
RECIPES = ROOT / "docs" / "extending.md"
BLOCKS = [(block[1], block[2], block[3]) for block in TITLED.finditer(RECIPES.read_text(encoding="utf-8"))]
"""The files of the recipes, the changes of files, and the programs: language, title and text."""
FILES = {path: text for language, path, text in BLOCKS if language == "python" and "/" in path}
CHANGES = [(path, text) for language, path, text in BLOCKS if language == "diff"]
PROGRAMS = {path: text for language, path, text in BLOCKS if language == "python" and "/" not in path}
CHANGED = sorted({*FILES, *(path for path, _ in CHANGES)})


def concrete(base: type) -> Iterator[type]:
    """Each class of the package that is no base of others."""
    for derived in base.__subclasses__():
        yield from concrete(derived)
        if (
            not isabstract(derived)
            and not derived.__subclasses__()
            and derived.__module__.startswith("symbody.")
        ):
            yield derived


def changed(text: str, change: str) -> str:
    """A file with its lines changed: the hunks of a diff, each of which fits at one place."""
    for hunk in change.split("@@\n"):
        lines = hunk.splitlines(keepends=True)
        old = "".join(line[1:] or "\n" for line in lines if not line.startswith("+"))
        new = "".join(line[1:] or "\n" for line in lines if not line.startswith("-"))
        assert text.count(old) == 1, f"fits at {text.count(old)} places:\n{hunk}"
        text = text.replace(old, new)
    return text


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the package and its tests in which all recipes of the page have been followed."""
    home = tmp_path_factory.mktemp("recipes")
    ignored = shutil.ignore_patterns("golden")  # what is compiled serves the copy as well
    for folder in ("python", "tests", "docs", "scripts"):
        shutil.copytree(ROOT / folder, home / folder, ignore=ignored)
    shutil.copy(ROOT / "pyproject.toml", home)
    for path, text in FILES.items():
        assert not (home / path).exists()
        (home / path).write_text(text, encoding="utf-8")
    for path, change in CHANGES:
        text = (home / path).read_text(encoding="utf-8")
        (home / path).write_text(changed(text, change), encoding="utf-8")
    return home


def run(home: Path, folder: Path, *arguments: str) -> str:
    """What Python prints, with the package and the tests of the copy."""
    environment = os.environ | {"PYTHONPATH": f"{home / 'python'}{os.pathsep}{home}", "MPLBACKEND": "Agg"}
    done = subprocess.run(
        [sys.executable, *arguments], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_followed_recipes_are_those_that_programs_import(copy: Path, tmp_path: Path) -> None:
    printed = run(
        copy, tmp_path, "-c", "import symbody, tests.laws as laws; print(symbody.__file__, *laws.__path__)"
    )
    assert printed.split() == [str(copy / "python" / "symbody" / "__init__.py"), str(copy / "tests" / "laws")]


@pytest.mark.parametrize("program", PROGRAMS)
def test_the_program_of_a_followed_recipe_prints_what_its_comments_say(
    copy: Path, tmp_path: Path, program: str
) -> None:
    (tmp_path / program).write_text(PROGRAMS[program], encoding="utf-8")
    printed = run(copy, tmp_path, "-W", "error", program)
    assert printed.splitlines() == PRINTED.findall(PROGRAMS[program])


def test_no_other_page_has_blocks_that_run_in_the_copy_alone() -> None:
    """The test of documents leaves out blocks with titles."""
    titled = {
        page for page in DOCUMENTS if " title=" in "".join(re.findall(r"^```.*", page.read_text(), re.M))
    }
    assert titled == {RECIPES}
    assert len(BLOCKS) == len(re.findall(r"^```.* title=", RECIPES.read_text(encoding="utf-8"), re.MULTILINE))
    assert len(FILES) == len(PROGRAMS) == 4


def test_followed_recipes_keep_the_contracts_of_the_layers(copy: Path) -> None:
    command = "from importlinter.cli import lint_imports_command; lint_imports_command()"
    assert ", 0 broken" in run(copy, copy, "-c", command, "--no-cache")


@pytest.mark.parametrize("lint", ["check", "format"])
def test_followed_recipes_keep_the_lints(copy: Path, lint: str) -> None:
    options = ["--check"] if lint == "format" else []
    run(copy, copy, "-m", "ruff", lint, "--no-cache", *options, *CHANGED)


@pytest.mark.slow
def test_followed_recipes_keep_the_types(copy: Path, tmp_path: Path) -> None:
    """But for the lists of public names, for which all that imports them would be read again; they run in others."""
    lists = [path for path, _ in CHANGES if path.endswith("__init__.py")]
    home = tmp_path / "typed"
    shutil.copytree(copy / "python", home / "python", ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    for path in lists:
        shutil.copy(ROOT / path, home / path)
    shutil.copy(copy / "pyproject.toml", home)
    done = checked_types(home, tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_followed_recipes_keep_what_other_tests_ask_of_the_package(copy: Path) -> None:
    """Of methods of integration and joints of random mechanisms, those of the recipes are tested there."""
    files = [
        "tests/test_recipes.py",
        "tests/test_docstrings.py",
        "tests/test_rooms.py",
        "tests/laws/test_joints.py",
    ]
    files += [path for path in FILES if "frame" in path or "multibody" in path]
    chosen = "not followed and not imports and (not method or leapfrog) and (not test_joints or pin_in_slot)"
    options = ["-q", "--noconftest", "-p", "no:cacheprovider", "-k", chosen]
    printed = run(copy, copy, "-m", "pytest", *options, "-rA", *files)
    assert re.search(r"^PASSED tests/laws/test_joints.py::.*pin_in_slot", printed, re.MULTILINE)


LAWS = """
from tests.test_recipes import compare_formalisms, drawn

motions = lambda system: (type(m).__name__ for body in system.bodies for m in body.frame.motions)
loads = lambda system: (getattr(load, "kind", "") for load in system.loads)
for kind, parts in (("Helix", motions), ("rope", loads)):
    for system in drawn(kind, parts):
        compare_formalisms(system)
"""


def test_followed_recipes_obey_the_laws(copy: Path) -> None:
    run(copy, copy, "-c", LAWS)


def test_every_joint_occurs_in_the_random_mechanisms() -> None:
    public = (getattr(symbody, name) for name in symbody.__all__)
    hints = {f.__name__: typing.get_type_hints(f) for f in public if isfunction(f)}
    assert {name for name, hint in hints.items() if hint.get("return") is Joint} == {*KINDS, *MESHES} - {
        *BY_QUATERNION
    }


def drawn(kind: str, parts: Callable[[System], Iterable[str]]) -> list[System]:
    """Twelve random systems that contain a kind of thing, with symbols and with numbers."""
    made = (random_system(seed, symbolic=bool(seed % 2)) for seed in range(60))
    found = [*islice((system for system in made if any(part == kind for part in parts(system))), 12)]
    assert len(found) == 12
    return found


def compare_formalisms(system: System) -> None:
    """The same nodes by both, and compiled the numbers that the expressions have."""
    one, two = newton_euler(system), lagrange_equations(system)
    assert one.residuals == two.residuals
    assert one.mass_matrix == two.mass_matrix
    leaves = sorted(free_symbols(one.residuals), key=str)
    values = np.linspace(0.3, 0.9, len(leaves))
    expected = [residual.evaluate(dict(zip(leaves, values, strict=True))) for residual in one.residuals]
    np.testing.assert_allclose(lambdify(leaves, list(one.residuals))(*values), expected, rtol=1e-8, atol=1e-9)


@cache
def systems() -> list[System]:
    return [random_system(seed) for seed in range(60)] + [random_floating_system(seed) for seed in range(20)]


def test_every_motion_occurs_in_the_random_systems() -> None:
    motions = {type(m) for system in systems() for body in system.bodies for m in body.frame.motions}
    assert set(concrete(FrameMotion)) <= motions


@pytest.mark.parametrize("layer", ["geometry", "multibody", "dynamics", "simulation", "view"])
def test_no_file_asks_of_which_kind_a_motion_is(layer: str) -> None:
    """What a motion does differently is a method of it; only a motion itself may merge with its like."""
    kinds = "|".join(motion.__name__ for motion in concrete(FrameMotion))
    question = re.compile(rf"isinstance\([^()]*\b({kinds})\b|case ({kinds})\(")
    home = Path(symbody.__file__).parent / layer
    own = {Path(str(getfile(motion))) for motion in concrete(FrameMotion)}
    asking = [path for path in home.rglob("*.py") if path not in own and question.search(path.read_text())]
    assert asking == []


def test_every_load_occurs_in_the_random_systems() -> None:
    assert set(concrete(Load)) <= {type(load) for system in systems() for load in system.loads}


def test_every_element_occurs_in_the_random_systems_or_their_own_laws() -> None:
    drawn_ones = {load.kind for system in systems() for load in system.loads if isinstance(load, Element)}
    made = {name for name, hint in returned(multibody).items() if hint is Element}
    assert made <= drawn_ones | {*MADE}
    assert made <= set(symbody.__all__)


def returned(module: object) -> dict[str, object]:
    """What the public functions of a module return, by their names."""
    public = {name: getattr(module, name) for name in module.__all__}  # type: ignore[attr-defined]
    functions_alone = {name: f for name, f in public.items() if inspect.isfunction(f)}
    return {name: typing.get_type_hints(f).get("return") for name, f in functions_alone.items()}


def test_every_load_has_components_in_any_frame() -> None:
    """Those of its actions follow where it is projected, and `show` prints its fields."""
    axes = rotate("X", symbols("tilt")).named("axes")
    for load in {type(load): load for system in systems() for load in system.loads}.values():
        moved = project(load, axes)
        assert type(moved) is type(load)
        assert {action.vector.frame for action in moved.actions} == {axes}
        for one, two in zip(load.actions, moved.actions, strict=True):
            assert two.vector.components == project(one.vector, axes).components
        if "ends = [" not in describe(load):  # a spring is shown by its ends, wherever it is projected
            assert "comps = [" in describe(load)
            assert "frame = axes" in describe(moved, synthetic=True)


def test_every_formalism_is_held_against_the_others() -> None:
    public = [getattr(dynamics, name) for name in dynamics.__all__]
    hints = {f: typing.get_type_hints(f) for f in public if callable(f)}
    formalisms = {
        f for f, hint in hints.items() if (hint.get("system"), hint.get("return")) == (System, Equations)
    }
    assert formalisms
    for tested in (test_formalisms, test_textbook_forms, test_robots):
        assert formalisms == set(tested.FORMALISMS), tested.__name__


def test_every_function_obeys_the_laws() -> None:
    """The laws name it, or import it (and the lints see to it that what is imported is used)."""
    assert set(functions.__all__) <= {*test_rewrites.ONE_ARGUMENT, *vars(test_rewrites)}


@pytest.fixture(params=METHODS)
def each_method(request: pytest.FixtureRequest) -> str:
    """Each method by name: in the copy also that of the recipe."""
    name: str = request.param
    if name.startswith("ida") and not find_spec("sksundae"):
        pytest.skip("SUNDIALS is an extra: scikit-sundae")
    return name


def test_every_method_integrates_one_motion_and_many(each_method: str) -> None:
    x = functions_of_time("x")
    body = Body(translate(x, 0, 0), 1)
    spring = symbody.Force(symbody.ground, -x, 0, 0, on=body, at=body.center_of_mass)
    equations = newton_euler(System([body], [spring], [x]))
    t = np.linspace(0, 2, 5)
    given = {"method": each_method, "rtol": 1e-7, "atol": 1e-9, "max_step": 1e-3}
    one = simulate(equations, {}, {x: 1}, t, **given)[x]
    np.testing.assert_allclose(one, np.cos(t), atol=1e-4)
    many = simulate_many(equations, {}, {x: [1, 2]}, t, **given)[x]
    np.testing.assert_allclose(many, np.outer([1, 2], np.cos(t)), atol=2e-4)


def damped() -> System:
    """A mass between a spring and a damper, released at x = 1: x = exp(-t/10) (cos(w t) + sin(w t)/(10 w))."""
    x = functions_of_time("x")
    mass = Body(translate(x, 0, 0), 1)
    force = symbody.Force(symbody.ground, -x - time_derivative(x) / 5, 0, 0, on=mass, at=mass.center_of_mass)
    return System([mass], [force], [x])


def test_every_method_takes_a_damper(each_method: str) -> None:
    """The work of the damper is integrated, or its absence is an error."""
    system = damped()
    (x,) = system.coordinates
    t = np.linspace(0, 3, 31)
    motion = simulate(newton_euler(system), {}, {x: 1}, t, method=each_method, max_step=1e-3)
    w = np.sqrt(0.99)
    np.testing.assert_allclose(
        motion[x], np.exp(-t / 10) * (np.cos(w * t) + 0.1 / w * np.sin(w * t)), atol=1e-3
    )
    if METHODS[each_method].integrates_work:
        assert motion.energy_drift < 2e-3
    else:
        with pytest.raises(ModelError, match=f"'{each_method}'.* don't integrate; use another method"):
            _ = motion.energy


def test_every_method_locates_events_or_refuses_them(each_method: str) -> None:
    system = damped()
    (x,) = system.coordinates
    events = [symbody.Event(x, terminal=True)]
    equations = newton_euler(system)
    if METHODS[each_method].locates_events:
        motion = simulate(equations, {}, {x: 1}, (0, 3), method=each_method, events=events)
        w = np.sqrt(0.99)
        assert motion.t[-1] == pytest.approx((np.pi - np.arctan(w / 0.1)) / w, abs=1e-5)
        return
    message = (
        f"simulate, events: method={each_method!r} doesn't locate events; leave them out, or use a method that does: "
        "'dop853', 'tsit5', 'bdf', 'esdirk34', 'tr_bdf2', 'ida', 'ida2' and 'ida3'"
    )
    with pytest.raises(SimulationError, match=f"^{re.escape(message)}$"):
        simulate(equations, {}, {x: 1}, (0, 3), method=each_method, events=events)


def test_every_method_enforces_constraints_or_refuses_them(each_method: str) -> None:
    """A point on a circle, without gravity: it turns at a constant rate."""
    x, y = functions_of_time("x y")
    circle = System([Body(translate(x, y, 0), 1)], coordinates=[x, y], constraints=[x**2 + y**2 - 1])
    equations, start = newton_euler(circle), {x: 1, time_derivative(y): 1}
    given = {"method": each_method, "max_step": 1e-3}
    t = np.linspace(0, 2, 21)
    np.testing.assert_allclose(
        simulate(equations, {}, start, t, constraints="baumgarte", **given)[x], np.cos(t), atol=5e-3
    )
    if METHODS[each_method].enforces_constraints:
        np.testing.assert_allclose(simulate(equations, {}, start, t, **given)[x], np.cos(t), atol=1e-4)
        return
    message = (
        f"simulate: method={each_method!r} doesn't enforce constraints by itself; use constraints='baumgarte', or a "
        "method that does: 'dop853', 'tsit5', 'bdf', 'esdirk34', 'tr_bdf2', 'ida', 'ida2' and 'ida3'"
    )
    with pytest.raises(SimulationError, match=f"^{re.escape(message)}$"):
        simulate(equations, {}, start, t, **given)


def test_every_method_reports_a_motion_that_goes_to_infinity(each_method: str) -> None:
    """x = 1/(1 - t)^2: what was computed is kept."""
    x = functions_of_time("x")
    mass = Body(translate(x, 0, 0), 1)
    push = symbody.Force(symbody.ground, 6 * x**2, 0, 0, on=mass, at=mass.center_of_mass)
    equations = newton_euler(System([mass], [push], [x]))
    with pytest.raises(SimulationError, match="what was computed is the error's motion") as raised:
        simulate(equations, {}, {x: 1, time_derivative(x): 2}, (0, 2), method=each_method, max_step=1e-3)
    motion = raised.value.motion
    assert motion.t[-1] == pytest.approx(1, abs=0.02)
    assert np.isfinite(motion.states).all()


def test_every_method_can_be_interrupted_within_a_motion(each_method: str) -> None:
    """What was computed is kept, and the next motion is not started."""
    model, instants = model_of(newton_euler(damped())), np.array([0.0, 2e4])
    task = Task(
        model,
        instants,
        Options(each_method, max_step=1e-3),
        METHODS[each_method],
        "projection",
        {},
        (),
        {},
    )
    for motions in (1, 2):
        done: list[float] = []

        def keep_going(so_far: float, done: list[float] = done) -> bool:
            done.append(so_far)
            return len(done) < 3

        states = np.repeat([[1.0, *[0.0] * (model.width - 1)]], motions, axis=0)
        first, *others = task.integrate({}, states, 1, keep_going)
        assert first is not None
        assert first.failure is not None
        assert first.failure.kind is FailureKind.INTERRUPTED
        assert 0 <= first.end[0] < 2e4
        assert len(first.states) == 1
        assert others == [None] * (motions - 1)
        assert done[2] < 1


@pytest.mark.parametrize("method", METHODS)
def test_every_method_is_documented(method: str) -> None:
    page = Path(__file__).parents[1] / "docs" / "simulation.md"
    assert f'"{method}"' in (simulate.__doc__ or "")
    assert f'"{method}"' in page.read_text(encoding="utf-8")


def test_all_of_these_are_public() -> None:
    loads = {load.__name__ for load in concrete(Load)}
    formalisms = {formalism.__name__ for formalism in test_formalisms.FORMALISMS}
    assert {*functions.__all__, *loads, *formalisms} <= set(symbody.__all__)
