"""Formulas as ``.mw`` files store them: elements of MathML, in Maple's own encoding, in base 64.

The encoding isn't published; this is what files of Maple 13 to 2022 show. A formula is a tree in prefix order::

    -h a    the element h, with the sequence a          6n ..   a sequence of n - 1 objects
    Iname   a name, G, and a sequence of attributes     /a b    the equation a = b
    %name   a name and G, without attributes            Qtext   a text, and a sequence of attributes
    Fn      the n-th object, counted from 1 in the order in which they begin; this is none itself

Names and texts have their length before them. A number below 58 is one character from ``!`` on; else it has digits to
the base 16, the lowest first: from ``[`` on, and the last one from ``k`` on. A text has ``~`` for a blank, and ``|``
with a number for the character of this code. A formula without signs is a name of no letters.
"""

from __future__ import annotations

import base64
import binascii
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TypeAlias

__all__ = ["Element", "UnknownEncoding", "stored_formula"]

_ONE, _LOW, _HIGH, _END = ord("!"), ord("["), ord("k"), ord("k") + 16
_BYTE = 255
_DEEPEST, _LARGEST = 200, 100_000


class UnknownEncoding(ValueError):
    """The text of a formula has something that isn't known."""


@dataclass(frozen=True, slots=True)
class Element:
    """An element of MathML, such as ``mi``, with its parts and attributes."""

    tag: str
    parts: tuple[Element | str, ...]
    attributes: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))


@dataclass(frozen=True, slots=True)
class _Name:
    name: str


_Object: TypeAlias = "Element | _Name | str | tuple[object, ...] | dict[str, str]"


def stored_formula(text: str) -> Element:
    """Return the formula that a text holds.

    >>> stored_formula("LUkjbW9HNiI2I1EiKzYi")
    Element(tag='mo', parts=('+',), attributes={})

    Raises:
        UnknownEncoding: the text is no base 64, or has something that isn't known.
    """
    try:
        code = base64.b64decode(text).decode("latin-1")
    except (binascii.Error, ValueError) as error:
        raise UnknownEncoding("no base 64") from error
    reading = _Reading(code)
    found = reading.object(0)
    if found == _Name("") and reading.at == len(code):
        return Element("mrow", ())
    if not isinstance(found, Element) or reading.at != len(code):
        raise UnknownEncoding("no formula")
    return found


class _Reading:
    """What was read so far."""

    def __init__(self, code: str) -> None:
        self.code, self.at = code, 0
        self.objects: list[_Object | None] = []
        self.sizes: dict[int, int] = {}

    def object(self, depth: int) -> _Object:
        """Read an object."""
        kind = self._character()
        if kind == "F":
            return self._known(self._number())
        if depth > _DEEPEST:
            raise UnknownEncoding("too deep")
        place = len(self.objects)
        self.objects.append(None)
        found = self._of_kind(kind, depth + 1)
        self.objects[place] = found
        return found

    def _of_kind(self, kind: str, depth: int) -> _Object:
        match kind:
            case "I" | "%":
                name = _Name(self._text(self._number()))
                if self._character() != "G":
                    raise UnknownEncoding("a name with a value")
                if kind == "I":
                    self.object(depth)
                return name
            case "Q":
                text = self._text(self._number())
                self.object(depth)
                return text
            case "6":
                return tuple(self.object(depth) for _ in range(self._number() - 1))
            case "/":
                left, right = self.object(depth), self.object(depth)
                return {left.name: right} if isinstance(left, _Name) and isinstance(right, str) else {}
            case "-":
                return self._bounded(_element(self.object(depth), self.object(depth)))
        raise UnknownEncoding(f"an object of the kind {kind!r}")

    def _bounded(self, element: Element) -> Element:
        """Return an element; references to others can make a short text a formula of any size."""
        size = 1 + sum(self.sizes.get(id(each), 1) for each in element.parts)
        if size > _LARGEST:
            raise UnknownEncoding(f"more than {_LARGEST} elements")
        self.sizes[id(element)] = size
        return element

    def _known(self, number: int) -> _Object:
        found = self.objects[number - 1] if 0 < number <= len(self.objects) else None
        if found is None:
            raise UnknownEncoding("an object that isn't there")
        return found

    def _character(self) -> str:
        if self.at >= len(self.code):
            raise UnknownEncoding("what the file stores of it ends too early")
        self.at += 1
        return self.code[self.at - 1]

    def _number(self) -> int:
        value, weight = 0, 1
        while True:
            code = ord(self._character())
            if weight == 1 and _ONE <= code < _LOW:
                return code - _ONE
            if _LOW <= code < _HIGH:
                value += weight * (code - _LOW)
            elif _HIGH <= code < _END and weight > 1:
                return value + weight * (code - _HIGH)
            else:
                raise UnknownEncoding("no number")
            weight *= 16

    def _text(self, length: int) -> str:
        """Read a text of so many bytes."""
        codes = [self._byte() for _ in range(length)]
        try:
            return bytes(codes).decode("utf-8")
        except UnicodeDecodeError:
            return bytes(codes).decode("latin-1")

    def _byte(self) -> int:
        letter = self._character()
        code = self._number() if letter == "|" else ord(" " if letter == "~" else letter)
        if code > _BYTE:
            raise UnknownEncoding("no character")
        return code


def _element(head: _Object, arguments: _Object) -> Element:
    if not isinstance(head, _Name) or not isinstance(arguments, tuple):
        raise UnknownEncoding("no element")
    parts = tuple(each for each in arguments if isinstance(each, Element | str))
    attributes = {key: text for each in arguments if isinstance(each, dict) for key, text in each.items()}
    if len(parts) + sum(isinstance(each, dict) for each in arguments) < len(arguments):
        raise UnknownEncoding("an element with other parts")
    return Element(head.name, parts, attributes)
