"""Maple's ``.mw`` files: XML with groups of input and output, text fields and sections."""

from __future__ import annotations

from dataclasses import dataclass, field
from xml.parsers import expat

from symbody.errors import WorksheetError
from symbody.worksheet.sheet.source import Cell, Line

__all__ = ["mw_cells"]

#: Styles of text fields and fonts that hold code, and those of printed text.
_CODE_STYLES = frozenset({"Maple Input", "1D", "2D Input", "Code", "Maple Input Placeholder"})
_PRINTED_STYLES = ("Line Printed Output", "Maple Output", "Warning", "Error", "Diagnostic", "Text Output")


#: Outputs that the file stores in Maple's own encoding, as a text export calls them.
_DRAWN = {"Equation": "[Maple Math]", "Plot": "[Maple Plot]", "Image": "[Maple Bitmap]"}


@dataclass(slots=True)
class _Reader:
    """What the tags seen so far say about the text that follows."""

    parser: expat.XMLParserType
    cells: list[Cell] = field(default_factory=list)
    input: list[Line] = field(default_factory=list)
    printed: list[str] = field(default_factory=list)
    prose: list[str] = field(default_factory=list)
    tags: list[tuple[str, str]] = field(default_factory=list)
    text: list[tuple[str, int, int]] = field(default_factory=list)

    def begin(self, tag: str, attributes: dict[str, str]) -> None:
        """Take the beginning of an element."""
        if tag == "Group":
            self.close()
        if tag == "Equation" and self._within("Input") and attributes.get("input-equation", "").strip():
            self._add(attributes["input-equation"])
        if tag in _DRAWN and self._within("Output"):
            self.printed.append(_DRAWN[tag])
        self.tags.append((tag, attributes.get("style", "")))

    def end(self, tag: str) -> None:
        """Take the end of an element."""
        if tag == "Text-field":
            self._end_field()
        self.tags.pop()
        if tag == "Group":
            self.close()

    def characters(self, text: str) -> None:
        """Take text."""
        if self._within("Equation") or self._within("Image") or self._within("Plot"):
            return  # what is drawn is stored in Maple's own encoding
        if self._within("Text-field") and not self._is_text_in_code():
            self._add(text)

    def close(self) -> None:
        """Complete a cell, if it has code."""
        if self.input:
            cell = Cell(tuple(self.input), tuple(self.printed), tuple(self.prose), remarks_lost_marks=False)
            self.cells.append(cell)
            self.input, self.printed, self.prose = [], [], []

    def _add(self, text: str) -> None:
        self.text.append((text, self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1))

    def _within(self, tag: str) -> bool:
        return any(name == tag for name, _ in self.tags)

    def _field_style(self) -> str:
        return next((style for tag, style in reversed(self.tags) if tag == "Text-field"), "")

    def _is_text_in_code(self) -> bool:
        """Whether the text is a remark: a font of prose in a field of code."""
        fonts = [style for tag, style in self.tags if tag == "Font"]
        return self._is_code() and bool(fonts) and fonts[-1] in {"Text", "Normal"}

    def _is_code(self) -> bool:
        return self._within("Input") and self._field_style() in _CODE_STYLES

    def _end_field(self) -> None:
        code, style = self._is_code(), self._field_style()
        text = "".join(piece for piece, _, _ in self.text)
        if code:
            self.input += _lines(self.text)
        elif self._within("Output") or style.startswith(_PRINTED_STYLES):
            self.printed += [block for block in [text.strip()] if block]
        elif text.strip():
            self.prose.append(text.strip())
        self.text = []


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
