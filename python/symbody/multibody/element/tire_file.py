"""Tyre property files (.tir): the coefficients of the Magic Formula as the tyre industry exchanges them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Annotated, NamedTuple, TypeAlias, final

from symbody.errors import LoadError, notify
from symbody.geometry import Scalar
from symbody.geometry.given.argument import checked
from symbody.symbolic.given.arguments import brief

from .magic_formula import MagicFormula, magic_formula
from .tire_coefficient import COEFFICIENTS, EXCLUDED, IGNORED, SCALES, left_out
from .tire_unit import DIMENSIONS, factor_of, unit_factors

__all__ = ["TireFile", "tire_file"]

FilePath: TypeAlias = Annotated[str | Path, "the path of a tyre property file, such as 'front.tir'"]

_VERSIONS = {5: "5.2", 6: "5.2", 21: "5.2", 51: "5.2", 52: "5.2", 60: "6.1", 61: "6.1", 62: "6.1"}
"""The sets of the Magic Formula by FITTYP."""

_SKIPPED = ("SHAPE", "LOADCASE")
"""Sections that hold tables."""

_OF_CARCASS = ("VERTICAL", "STRUCTURAL", "CONTACT_PATCH", "INERTIA", "DIMENSION")
"""Sections with coefficients of their own, of the stiffness and the size of the contact."""

_COEFFICIENT = re.compile(r"[PQRS][A-Z]{2,4}\d+")
"""How the coefficients of the law are called, such as PCY1."""

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?")


class _Line(NamedTuple):
    number: int
    section: str
    name: str
    value: str


_MOUNTED = ("left", "right")
"""The sides of a vehicle."""


@final
@dataclass(frozen=True, eq=False, repr=False)
class TireFile:
    """What a tyre property file holds, in SI units; `tire_file` reads it.

    Attributes:
        path: of the file.
        version: the set of the Magic Formula, "5.2" or "6.1".
        side: the side of the vehicle for which the tyre was measured, "left", "right" or "symmetric"; empty if the
            file has none.
        coefficients: those of the law, by name, as `magic_formula` takes them.
        others: all other numbers, such as VERTICAL_STIFFNESS, by name.
    """

    path: Path
    version: str
    side: str
    coefficients: Mapping[str, float]
    others: Mapping[str, float]

    def __getitem__(self, name: str) -> float:
        """Return a number of the file by its name, such as ``file["VERTICAL_STIFFNESS"]``."""
        found = {**self.others, **self.coefficients}
        if name not in found:
            near = get_close_matches(str(name).upper(), sorted(found), 3)
            meant = f"; it has {', '.join(near)}" if near else ""
            raise LoadError(f"tire_file {self.path.name}: no {brief(repr(name))}{meant}")
        return found[name]

    def law(self, *, pressure: Scalar | None = None, side: str | None = None) -> MagicFormula:
        """Return the law of the tyre, on the side of the vehicle for which it was measured, or on the other one.

        Args:
            pressure: the inflation pressure in Pa; by default INFLPRES of the file, or else the nominal one, NOMPRES.
            side: where the tyre is mounted, "left" or "right"; on the other side than that of the file, the law is
                `MagicFormula.mirrored`.

        Raises:
            LoadError: a coefficient is missing, or has a value by which the law divides; or the file has no side.
        """
        where = f"tire_file {self.path.name}"
        if side not in (None, *_MOUNTED):
            raise LoadError(f"{where}: side = {brief(repr(side))}; expected 'left' or 'right'")
        if side is not None and not self.side:
            raise LoadError(
                f"{where}: side = {side!r}, but the file has no TYRESIDE; expected law(), and law().mirrored for the "
                "tyres of the other side"
            )
        try:
            law = magic_formula(self.coefficients, version=self.version, pressure=pressure)
        except LoadError as fault:
            raise LoadError(f"{where}: {fault}") from None
        is_other = side is not None and self.side in _MOUNTED and side != self.side
        return law.mirrored if is_other else law

    def __repr__(self) -> str:
        return f"TireFile({self.path.name}, version {self.version}, {len(self.coefficients)} coefficients)"


@checked(LoadError)
def tire_file(path: FilePath) -> TireFile:
    r"""Read a tyre property file of the Magic Formula, sets 5.2, 6.1 and 6.2 (FITTYP 6, 21, 51, 52, 60 to 62).

    Sizes are converted to SI units by the section UNITS. Coefficients that the law does not know are told by a notice.
    A notice tells of those of turn slip, too. Empty values count as missing, and comments begin with $ or !.

    Args:
        path: the file.

    Raises:
        LoadError: the file can't be read, is of another tyre model, or a line makes no sense; the message names it.

    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> text = "[MODEL]\nFITTYP = 61\nFNOMIN = 4000\nUNLOADED_RADIUS = 0.3\nPCX1 = 1.6 $shape\nPDX1 = 1.1\nPKX1 = 22\n"
    >>> with TemporaryDirectory() as folder:
    ...     _ = Path(folder, "slick.tir").write_text(text)
    ...     front = tire_file(Path(folder, "slick.tir"))
    >>> front, front["FNOMIN"]
    (TireFile(slick.tir, version 6.1, 5 coefficients), 4000.0)
    >>> round(front.law()(4000, 0.05).longitudinal.evaluate({}), 1)
    3429.5
    """
    file = Path(path)
    where = f"tire_file {file.name}"
    lines = list(_lines(where, _text(where, file)))
    units = unit_factors(where, {line.name: line.value for line in lines if line.section == "UNITS"})
    entries = {line.name: line for line in lines if line.section not in ("UNITS", "MDI_HEADER")}
    _check_repeated(where, lines)
    version = _version(where, entries)
    numbers = {name: _value(where, line) for name, line in entries.items() if _is_numeric(line)}
    known = {name: value * factor_of(name, units) for name, value in numbers.items()}
    if version == "5.2":  # files of set 5.2 may have zeros for what this set doesn't have
        known = {name: value for name, value in known.items() if name not in ("PKY4", "QSY7") or value}
    law = COEFFICIENTS | SCALES | EXCLUDED
    _report_unknown(where, entries, law)
    if (effects := left_out(known)) != "":
        notify(f"{where}: {effects}")
    return TireFile(
        file,
        version,
        _side(where, entries.get("TYRESIDE")),
        {name: value for name, value in known.items() if name in law},
        {name: value for name, value in known.items() if name not in law},
    )


def _text(where: str, file: Path) -> str:
    try:
        data = file.read_bytes()
    except OSError as fault:
        raise LoadError(
            f"{where}: {fault.strerror or fault} ({file}); expected a tyre property file"
        ) from None
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _lines(where: str, text: str) -> Iterator[_Line]:
    """Yield the entries ``NAME = value`` that have a value, with their sections."""
    section = ""
    for number, line in enumerate(text.splitlines(), start=1):
        bare = re.split(r"[$!]", line, maxsplit=1)[0].strip()
        if bare.startswith("[") and bare.endswith("]"):
            section = bare[1:-1].strip().upper()
        elif bare and section not in _SKIPPED and not bare.startswith("{"):
            name, equals, value = (part.strip() for part in bare.partition("="))
            if not equals:
                raise LoadError(
                    f"{where}, line {number}: {brief(repr(bare))}; expected NAME = value, a [SECTION], or a comment "
                    "that begins with $"
                )
            if value:
                yield _Line(number, section, name.upper(), value.strip("'\""))


def _check_repeated(where: str, lines: list[_Line]) -> None:
    """Check that no name has two values, but for those that mean something else in the sections of units."""
    seen: dict[str, _Line] = {}
    for line in lines:
        if line.section in ("UNITS", "MDI_HEADER"):
            continue
        first = seen.setdefault(line.name, line)
        if first.value != line.value:
            raise LoadError(
                f"{where}, line {line.number}: {line.name} = {brief(line.value)}, after {brief(first.value)} in line "
                f"{first.number}; expected one value"
            )


def _version(where: str, entries: Mapping[str, _Line]) -> str:
    if "FITTYP" not in entries:
        raise LoadError(
            f"{where}: no FITTYP, which tells the version of the Magic Formula; expected one of "
            f"{', '.join(map(str, _VERSIONS))}"
        )
    line = entries["FITTYP"]
    found = _VERSIONS.get(int(_value(where, line)))
    if found is None:
        raise LoadError(
            f"{where}, line {line.number}: FITTYP = {brief(line.value)}; expected one of "
            f"{', '.join(map(str, _VERSIONS))}: the Magic Formula of the sets 5.2, 6.1 and 6.2"
        )
    return found


def _side(where: str, line: _Line | None) -> str:
    """Return the side of the vehicle for which a tyre was measured; empty if the file doesn't tell."""
    if line is None:
        return ""
    if line.value.lower() not in (*_MOUNTED, "symmetric"):
        raise LoadError(
            f"{where}, line {line.number}: TYRESIDE = {brief(repr(line.value))}; expected 'left', 'right' or "
            "'symmetric'"
        )
    return line.value.lower()


