"""Names of quantities by their dimension: w1 for an angular velocity, f1 for a force, n1 for a torque."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from typing import NamedTuple

from symbody.multibody.quantity.dimension import Dimension


class Kind(NamedTuple):
    """A kind of quantities.

    Attributes:
        letters: the letters to choose from; the first one is used that the model doesn't use.
        plural: what the quantities are called.
    """

    letters: tuple[str, ...]
    plural: str


_KINDS: dict[Dimension, Kind] = {
    (0, 0, 0): Kind(("R", "Q"), "direction cosines"),
    (0, 1, 0): Kind(("d", "e", "s"), "lengths"),
    (1, 1, 0): Kind(("S", "Y"), "masses times lengths"),
    (1, 2, 0): Kind(("J", "Theta"), "moments of inertia"),
    (1, 0, 0): Kind(("mu", "M", "mass"), "masses"),
    (0, 0, -1): Kind(("w", "omega", "Omega"), "angular velocities"),
    (0, 1, -1): Kind(("v", "V"), "velocities"),
    (1, 1, -1): Kind(("p", "P"), "momenta"),
    (1, 2, -1): Kind(("h", "H", "L"), "angular momenta"),
    (1, 0, -1): Kind(("c", "C", "b"), "forces per velocity"),
    (0, 0, -2): Kind(("alpha", "epsilon", "eps"), "angular accelerations"),
    (0, 1, -2): Kind(("a", "A", "acc"), "accelerations"),
    (1, 0, -2): Kind(("k", "K", "kappa"), "forces per length"),
    (1, 1, -2): Kind(("f", "F", "force"), "forces"),
    (1, 2, -2): Kind(("n", "N", "torque"), "torques"),
}
"""Kinds by dimension, in the order in which the equations are derived: outwards from the ground, and back."""

_PRODUCTS = Kind(("W", "Q", "prod"), "products of angular velocities")
_OTHER = Kind(("z", "r", "y", "other"), "other quantities")


def kind_of(dimension: Dimension | None, *, has_accelerations: bool = True) -> Kind:
    """Return the kind of the quantities of a dimension.

    Args:
        dimension: the exponents of mass, length and time; None if they are not known.
        has_accelerations: whether the quantity depends on accelerations; squares of angular velocities don't.

    >>> kind_of((1, 1, -2)).plural, kind_of(None).plural
    ('forces', 'other quantities')
    >>> kind_of((0, 0, -2)).plural, kind_of((0, 0, -2), has_accelerations=False).plural
    ('angular accelerations', 'products of angular velocities')
    """
    if dimension == _OF_ANGLES and not has_accelerations:
        return _PRODUCTS
    return _OTHER if dimension is None else _KINDS.get(dimension, _OTHER)


_OF_ANGLES: Dimension = (0, 0, -2)


def stage_of(dimension: Dimension | None) -> int:
    """Return the place of a kind in the order of derivation: positions, velocities, accelerations, forces.

    >>> stage_of((0, 1, -1)) < stage_of((0, 0, -2)) < stage_of((1, 2, -2)) <= stage_of(None)
    True
    """
    if dimension is None or (dimension[0] and dimension[2]):
        return 3
    return -dimension[2]


def legend(
    kinds: Collection[Kind], taken: Collection[str], *, has_gravity: bool = False
) -> list[tuple[str, str]]:
    """Return the letters and their meanings; nothing if no kind is known.

    Args:
        kinds: the kinds of the quantities.
        taken: stems of the names of the model.
        has_gravity: whether the acceleration of gravity is subtracted from accelerations.

    >>> legend({kind_of((1, 2, -2)), kind_of((1, 1, -2))}, {"f"})
    [('F', 'forces'), ('n', 'torques')]
    >>> legend({kind_of((0, 1, -2))}, {}, has_gravity=True)
    [('a', 'accelerations less that of gravity')]
    >>> legend({kind_of(None)}, {})
    []
    """
    known = [kind for kind in (*_KINDS.values(), _PRODUCTS, _OTHER) if kind in kinds]
    if known == [_OTHER]:
        return []
    less = " less that of gravity" if has_gravity else ""
    return [(_letter(kind, taken), kind.plural + less * (kind == _KINDS[_OF_POINTS])) for kind in known]


_OF_POINTS: Dimension = (0, 1, -2)


def names_of(kinds: Sequence[Kind], taken: Collection[str]) -> list[str]:
    """Return a name for each quantity; those of a kind are numbered.

    Args:
        kinds: the kinds of the quantities.
        taken: stems of the names of the model.

    >>> names_of([kind_of((0, 0, -1)), kind_of((1, 2, -2)), kind_of((0, 0, -1))], {"n"})
    ['w1', 'N1', 'w2']
    """
    counts, names = Counter[Kind](), list[str]()
    for kind in kinds:
        counts[kind] += 1
        names.append(f"{_letter(kind, taken)}{counts[kind]}")
    return names


def _letter(kind: Kind, taken: Collection[str]) -> str:
    return next((each for each in kind.letters if each not in taken), f"{kind.letters[0]}__")
