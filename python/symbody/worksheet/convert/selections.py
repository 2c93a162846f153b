"""Entries and fields: Maple counts from one, and Python from zero."""

from __future__ import annotations

from symbody.geometry import Frame
from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.motion_values import is_motion, output_entry
from symbody.worksheet.convert.names import NoText, identifier
from symbody.worksheet.convert.operations import SUM, grouped
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["index", "indexed", "key", "place", "selection", "word_of"]

_FIELDS = {
    "frame": "frame",
    "mass": "mass",
    "inertia": "inertia",
    "comps": "components",
    "coords": "coordinates",
    "acting": "on",
    "reacting": "reaction",
    "applied": "at",
}


def selection(text: Writer, node: syntax.Selection) -> str:
    """Return an entry of a list, a table or a matrix, a field of an object, or a name with indices."""
    if isinstance(node.whole, syntax.Name) and node.whole.name == "args":
        if not text.names.arguments:
            raise NoText("args")
        return f"{text.names.arguments}[{place(text.text(node.indices[0]))}]"
    if isinstance(node.whole, syntax.Name) and identifier(node.whole.name) not in text.names.values:
        return indexed(text, node)
    if is_motion(text, node.whole):
        return output_entry(text, node)
    return _tyre_angles(text, node) or _part(text, node)


def _part(text: Writer, node: syntax.Selection) -> str:
    """Return an entry or a field of a value."""
    whole = grouped(text.text(node.whole))
    found = text.value(whole)
    if isinstance(found, dict) and found and all(isinstance(each, Expr) for each in found):
        return f"list({whole}.items())[{place(text.text(node.indices[0]))}]"
    field = _field(node.indices)
    if isinstance(found, dict):
        return f"{whole}[{key(text, node.indices)}]"
    if field and not isinstance(found, list):
        return f"{whole}.{field}"
    if isinstance(found, Expr) and found.kind == "symbol":
        return indexed(text, node)
    if found is not None and not isinstance(found, list | tuple | Matrix | Frame):
        raise NoText("selection")
    return _entry(text, f"{whole}.matrix" if isinstance(found, Frame) else whole, found, node.indices)


def _tyre_angles(text: Writer, node: syntax.Selection) -> str:
    """Return ``tire['angles']``, the yaw and the camber of a tyre, or one of them; nothing for other entries."""
    match node:
        case syntax.Selection(whole=syntax.Selection() as whole, indices=(syntax.Integer(value=place),)):
            angles = _angles(text, whole)
            return angles[place - 1] if 0 < place <= len(angles) else ""
    return f"[{', '.join(angles)}]" if (angles := _angles(text, node)) else ""


def _angles(text: Writer, node: syntax.Selection) -> list[str]:
    match node:
        case syntax.Selection(
            whole=whole,
            indices=(syntax.Name(name="angles") | syntax.Delayed(body=syntax.Name(name="angles")),),
        ) if (tyre := text.names.tyres.get(text.text(whole))) is not None:
            ahead = f"sb.project({tyre.variable}.longitudinal, {tyre.road}).components"
            yaw = f"sb.atan2({ahead}[1], {ahead}[0])"
            camber = f"{tyre.variable}.camber"
            return [f"{{{text.names.text('yaw')}: {yaw}}}", f"{{{text.names.text('camber')}: {camber}}}"]
    return []


def _field(indices: tuple[syntax.Expression, ...]) -> str:
    """Return the attribute that a field of MBSymba's objects is; nothing for other indices."""
    is_word = len(indices) == 1 and isinstance(indices[0], syntax.Name | syntax.Delayed)
    return _FIELDS.get(word_of(indices[0]), "") if is_word else ""


def _entry(text: Writer, whole: str, found: object, indices: tuple[syntax.Expression, ...]) -> str:
    """Return an entry or a part of a list or a matrix; vectors have one index."""
    places = [index(text, each) for each in indices]
    if isinstance(found, Matrix) and len(places) == 1 and 1 in found.shape:
        places = [*places, "0"] if found.shape[1] == 1 else ["0", *places]
    if isinstance(found, list) and len(places) > 1:
        return f"{whole}{''.join(f'[{each}]' for each in places)}"
    return f"{whole}[{', '.join(places)}]"


def indexed(text: Writer, node: syntax.Selection, *, is_function: bool = False) -> str:
    """Return a name with indices, such as ``N[1]``, that has no value."""
    name, keys = word_of(node.whole), [text.text(each) for each in node.indices]
    found = [text.value(each) for each in keys]
    whole = f"{name}[{','.join(map(str, found))}]"
    if is_function:
        text.names.functions.add(whole)
    if all(key == str(each) for key, each in zip(keys, found, strict=True)):
        return text.names.text(whole)
    if any(each is None for each in found):
        raise NoText("indexed")
    if whole in text.names.functions:
        return f'indexed("{name}", {", ".join(keys)})'
    form = f"{name}[{','.join(f'{{{key}}}' for key in keys)}]"
    return f'sb.symbolic.symbol(f"{form}")'


def key(text: Writer, indices: tuple[syntax.Expression, ...]) -> str:
    """Return the key of an entry of a table: words are texts, also those that a variable holds."""
    texts = [_one_key(text, each) for each in indices]
    return ", ".join(texts)


def _one_key(text: Writer, node: syntax.Expression) -> str:
    if isinstance(node, syntax.Name | syntax.Delayed):
        word = word_of(node)
        known = text.names.values.get(identifier(word))
        if isinstance(known, Expr) and known.kind == "symbol" and str(known) != word:
            return f"str({identifier(word)})"  # the name that a variable of a loop holds
        if not isinstance(known, int | str | Matrix):
            return f'"{word}"'
    return text.text(node)


def index(text: Writer, node: syntax.Expression) -> str:
    """Return an index from zero, or a slice."""
    if isinstance(node, syntax.Infix) and node.operator == "..":
        return f"{_begin(text, node.left)}:{_end(text, node.right)}"
    return place(text.text(node))


def _begin(text: Writer, node: syntax.Expression) -> str:
    first = "1" if isinstance(node, syntax.SequenceDisplay) else text.text(node)
    return "" if first == "1" else place(first)


def _end(text: Writer, node: syntax.Expression) -> str:
    last = "-1" if isinstance(node, syntax.SequenceDisplay) else text.text(node)
    if last.startswith("-"):
        return "" if last == "-1" else f"{int(last) + 1}"
    return last


def place(text: str) -> str:
    """Return an index from zero."""
    if text.isdigit():
        return str(int(text) - 1)
    return text if text.startswith("-") else f"{grouped(text, SUM)} - 1"


def word_of(node: syntax.Expression) -> str:
    """Return the name that a name or a quoted name is.

    Raises:
        NoText: it is something else.
    """
    while isinstance(node, syntax.Delayed):
        node = node.body
    if not isinstance(node, syntax.Name):
        raise NoText("name")
    return node.name
