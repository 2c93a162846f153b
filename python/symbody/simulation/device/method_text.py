"""The stages of an explicit method as CUDA C, written out: the coefficients are those of the native integrator."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.simulation.integrate.problem import Tableau

__all__ = ["method_constants", "method_text"]

_HERMITE = 3
"""The number of terms of the dense output that form its cubic Hermite polynomial."""


def method_constants(tableau: Tableau) -> dict[str, object]:
    """Return the numbers by which the loop knows a method."""
    return {
        "ORDER": tableau.order,
        "STAGES": tableau.stages,
        "ROWS": len(tableau.c),
        "EVALUATES_END": int(tableau.evaluates_end),
        "STABILITY": tableau.stability,
        "ESTIMATES": len(tableau.errors),
        "TERMS": _HERMITE + len(tableau.dense),
    }


def method_text(tableau: Tableau) -> str:
    """Return the functions `take_stages`, `add_stages` and `add_terms` of the loop."""
    return "\n".join([_take_stages(tableau), _add_stages(tableau), _add_terms(tableau)])


def _take_stages(tableau: Tableau) -> str:
    lines: list[str] = []
    for stage in range(1, tableau.stages):
        lines += [
            _assigned("y[i]", "x", tableau.a[stage]),
            f"    evaluate(lane, lane->t + {_times_h(tableau.c[stage])}, y, lane->k[{stage}]);",
        ]
    lines += [
        "    EACH(i, WIDTH) lane->last_stage[i] = y[i];",
        _assigned("lane->after[i]", "x", tableau.a[tableau.stages]),
    ]
    if tableau.evaluates_end:
        lines += [f"    evaluate(lane, lane->t + h, lane->after, lane->k[{tableau.stages}]);"]
    lines += [_summed(f"errors[{number}][i]", row) for number, row in enumerate(tableau.errors)]
    title = "static __device__ void take_stages(Lane *lane, double h, double errors[ESTIMATES][WIDTH])"
    return _function(title, ["    double y[WIDTH];", *lines])


def _add_stages(tableau: Tableau) -> str:
    end = tableau.stages
    lines = [
        "    const double t = lane->last_t, h = lane->last_h;",
        "    double y[WIDTH];",
        "    EACH(i, WIDTH) y[i] = lane->after[i];",
        f"    evaluate_dense(lane, t + h, y, lane->k[{end}]);",
    ]
    for stage in range(end + 1, len(tableau.c)):
        lines += [
            _assigned("y[i]", "before", tableau.a[stage]),
            f"    evaluate_dense(lane, t + {_times_h(tableau.c[stage])}, y, lane->k[{stage}]);",
        ]
    return _function("static __device__ void add_stages(Lane *lane)", lines)


def _add_terms(tableau: Tableau) -> str:
    lines = [
        _summed(f"dense[{number}][i]", row, "h*({})") for number, row in enumerate(tableau.dense, _HERMITE)
    ]
    title = "static __device__ void add_terms(const Lane *lane, double h, double dense[TERMS][WIDTH])"
    return _function(title, lines)


def _function(title: str, lines: Sequence[str]) -> str:
    return "\n".join([title, "{", *lines, "}", ""])


def _times_h(part: float) -> str:
    return f"{part!r}*h"


def _assigned(place: str, base: str, row: Sequence[tuple[int, float]]) -> str:
    return _summed(place, row, f"lane->{base}[i] + h*({{}})")


def _summed(place: str, row: Sequence[tuple[int, float]], form: str = "{}") -> str:
    """Return the loop that assigns a weighted sum of the rates at stages, term after term."""
    terms = [f"{'-' if weight < 0 else '+'} {abs(weight)!r}*lane->k[{stage}][i]" for stage, weight in row]
    lines = [" ".join(terms[start : start + 3]) for start in range(0, len(terms), 3)]
    first = ("-" if row[0][1] < 0 else "") + lines[0][2:]
    value = form.format("\n            ".join([first, *lines[1:]]))
    return f"    EACH(i, WIDTH)\n        {place} = {value};"
