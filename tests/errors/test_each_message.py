"""Each error and notice of joints, elements, loads and reactions has a case whose whole message is compared.

The cases are the tables of this folder's rooms. The statements that raise or notify are read from the sources: a new
one without a case fails here.
"""

from __future__ import annotations

import ast
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import symbody
from symbody import SymbodyError
from tests.errors.dynamics import test_reaction
from tests.errors.multibody import (
    test_body,
    test_element,
    test_element_values,
    test_joint,
    test_joint_values,
    test_mechanism,
    test_notices,
    test_tire,
    test_tire_file,
)

ROOT = Path(symbody.__file__).parent
SOURCES = (
    *sorted(ROOT.glob("multibody/joint/*.py")),
    *sorted(ROOT.glob("multibody/element/*.py")),
    *(ROOT / "multibody" / f"{name}.py" for name in ("body", "combined", "displaced", "load", "resultant")),
    ROOT / "dynamics" / "formalism" / "reaction.py",
    ROOT / "dynamics" / "formalism" / "idle_joint.py",
)
TABLES = (
    test_body.MISTAKES,
    test_element.MISTAKES,
    test_element_values.MISTAKES,
    test_joint.MISTAKES,
    test_joint_values.MISTAKES,
    test_mechanism.MISTAKES,
    test_notices.NOTICES,
    test_reaction.MISTAKES,
    test_tire.MISTAKES,
    test_tire_file.MISTAKES,
)
Place = tuple[Path, int]


def statements() -> Iterator[tuple[Path, int, int]]:
    """Yield the statements that raise or notify: the file, the first and the last line."""
    for path in SOURCES:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.stmt) and (raises(node) or notifies(node)):
                yield path, node.lineno, node.end_lineno or node.lineno


def raises(node: ast.stmt) -> bool:
    return isinstance(node, ast.Raise) and node.exc is not None


def notifies(node: ast.stmt) -> bool:
    call = node.value if isinstance(node, ast.Expr) else None
    return isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "notify"


def mistakes() -> Iterator[Callable[[], object]]:
    for table in TABLES:
        for case in table:
            yield from (part for part in case if callable(part) and not isinstance(part, type))


def lines_of(fault: BaseException | None) -> Iterator[Place]:
    """Yield the lines through which an error came, and those of the errors that it replaces."""
    if fault is None:
        return
    trace = fault.__traceback__
    while trace is not None:
        yield Path(trace.tb_frame.f_code.co_filename), trace.tb_lineno
        trace = trace.tb_next
    yield from lines_of(fault.__context__)


def calls() -> Iterator[Place]:
    """Yield the lines of the calls that are being made."""
    frame = sys._getframe()
    while frame is not None:
        yield Path(frame.f_code.co_filename), frame.f_lineno
        frame = frame.f_back


def reached(cases: Iterable[Callable[[], object]]) -> set[Place]:
    found: set[Place] = set()
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        warnings.showwarning = lambda *told, **more: found.update(calls())
        for case in cases:
            try:
                case()
            except SymbodyError as fault:
                found.update(lines_of(fault))
    return found


def test_each_message_has_a_case_that_compares_the_whole_of_it() -> None:
    places = reached(mistakes())
    missing = [
        f"{path.relative_to(ROOT)}, line {first}"
        for path, first, last in statements()
        if not any((path, line) in places for line in range(first, last + 1))
    ]
    assert missing == []
