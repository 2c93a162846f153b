"""A formalism derives by itself: what is derived around it changes nothing."""

from __future__ import annotations

import pytest

from symbody import Expr, System, cos, cost, kinetic_energy, lagrange_equations, newton_euler, sin, symbols
from symbody.symbolic import current_derivation, derivation
from tests.laws.random_system import random_system
from tests.repeated import repeated

a, b = symbols("a b")


def derived(formalism: type, system: System) -> tuple[list[str], object]:
    equations = formalism(system)
    entries: tuple[Expr, ...] = (*equations.residuals, *equations.mass_matrix.entries, *equations.bias)
    return [str(entry) for entry in entries], cost(*entries)


@pytest.mark.parametrize("formalism", [newton_euler, lagrange_equations])
@pytest.mark.parametrize("seed", [0, 1, 2, *repeated([3, 4, 5])])
def test_a_formalism_inside_a_derivation(formalism: type, seed: int) -> None:
    system = random_system(seed)
    alone = derived(formalism, system)
    with derivation():
        kinetic_energy(system)  # forms that a formalism which joined in would take
        assert derived(formalism, system) == alone


def test_the_outer_derivation_goes_on() -> None:
    with derivation() as outer:
        square = cos(b) ** 2
        with derivation(fresh=True) as inner:
            assert current_derivation() is inner
            assert not (1 - sin(b) ** 2).same_form(square)
        assert current_derivation() is outer
        assert (1 - sin(b) ** 2).same_form(square)
        with pytest.raises(ZeroDivisionError), derivation(fresh=True):
            a / (b - b)
        assert current_derivation() is outer
    assert current_derivation() is None
