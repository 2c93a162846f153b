"""Equations without redundant constraints: those that remain keep the others."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import lru_cache

from symbody.multibody import Variables
from symbody.multibody.variables import Borne

from .equations import Assembly, Derived, Equations


def leaving_out(eqs: Equations, places: Collection[int], borne: Borne) -> Equations:
    """Return the equations without some constraints, which follow from the others: ``M u' = f + A^T lambda``.

    A and lambda lose rows; M and f stay, and the motion is the same. How rigid bodies share a load among redundant
    constraints is not determined: `multibody/shared_multiplier.py` shares it [Garcia de Jalon & Gutierrez-Lopez 2013].

    Args:
        eqs: the equations of motion.
        places: the places of these constraints among all.
        borne: the function of the system that returns what they share.
    """
    return _leaving_out(eqs, tuple(sorted(places)), borne)


@lru_cache(maxsize=64)
def _leaving_out(eqs: Equations, places: tuple[int, ...], borne: Borne) -> Equations:
    system = eqs.system.leaving_out(places, borne)
    return replace(
        eqs,
        system=system,
        derive=Derived(system.without_left_out(eqs.derived_residuals)),
        assemble=_Inherited(eqs),
    )


@dataclass(frozen=True, eq=False)
class _Inherited:
    """The assembly of equations with more constraints: it is derived once for both."""

    whole: Equations

    def __call__(self, system: Variables) -> Assembly:
        whole = self.whole
        n = whole.mass_matrix.rows
        entries = system.without_left_out((*whole.mass_matrix.entries, *whole.bias))
        return Assembly(type(whole.mass_matrix).from_entries(n, n, entries[: n * n]), entries[n * n :])
