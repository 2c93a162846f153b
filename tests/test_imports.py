"""What ``import symbody`` loads: the language of models; what computes numbers is loaded with its first use."""

from __future__ import annotations

import pickle
import subprocess
import sys
import textwrap
from importlib.metadata import version
from pathlib import Path

import pytest

import symbody
from symbody import codegen, simulation, view
from tests.type_check import ROOT, checked_types

MODELS = "deferred dynamics errors geometry multibody symbolic"
CODEGEN = "codegen deferred dynamics errors files geometry multibody symbolic"

LOADED = """
import sys
before = {name.partition(".")[0] for name in sys.modules} | sys.stdlib_module_names
%s
packages = {name.partition(".")[0] for name in sys.modules} - before
layers = {name.split(".")[1] for name in sys.modules if name.startswith("symbody.")}
print(*sorted(packages), "|", *sorted(layers))
"""


def in_a_new_process(code: str, *options: str) -> str:
    command = [sys.executable, *options, "-c", textwrap.dedent(code)]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


@pytest.mark.parametrize(
    ("code", "loaded"),
    [
        ("import symbody", "symbody |"),
        ("import symbody; dir(symbody)", "symbody |"),
        ("import symbody; symbody.__version__", "symbody |"),
        ("import symbody; hasattr(symbody, 'simulat')", "symbody | deferred errors symbolic"),
        ("from symbody import Matrix, rotate", "symbody | deferred errors geometry symbolic"),
        ("from symbody import Body, Matrix, newton_euler", f"symbody | {MODELS}"),
        ("import symbody; symbody.parse('x + y')", "lark symbody | deferred errors symbolic"),
        ("from symbody import generate, lambdify", f"llvmlite numpy symbody | {CODEGEN}"),
        (
            "import symbody.codegen as codegen",
            "llvmlite numpy symbody | codegen deferred errors files symbolic",
        ),
    ],
)
def test_modules(code: str, loaded: str) -> None:
    assert in_a_new_process(LOADED % code) == loaded


def test_equations_of_particles_need_no_numbers() -> None:
    code = """
from symbody import Body, System, functions_of_time, newton_euler, translate
x = functions_of_time("x")
assert newton_euler(System([Body(translate(x, 0, 0), 1)], coordinates=[x])).residuals
"""
    assert in_a_new_process(LOADED % code) == f"symbody | {MODELS}"


def test_numbers_are_loaded_with_their_first_use() -> None:
    """A motion is computed without what fits splines, finds eigenvalues or draws."""
    packages, _, layers = in_a_new_process(
        LOADED
        % """
from symbody import Body, System, functions_of_time, newton_euler, simulate, translate
x = functions_of_time("x")
assert simulate(newton_euler(System([Body(translate(x, 0, 0), 1)], coordinates=[x])), {}, {x: 1}, t=(0, 1))
"""
    ).partition(" | ")
    assert layers == "codegen deferred dynamics errors files geometry multibody simulation symbolic"
    assert not {"scipy", "matplotlib", "lark", "rich", "sympy"} & set(packages.split())


def test_the_version_is_printed_without_the_layers() -> None:
    code = LOADED.replace("%s", "from symbody.__main__ import main; main(['--version'])")
    version_line, loaded = in_a_new_process(code).splitlines()
    assert (version_line, loaded) == (f"symbody {version('symbody')}", "symbody | __main__")


@pytest.mark.parametrize(
    "sheet",
    ["x := 1;", "with(MBSymba_r6): show(velocity(origin(translate(x(t), 0, 0) * rotate('Z', q(t)))));"],
)
def test_a_sheet_loads_what_it_needs(sheet: str, tmp_path: Path) -> None:
    """No numbers, no drawings, no second reader: a start in less than half a second depends on it."""
    (tmp_path / "sheet.mpl").write_text(sheet)
    run = f"from symbody.__main__ import main; assert main(['run', {str(tmp_path / 'sheet.mpl')!r}]) == 0"
    run += "; assert 'symbody.worksheet.check' not in sys.modules"
    packages, _, layers = in_a_new_process(LOADED % run).splitlines()[-1].partition(" | ")
    assert packages == "lark symbody"
    assert not {"codegen", "document", "models", "simulation", "view"} & set(layers.split())


def test_a_motion_finds_what_draws_it(tmp_path: Path) -> None:
    """Also where nobody has imported the package itself."""
    page = in_a_new_process(
        f"""
        from symbody.dynamics import newton_euler
        from symbody.geometry import translate
        from symbody.multibody import Body, System
        from symbody.simulation import simulate
        from symbody.symbolic import functions_of_time
        x = functions_of_time("x")
        equations = newton_euler(System([Body(translate(x, 0, 0), 1)], coordinates=[x]))
        print(simulate(equations, {{}}, {{x: 1}}, t=(0, 1)).animate({str(tmp_path / "page.html")!r}))
        """
    )
    assert Path(page).exists()


def test_public_names_are_those_of_the_layers() -> None:
    assert all(getattr(symbody, name) is not None for name in symbody.__all__)
    for layer in (codegen, simulation):
        shared = set(layer.__all__) & set(symbody.__all__)
        assert shared
        assert all(getattr(symbody, name) is getattr(layer, name) for name in shared)


def test_layers_are_attributes() -> None:
    assert (
        in_a_new_process(
            """
        import symbody
        print(symbody.simulation.simulate is symbody.simulate, symbody.codegen.TARGETS["c"].title, symbody.view.Box)
        """
        )
        == f"True C99 {view.Box}"
    )


def test_names_are_listed_before_they_are_loaded() -> None:
    listed = in_a_new_process("import symbody; print(*dir(symbody))").split()
    assert {*symbody.__all__, "codegen", "simulation", "view", "__version__"} <= set(listed)


def test_a_name_that_does_not_exist() -> None:
    with pytest.raises(AttributeError, match="symbody has no 'simulat'"):
        symbody.simulat  # noqa: B018
    with pytest.raises(ImportError, match="cannot import name 'simulat' from 'symbody'"):
        from symbody import simulat  # noqa: F401, PLC0415


def test_all_names_at_once() -> None:
    code = "from symbody import *; print(simulate.__module__, lambdify.__module__)"
    assert in_a_new_process(code) == "symbody.simulation.motion.simulate symbody.codegen.machine.lambdify"


def test_names_survive_a_pickle() -> None:
    names = [name for name in symbody.__all__ if callable(getattr(symbody, name))]
    for name in names:
        assert pickle.loads(pickle.dumps(getattr(symbody, name))) is getattr(symbody, name), name
    assert "simulate" in names


def test_version() -> None:
    assert symbody.__version__ == version("symbody")


@pytest.mark.slow
def test_type_checkers_know_the_names(tmp_path: Path) -> None:
    """And no others: a module with ``__getattr__`` would have them all."""
    assert Path(symbody.__file__).with_name("py.typed").exists()  # which lets them read an installed package
    (tmp_path / "user.py").write_text(
        "import symbody as sb\nreveal_type(sb.grid)\nreveal_type(sb.__version__)\nsb.simulat\n"
    )
    done = checked_types(ROOT, tmp_path, "-m", "user", mypy_path=str(tmp_path))
    first, second, third, *_ = done.stdout.splitlines()
    assert "def (" in first
    assert 'is "str"' in second or 'is "builtins.str"' in second
    assert 'Module has no attribute "simulat"' in third
