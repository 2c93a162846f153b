"""The trifilar pendulum is integrated: the cells of docs/worksheets.md, at the end of the seed."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.run import outcomes
from symbody.worksheet.values.value import Listed
from tests.worksheets.test_seeds import FOLDERS, TRIFILAR, ran

PAGE = Path(__file__).parents[2] / "docs" / "worksheets.md"


@pytest.fixture(scope="module")
def interpreter(tmp_path_factory: pytest.TempPathFactory) -> Interpreter:
    """The session of the seed and the cells behind it."""
    ran(TRIFILAR)  # which says so if the seeds are missing
    cells = PAGE.read_text(encoding="utf-8").partition("## Beyond the last cell")[2].split("```")[1]
    seed = (FOLDERS[0] / f"{TRIFILAR}.txt").read_text(encoding="utf-8")
    interpreter = Interpreter()
    interpreter.session.folder = tmp_path_factory.mktemp("trifilar")
    found = outcomes(source_cells(seed + "\n\n" + cells.removeprefix("text")), interpreter)
    assert [each.error for each in found if each.error] == []
    return interpreter


def values(interpreter: Interpreter, name: str) -> list[float]:
    """Return the numbers of a list."""
    value = interpreter.session.names[name]
    assert isinstance(value, Listed)
    return [float(item) for item in value.items]  # type: ignore[arg-type]


def test_small_oscillations_have_the_period_of_a_simple_pendulum(interpreter: Interpreter) -> None:
    R, yaw = 0.6 / math.sqrt(3), 0.05
    y, z = values(interpreter, "quarter")
    assert abs(y) < 0.002 * R * yaw
    assert abs(z) < 1e-7
    y, z = values(interpreter, "half")
    assert y == pytest.approx(R * math.sin(yaw), rel=1e-4)
    assert z == pytest.approx(1 - math.sqrt(1 - 4 * R**2 * math.sin(yaw / 2) ** 2), rel=1e-3)
