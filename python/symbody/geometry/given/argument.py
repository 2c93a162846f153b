"""Arguments of public functions, checked against their annotations when the function is called.

A wrong type or a wrong order is reported where the user made it, in the user's words, and not by what fails inside.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import cache, wraps
from inspect import Parameter, signature
from math import isfinite
from types import NoneType, UnionType
from typing import Annotated, Any, NamedTuple, ParamSpec, TypeVar, Union, get_args, get_origin

from symbody.errors import ArgumentError, JointError, SymbodyError
from symbody.symbolic import ExprLike
from symbody.symbolic.given.arguments import described, instead_note, unknown_option

from .annotation import Test, hints_of, is_collection, strangers, test_of

P = ParamSpec("P")
R = TypeVar("R")

#: How each kind of thing is called, and written.
_WRITTEN = {
    "Body": "a body, such as Body(frame, mass)",
    "Equations": "equations of motion, such as newton_euler(system)",
    "Expr": "an expression, such as symbols('a')",
    "Frame": "a frame, such as ground or rotate('Z', angle)",
    "Load": "a force or a torque, such as Force(frame, x, y, z, at=point, on=body)",
    "Projectable": "a point, a vector, a force or a torque",
    "Point": "a point, such as Point(frame, x, y, z) or center_of_mass(body)",
    "System": "a system, such as System(bodies, loads, coordinates)",
    "Vector": "a vector, such as Vector(frame, x, y, z)",
    "str": "a text",
}
#: What is at hand where another thing is expected, by the words of both: the way from one to the other.
_WAYS = {
    ("Link", "Body"): "mechanism.body(link) is the body of a link, with mechanism = assemble([...])",
    ("Link", "Frame"): "mechanism.frame(link) is the frame of a link, with mechanism = assemble([...])",
    ("ClassicSystem", "System"): "model.system is the system of a model",
    ("Element", "Joint"): "element['force'] or resultant(element, point) is what an element does",
    ("Mechanism", "System"): "mechanism.system(loads, gravity=...) is its system",
    ("Joint", "Freedom"): "joint.coordinate is the coordinate of a joint of the tree",
    ("PlacedJoint", "Freedom"): "joint.freedom() is the freedom of a placed joint",
}
_SCALAR = "an expression, such as symbols('a'), or a finite number"


def checked(error: type[SymbodyError]) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Return a decorator: arguments that don't fit the annotations of the function raise this error.

    The words of an annotation ``Annotated[kind, "words"]`` are those of the message on what is expected.

    >>> from symbody import ground, velocity
    >>> velocity(ground)
    Traceback (most recent call last):
    ...
    symbody.errors.FrameError: velocity: thing = ground is a Frame; expected a point, such as Point(frame, x, y, z) or \
center_of_mass(body), or a vector, such as Vector(frame, x, y, z)
    """

    def decorate(function: Callable[P, R]) -> Callable[P, R]:
        door = cache(lambda: _Door.of(function, error))

        @wraps(function)
        def call(*args: P.args, **kwargs: P.kwargs) -> R:
            door().check(args, kwargs)
            try:
                return function(*args, **kwargs)
            except TypeError:
                _check_count(function, args, kwargs)
                raise

        return call

    return decorate


def _check_count(
    function: Callable[..., object], args: tuple[object, ...], kwargs: Mapping[str, object]
) -> None:
    """Raise an error if arguments are missing or too many, for which Python has a TypeError in its own words."""
    try:
        signature(function).bind(*args, **kwargs)
    except TypeError as fault:
        raise ArgumentError(f"{_called(function)}: {fault}") from None


def _called(function: Callable[..., object]) -> str:
    """Return the name by which users call a function, or a method that makes or calls an object."""
    return function.__qualname__.removesuffix(".__init__").removesuffix(".__call__")


class _Argument(NamedTuple):
    """One argument of a function."""

    name: str
    hint: Any
    fits: Test

    @classmethod
    def of(cls, name: str, hint: Any) -> _Argument:
        return cls(name, hint, test_of(hint))


