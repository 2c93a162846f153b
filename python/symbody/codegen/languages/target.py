"""A target: a language, and the files that are written in it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from symbody.codegen.layout.language import Language
from symbody.codegen.layout.module import Module

__all__ = ["Target"]


@dataclass(frozen=True)
class Target:
    """A target as `generate` needs it.

    Attributes:
        name: what the user writes, such as ``"c"``.
        title: the language and its standard.
        language: its syntax.
        files: the texts of a module's files, by file name.
        check: the commands that build and run the self-check in the folder of the files, with ``{name}``; the
            first word of each is a tool of :mod:`symbody.codegen.sources.toolchain`, or ``python``.
        tools: the tools that these commands call in turn.
        limit: the largest number of operations of a function, where compilers want small ones.

    >>> from symbody.codegen import TARGETS
    >>> TARGETS["rust"].title, TARGETS["rust"].check[-1]
    ('Rust', './{name}_check')
    """

    name: str
    title: str
    language: Language
    files: Callable[[Module], Mapping[str, str]]
    check: tuple[str, ...]
    tools: tuple[str, ...] = ()
    limit: int | None = 1000