def _is_numeric(line: _Line) -> bool:
    """Whether an entry is one of numbers: texts, such as TYRESIDE, may be anything."""
    law = COEFFICIENTS | SCALES | EXCLUDED | IGNORED | DIMENSIONS.keys()
    return line.name in law or _NUMBER.fullmatch(line.value) is not None


def _value(where: str, line: _Line) -> float:
    if _NUMBER.fullmatch(line.value) is None:
        raise LoadError(
            f"{where}, line {line.number}: {line.name} = {brief(repr(line.value))}; expected a number"
        )
    return float(re.sub("[dD]", "e", line.value))


def _is_meant_for_law(line: _Line) -> bool:
    """Whether an entry is a coefficient by its section, or by its name in one that isn't about the carcass."""
    if "COEFFICIENTS" in line.section:
        return True
    return _COEFFICIENT.fullmatch(line.name) is not None and not line.section.startswith(_OF_CARCASS)


def _report_unknown(where: str, entries: Mapping[str, _Line], law: frozenset[str]) -> None:
    """Tell of names among the coefficients, or like theirs, that the law does not know, such as misspelt ones."""
    known = law | IGNORED | DIMENSIONS.keys()
    unknown = [
        line
        for name, line in entries.items()
        if name not in known and _NUMBER.fullmatch(line.value) and _is_meant_for_law(line)
    ]
    if unknown:
        listed = ", ".join(f"{line.name} (line {line.number})" for line in unknown)
        verbs = ("means", "is") if len(unknown) == 1 else ("mean", "are")
        notify(
            f"{where}: {brief(listed)} {verbs[0]} nothing to the law and {verbs[1]} left out of it; expected names "
            "such as PCY1"
        )