class _Door(NamedTuple):
    """The arguments of one function, and what their annotations expect."""

    where: str
    error: type[SymbodyError]
    positional: tuple[_Argument, ...]
    repeated: _Argument | None
    """The argument that takes all further ones."""
    named: dict[str, _Argument]
    takes_others: bool
    """Whether further arguments with names are passed on."""

    def place(self, args: tuple[object, ...], kwargs: dict[str, object]) -> str:
        """Return the function as messages call it; with the name of the part of a mechanism that it makes."""
        names = [argument.name for argument in self.positional if argument.name != "self"]
        if self.error is not JointError or names[:1] != ["name"]:
            return self.where
        given = dict(zip((argument.name for argument in self.positional), args, strict=False))
        name = given.get("name", kwargs.get("name"))
        return f"{self.where} {name}" if isinstance(name, str) and name.isidentifier() else self.where

    @classmethod
    def of(cls, function: Callable[..., object], error: type[SymbodyError]) -> _Door:
        hints = hints_of(function)
        parameters = signature(function).parameters.values()
        kinds = {p.kind for p in parameters}
        named = {p.name: _Argument.of(p.name, hints.get(p.name, object)) for p in parameters}
        in_order = [p.name for p in parameters if p.kind is Parameter.POSITIONAL_OR_KEYWORD]
        repeated = [p.name for p in parameters if p.kind is Parameter.VAR_POSITIONAL]
        return cls(
            _called(function),
            error,
            tuple(named[name] for name in in_order),
            named[repeated[0]] if repeated else None,
            named,
            Parameter.VAR_KEYWORD in kinds,
        )

    def check(self, args: tuple[object, ...], kwargs: dict[str, object]) -> None:
        for argument, value in zip(self.positional, args, strict=False):
            if type(value) is not argument.hint and not argument.fits(value):
                raise self._fault(self.place(args, kwargs), argument, value)
        if self.repeated is not None:
            for value in args[len(self.positional) :]:
                if not self.repeated.fits(value):
                    raise self._fault(self.where, self.repeated, value)
        for name, value in kwargs.items():
            if name in self.named:
                if not self.named[name].fits(value):
                    raise self._fault(self.place(args, kwargs), self.named[name], value)
            elif not self.takes_others:
                raise ArgumentError(f"{self.where}: {unknown_option(name, self.named)}")

    def _fault(self, where: str, argument: _Argument, value: object) -> SymbodyError:
        """Return the error of an argument that doesn't fit its annotation."""
        name, hint, _ = argument
        found = _stranger(hint, value)
        stranger = value if found is None else found.value
        text = f"{stranger} is not finite" if _is_only_not_finite(stranger, hint) else described(stranger)
        found_text = f"{name} = {text}" if found is None else f"in {name}, {text}"
        of_sympy = type(stranger).__module__.startswith("sympy.")
        way_out = "; from_sympy converts it" if of_sympy else _way(type(stranger).__name__, hint)
        if "expression" in _wanted(hint):
            way_out += instead_note(stranger)
        return self.error(f"{where}: {found_text}; expected {_wanted(hint)}{way_out}")


def _is_only_not_finite(value: object, hint: Any) -> bool:
    """Whether a value is nan or infinite where numbers are expected, and the words on what is expected don't say so."""
    expects_numbers = float in _entries(hint) and "finite" not in _wanted(hint)
    return expects_numbers and isinstance(value, float) and not isfinite(value)


def _way(found: str, hint: Any) -> str:
    """Return the way from what was given to what is expected; the empty text if none is known."""
    kinds = {getattr(part, "__name__", "") for part in _entries(hint)}
    ways = (_WAYS.get((found, kind)) for kind in sorted(kinds))
    return next((f"; {way}" for way in ways if way is not None), "")


def _entries(hint: Any) -> tuple[Any, ...]:
    """Return the alternatives of an annotation, and of what collections hold."""
    return tuple(
        one
        for part in _parts(hint)
        for one in (
            _entries(get_args(part)[0]) if get_origin(part) is not None and get_args(part) else (part,)
        )
    )


class _Stranger(NamedTuple):
    """An entry of a collection that doesn't fit."""

    value: object


def _stranger(hint: Any, value: object) -> _Stranger | None:
    """Return the first entry of a collection that doesn't fit, where a collection would."""
    for part in _parts(hint):
        origin = get_origin(part)
        if isinstance(origin, type) and issubclass(origin, Iterable) and is_collection(value, origin):
            return _Stranger(strangers(part, value)[0])
    return None


def _parts(hint: Any) -> tuple[Any, ...]:
    """Return the alternatives of an annotation."""
    origin, parts = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return _parts(parts[0])
    if isinstance(hint, TypeVar):
        return _parts(hint.__bound__)
    return tuple(one for part in parts for one in _parts(part)) if origin in (Union, UnionType) else (hint,)


def _wanted(hint: Any) -> str:
    origin, parts = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return str(parts[1])
    if hint == ExprLike:
        return _SCALAR
    if origin in (Union, UnionType):
        if {*get_args(ExprLike)} <= {*parts}:
            return _SCALAR
        return ", or ".join(_wanted(part) for part in parts if part is not NoneType)
    if isinstance(hint, TypeVar):
        return _wanted(hint.__bound__)
    if origin is not None:
        return f"a list, each entry {_wanted(parts[0])}"
    return _WRITTEN.get(hint.__name__, f"a {hint.__name__}")
