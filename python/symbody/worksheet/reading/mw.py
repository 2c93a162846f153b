"""Maple's ``.mw`` files: XML with groups of input and output, text fields and sections."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from xml.parsers import expat

from symbody.errors import WorksheetError
from symbody.worksheet.reading.formula_text import UnknownFormula, formula_text
from symbody.worksheet.reading.stored_formula import UnknownEncoding, stored_formula
from symbody.worksheet.sheet.source import Cell, Line, SyntaxMistake
from symbody.worksheet.sheet.syntax import Place

__all__ = ["mw_cells"]

#: Styles of text fields and fonts that hold code, and those of printed text.
_CODE_STYLES = frozenset({"Maple Input", "1D", "2D Input", "Code", "Maple Input Placeholder"})
_PRINTED_STYLES = ("Line Printed Output", "Maple Output", "Warning", "Error", "Diagnostic", "Text Output")

#: Styles of formulas in two dimensions that are input.
_FORMULA_STYLES = frozenset({"2D Input", "Code", "Maple Input"})

#: Outputs that the file stores in Maple's own encoding, as a text export calls them.
_DRAWN = {"Equation": "[Maple Math]", "Plot": "[Maple Plot]", "Image": "[Maple Bitmap]"}


@dataclass(slots=True)
class _Formula:
    """A formula in two dimensions: encoded as it is drawn and as it is stored, and its text, which may be cut."""

    display: str
    text: str
    is_input: bool
    stored: str = ""


@dataclass(slots=True)
class _Reader:
    """What the tags seen so far say about the text that follows."""

    parser: expat.XMLParserType
    cells: list[Cell] = field(default_factory=list)
    input: list[Line] = field(default_factory=list)
    printed: list[str] = field(default_factory=list)
    prose: list[str] = field(default_factory=list)
    unread: list[SyntaxMistake] = field(default_factory=list)
    formula: _Formula | None = None
    tags: list[tuple[str, str]] = field(default_factory=list)
    text: list[tuple[str, int, int]] = field(default_factory=list)
    words: list[str] = field(default_factory=list)

    def begin(self, tag: str, attributes: dict[str, str]) -> None:
        """Take the beginning of an element."""
        if tag == "Group":
            self.close()
        if tag == "Startup-Code":  # Maple executes it when the file is opened
            place = self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1
            self.input += _lines([(attributes.get("startupcode", ""), *place)])
            has_code = bool(self.input)
            self.close()
            if has_code:
                self.cells[-1] = replace(self.cells[-1], is_startup=True)
        if tag == "Equation" and self._within("Input"):
            self.formula = _Formula(
                attributes.get("display", ""),
                attributes.get("input-equation", ""),
                is_input=attributes.get("style") in _FORMULA_STYLES
                and attributes.get("executable") != "false",
            )
        if tag in _DRAWN and self._within("Output"):
            self.printed.append(_DRAWN[tag])
        self.tags.append((tag, _style(tag, attributes)))

    def end(self, tag: str) -> None:
        """Take the end of an element."""
        if tag == "Text-field":
            self._end_field()
        self.tags.pop()
        if tag == "Equation" and self.formula is not None:
            self._end_formula(self.formula)
        if tag == "Group":
            self.close()

    def characters(self, text: str) -> None:
        """Take text."""
        if self.formula is not None:
            self.formula.stored += text
        if self._within("Equation") or self._within("Image") or self._within("Plot"):
            return  # what is drawn is stored in Maple's own encoding
        if self._within("Text-field"):
            self._add(text)

    def close(self) -> None:
        """Complete a cell, if it has code."""
        if self.input or self.unread:
            cell = Cell(
                tuple(self.input),
                tuple(self.printed),
                tuple(self.prose),
                remarks_lost_marks=False,
                unread=tuple(self.unread),
            )
            self.cells.append(cell)
            self.input, self.printed, self.prose, self.unread = [], [], [], []

    def _add(self, text: str) -> None:
        if self._within("Input") and self._style() in _CODE_STYLES:
            place = self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1
            self.text.append((text, *place))
        elif not (self._within("Input") and self._field_style() in _CODE_STYLES):
            self.words.append(text)  # text in a field of code is a remark

    def _end_formula(self, formula: _Formula) -> None:
        """Take a formula of the input: as text, if it can be read."""
        self.formula = None
        if not formula.is_input:
            self._add(formula.text)
            return
        try:
            text = _formula_text(formula)
        except (UnknownEncoding, UnknownFormula) as reason:
            text = formula.text
            if not text.strip():
                self._refuse(str(reason))
        first, column = self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1
        rows = [row for row in text.split("\n") if row.strip()]
        lines = [Line(row, first + k, column, prompted=True) for k, row in enumerate(rows)]
        self.input += [*_lines(self.text), *lines]
        self.text = []

    def _refuse(self, found: str) -> None:
        line, column = self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1
        message = (
            f"line {line}, column {column}: found input in two dimensions that is not read ({found}); expected "
            "names, numbers, operators, fractions, powers, indices and roots: in Maple, convert it to 1-D Math Input "
            "(menu Format, Convert To), and save again"
        )
        self.unread.append(SyntaxMistake(Place(line, column, line, column), message))

    def _within(self, tag: str) -> bool:
        return any(name == tag for name, _ in self.tags)

    def _field_style(self) -> str:
        return next((style for tag, style in reversed(self.tags) if tag == "Text-field"), "")

    def _style(self) -> str:
        """Return the style of the text at hand: of its font, or of its field."""
        fonts = [style for tag, style in self.tags if tag == "Font" and style]
        return fonts[-1] if fonts else self._field_style()

    def _end_field(self) -> None:
        text, style = "".join(self.words).strip(), self._field_style()
        self.input += _lines(self.text)
        if text and (self._within("Output") or style.startswith(_PRINTED_STYLES)):
            self.printed.append(text)
        elif text:
            self.prose.append(text)
        self.text, self.words = [], []


def _style(tag: str, attributes: dict[str, str]) -> str:
    """Return the style of an element; what may be executed is code, and a field with a prompt unless it says more."""
    executable, style = attributes.get("executable", ""), attributes.get("style", "")
    if tag == "Font":
        return "Text" if executable == "false" else style or ("Maple Input" if executable == "true" else "")
    return style or ("Maple Input" if "prompt" in attributes else "")


def mw_cells(text: str) -> tuple[Cell, ...]:
    """Return the cells of an ``.mw`` file. The places of lines are those in the XML text.

    Raises:
        WorksheetError: the text is not XML.
    """
    parser = expat.ParserCreate("utf-8")  # the text is decoded, whatever encoding its head declares
    reader = _Reader(parser)
    parser.StartElementHandler = reader.begin
    parser.EndElementHandler = reader.end
    parser.CharacterDataHandler = reader.characters
    parser.EntityDeclHandler = _refuse_entity
    try:
        parser.Parse(text.encode("utf-8"), True)
    except (expat.ExpatError, RecursionError) as error:
        raise WorksheetError(f"the worksheet is not complete XML: {error}; save it again as .mw") from None
    reader.close()
    return tuple(reader.cells)


def _formula_text(formula: _Formula) -> str:
    """Return the text of a formula from what is drawn, or else from what is stored beside it."""
    try:
        return formula_text(stored_formula(formula.display or formula.stored))
    except UnknownEncoding:
        return formula_text(stored_formula(formula.stored))


def _refuse_entity(*_: object) -> None:
    raise WorksheetError("the worksheet declares entities, which Maple doesn't write; save it again as .mw")


def _lines(pieces: list[tuple[str, int, int]]) -> list[Line]:
    """Return the lines of a field, each with the place where its text begins."""
    lines: list[Line] = []
    text, place = "", None
    for piece, line, column in pieces:
        for index, part in enumerate(piece.split("\n")):
            if index:
                lines += [Line(text, *place)] if place and text.strip() else []
                text, place = "", None
            if part:
                place = place or (line + index, column if index == 0 else 1)
                text += part
    return lines + ([Line(text, *place)] if place and text.strip() else [])
