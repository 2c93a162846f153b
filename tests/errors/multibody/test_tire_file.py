"""Mistakes in tyre property files: their whole messages."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from symbody import ModelNotice, tire_file
from symbody.errors import LoadError
from symbody.multibody.element.tire_file import TireFile

START = "[MODEL]\nFITTYP = 61\nFNOMIN = 4000\nUNLOADED_RADIUS = 0.3\n"
SLICK = f"{START}PCX1 = 1.6\nPDX1 = 1.1\nPKX1 = 22\n"


def read(text: str, use: Callable[[TireFile], object] = TireFile.law) -> Callable[[], object]:
    """Return what reads a file of a text, and uses it."""

    def mistake() -> object:
        with TemporaryDirectory() as folder:
            path = Path(folder, "a.tir")
            path.write_text(text, encoding="utf-8")
            return use(tire_file(path))

    return mistake


MISTAKES: list[tuple[Callable[[], object], str]] = [
    (
        read("FNOMIN = 4000"),
        (
            "tire_file a.tir: no FITTYP, which tells the version of the Magic Formula; expected one of 5, 6,"
            " 21, 51, 52, 60, 61, 62"
        ),
    ),
    (
        read("[MODEL]\nFITTYP = 2"),
        (
            "tire_file a.tir, line 2: FITTYP = 2; expected one of 5, 6, 21, 51, 52, 60, 61, 62: the Magic "
            "Formula of the sets 5.2, 6.1 and 6.2"
        ),
    ),
    (
        read(f"{START}PCX1 1.3"),
        (
            "tire_file a.tir, line 5: 'PCX1 1.3'; expected NAME = value, a [SECTION], or a comment that "
            "begins with $"
        ),
    ),
    (read(f"{START}PCX1 = 1,3"), "tire_file a.tir, line 5: PCX1 = '1,3'; expected a number"),
    (
        read(f"{START}FNOMIN = 5000"),
        "tire_file a.tir, line 5: FNOMIN = 5000, after 4000 in line 3; expected one value",
    ),
    (
        read(f"{START}PCX1 = 1.3"),
        (
            "tire_file a.tir: magic_formula: PDX1, PKX1 missing; expected the nominal load, the unloaded "
            "radius, and shape, peak and stiffness of a force"
        ),
    ),
    (
        read("[UNITS]\nLENGTH = 'yard'"),
        (
            "tire_file a.tir: the unit of length is 'yard'; expected one of meter, metre, m, mm, millimeter,"
            " cm, centimeter, km, kilometer, inch, in, foot, ft"
        ),
    ),
    (
        read("[UNITS]\nANGLE = 'degree'"),
        (
            "tire_file a.tir: the unit of angle is 'degree'; expected one of radians, radian, rad: "
            "coefficients by degrees are none of the Magic Formula's"
        ),
    ),
    (read(SLICK, lambda file: file["FNOMI"]), "tire_file a.tir: no 'FNOMI'; it has FNOMIN"),
    (
        lambda: tire_file(Path("nowhere/a.tir")),
        "tire_file a.tir: No such file or directory (nowhere/a.tir); expected a tyre property file",
    ),
    (
        read("[UNITS]\nVELOCITY = 'kph'\n"),
        (
            "tire_file a.tir: VELOCITY = 'kph' in the section UNITS; expected units of length, force, mass, time, "
            "angle, pressure, by which all sizes of the file are measured"
        ),
    ),
    (
        read("[UNITS]\nPRESSURE = 'banana'\n"),
        (
            "tire_file a.tir: the unit of pressure is 'banana'; expected one of pascal, pa, kpa, kilopascal, mpa, "
            "megapascal, bar, psi"
        ),
    ),
    (
        read(f"{SLICK}TYRESIDE = 'TOP'"),
        "tire_file a.tir, line 8: TYRESIDE = 'TOP'; expected 'left', 'right' or 'symmetric'",
    ),
    (
        read(SLICK, lambda file: file.law(side="top")),
        "tire_file a.tir: side = 'top'; expected 'left' or 'right'",
    ),
    (
        read(SLICK, lambda file: file.law(side="left")),
        (
            "tire_file a.tir: side = 'left', but the file has no TYRESIDE; expected law(), and law().mirrored for the "
            "tyres of the other side"
        ),
    ),
    (
        lambda: tire_file(None),
        "tire_file: path = None; expected the path of a tyre property file, such as 'front.tir'",
    ),  # type: ignore[arg-type]
]


@pytest.mark.parametrize(("mistake", "message"), MISTAKES)
def test_message(mistake: Callable[[], object], message: str) -> None:
    with pytest.raises(LoadError) as caught:
        mistake()
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("entries", "told"),
    [
        ("[LATERAL_COEFFICIENTS]\nPDYX = 1", "PDYX (line 9) means nothing to the law and is left out of it"),
        (
            "PXX9 = 3\nPCY12 = 1",
            "PXX9 (line 8), PCY12 (line 9) mean nothing to the law and are left out of it",
        ),
    ],
)
def test_notice_of_entries_that_the_law_does_not_know(entries: str, told: str) -> None:
    with pytest.warns(ModelNotice) as caught:
        read(f"{SLICK}{entries}")()
    assert [str(each.message) for each in caught] == [f"tire_file a.tir: {told}; expected names such as PCY1"]
