"""The tables of the scan, as Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from .scan import BOUND, MECHANISMS, Loss, Passages

TEXT = """\
# The scan of singular positions

Written by `python -m benchmarks.singular.run`. Mechanisms swing for ten seconds under their weight, with many initial
speeds of the first crank. Each motion passes some ten singular positions. No times are measured. A motion has
*passed* if it reached its end less than 0.01 rad or m off its branch, which is known in closed form. The energy lost
is the largest deviation from the initial energy, relative to the largest energy that moves. It is compared with the
loss of a single bar that swings with the same speeds, at the same tolerance.
[Singular positions](../singular_positions.md) are explained on their own page.

![Energy lost over the tolerance](singular.svg)

Solid lines: the largest loss of all motions. Dotted lines: the median.

## Explicit methods with projection

| mechanism | method | rtol | passed | lost: median | largest | a bar's | largest / bar's | bound | met |
|---|---|---|---|---|---|---|---|---|---|
{losses}

## Other methods and options

Four mechanisms, with five initial speeds and two tolerances (1e-4, 1e-7) each, over five seconds. Only two instants
are requested: the beginning and the end. A motion is *wrong* if it is off its branch, or has lost more than ten times
the energy that a single bar loses with the same method.

| method | constraints | passed, nothing to report | with a notice | ended in an error | wrong without a report |
|---|---|---|---|---|---|
{others}
"""


def written(found: Sequence[Loss], reported: Iterable[Passages]) -> str:
    """Return the report."""
    return TEXT.format(losses="\n".join(map(_row, found)), others="\n".join(map(_other, reported)))


def _row(loss: Loss) -> str:
    ratio = loss.largest / loss.regular
    is_met = loss.passed == loss.motions and ratio <= BOUND
    return (
        f"| {MECHANISMS[loss.name]} | {loss.method} | {loss.rtol:.0e} | {loss.passed} of {loss.motions} | "
        f"{loss.median:.0e} | {loss.largest:.0e} | {loss.regular:.0e} | {ratio:.2g} | ≤ {BOUND:g} | "
        f"{'yes' if is_met else '**no**'} |"
    )


def _other(reported: Passages) -> str:
    kinds = reported.kinds
    return (
        f"| {reported.method} | {reported.constraints} | {kinds['passed']} | {kinds['noticed']} | {kinds['ended']} | "
        f"{kinds['silent']} |"
    )
