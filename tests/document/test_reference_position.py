"""The position in which a report draws a mechanism satisfies its loops."""

from __future__ import annotations

from symbody import embedded, models, newton_euler
from symbody.document.reference_position import still
from symbody.document.subject import Subject


def test_embedded_equations_are_drawn_with_closed_loops() -> None:
    """The constraints are those of the equations from which they follow."""
    equations = newton_euler(models.slider_crank().system)
    motion = still(Subject(embedded(equations), None, {}, {}, {}))
    assert abs(motion.evaluate(list(equations.constraints))).max() < 1e-10
