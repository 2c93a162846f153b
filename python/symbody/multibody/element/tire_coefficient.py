"""The coefficients of the Magic Formula, by the names of tyre property files."""

from __future__ import annotations

from collections.abc import Mapping

from symbody.geometry import Scalar
from symbody.symbolic import Expr, number
from symbody.symbolic.given.arguments import brief

__all__ = [
    "BY_SPEED",
    "COEFFICIENTS",
    "DEFAULTS",
    "DIVISORS",
    "EXCLUDED",
    "IGNORED",
    "NEEDED",
    "POSITIVE",
    "SCALES",
    "left_out",
    "of_other_set",
]


def _series(**last: int) -> frozenset[str]:
    """Return ``PCX1, PDX1, PDX2, ...``, up to the last number of each series."""
    return frozenset(f"{name}{k}" for name, count in last.items() for k in range(1, count + 1))


EXCLUDED = frozenset({"QDZ5", "QBZ7", "QBZ8"})
"""Coefficients that the sets 5.2 to 6.2 don't have; they must be zero."""

COEFFICIENTS = (
    frozenset({"FNOMIN", "UNLOADED_RADIUS", "NOMPRES", "INFLPRES", "LONGVL", "LMUV"})
    | _series(PPX=4, PPY=5, PPZ=2, PPMX=1)
    | _series(PCX=1, PDX=3, PEX=4, PKX=3, PHX=2, PVX=2, RBX=3, RCX=1, REX=2, RHX=1, PTX=3)
    | _series(PCY=1, PDY=3, PEY=5, PKY=7, PHY=3, PVY=4, RBY=4, RCY=1, REY=2, RHY=2, RVY=6, PTY=2)
    | _series(QSX=14, QSY=8, QBZ=10, QCZ=1, QDZ=11, QEZ=5, QHZ=4, SSZ=4)
) - EXCLUDED
"""What the law is made of."""

SCALES = frozenset(
    {
        *(
            "LFZO",
            "LCX",
            "LMUX",
            "LEX",
            "LKX",
            "LHX",
            "LVX",
            "LCY",
            "LMUY",
            "LEY",
            "LKY",
            "LHY",
            "LVY",
            "LKYC",
        ),
        *("LSGKP", "LSGAL", "LTR", "LRES", "LXAL", "LYKA", "LVYKA", "LS", "LKZC", "LMX", "LVMX", "LMY"),
    }
)
"""Factors that scale the effects of coefficients; one by default."""

DEFAULTS: dict[str, Expr] = {name: number(0) for name in COEFFICIENTS}
"""The values of coefficients that are left out. Set 5.2 has no PKY4, which is 2 there, and no QSY7, which is 1."""
DEFAULTS |= {name: number(1) for name in (*SCALES, "NOMPRES", "INFLPRES", "LONGVL", "QSY7")} | {
    "PKY4": number(2)
}

TURN_SLIP = _series(PDXP=3, PKYP=1, PDYP=4, PHYP=4, PECP=2, QDTP=1, QCRP=2, QBRP=1, QDRP=2)
"""The coefficients of turn slip, which is no part of the law: they matter where a tyre turns about a point nearby."""

_CAMBER_SCALES = frozenset({"LGAX", "LGAY", "LGAZ"})
"""The factors of the camber in sets before 5.2; one has no effect."""

IGNORED = (
    TURN_SLIP
    | _CAMBER_SCALES
    | {
        *("VXLOW", "WIDTH", "ASPECT_RATIO", "RIM_RADIUS", "RIM_WIDTH"),
        *("VERTICAL_STIFFNESS", "VERTICAL_DAMPING", "BREFF", "DREFF", "FREFF"),
    }
)
"""What tyre property files hold beside the law: turn slip, sizes, stiffness."""


_OF_SETS = {"5.2": ("PKY6", "PKY7", "PPY5"), "6.1": ("PHY3",)}
"""By version, the coefficients that only the other set has."""


def of_other_set(given: Mapping[str, Expr], version: str) -> str:
    """Return in words which coefficients have no effect in a set; the empty text if all have.

    Args:
        given: coefficients by their names.
        version: "5.2" or "6.1".
    """
    idle = [name for name in _OF_SETS[version] if name in given and not given[name].is_zero]
    if not idle:
        return ""
    (other,) = _OF_SETS.keys() - {version}
    return (
        f"{', '.join(idle)} of set {other} {'has' if len(idle) == 1 else 'have'} no effect in version {version}; "
        f"expected version={other!r}, or {' and '.join(_OF_SETS[other][:2])} for the force of the camber"
    )


def left_out(given: Mapping[str, Scalar]) -> str:
    """Return in words which coefficients have effects that are no part of the law; the empty text if none has.

    Args:
        given: coefficients by their names.
    """
    turning = sorted(name for name in TURN_SLIP & given.keys() if given[name] != 0)
    leaning = sorted(name for name in _CAMBER_SCALES & given.keys() if given[name] != 1)
    parts = []
    if turning:
        parts.append(
            f"turn slip is left out ({brief(', '.join(turning))}): forces are those of a path that is wide beside the "
            "tyre, not those of parking"
        )
    if leaning:
        parts.append(
            f"factors of the camber, of sets before 5.2, are left out ({', '.join(leaning)}); expected coefficients of "
            "camber that are scaled already, such as PHY3 and PVY3"
        )
    return "; ".join(parts)


NEEDED = {
    "always": ("FNOMIN", "UNLOADED_RADIUS"),
    "along": ("PCX1", "PDX1", "PKX1"),
    "across": ("PCY1", "PDY1", "PKY1", "PKY2"),
}
"""The least coefficients of each force."""

POSITIVE = frozenset({"FNOMIN", "UNLOADED_RADIUS", "NOMPRES", "LONGVL", "LFZO", "LCX", "LMUX", "LCY", "LMUY"})
"""What must be positive: sizes, and the scaling factors by which the law divides."""

BY_SPEED = ("QSY3", "QSY4", "LMUV")
"""The coefficients by which the rolling resistance and friction depend on the speed, relative to LONGVL."""

DIVISORS = {"PDX1": "PCX1", "PDY1": "PCY1", "PKY1": "PCY1", "PKY2": "PCY1"}
"""Coefficients by which the law divides, and the one that is zero where the whole force is."""
