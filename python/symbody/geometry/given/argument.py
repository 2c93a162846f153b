"""Arguments of public functions, checked against their annotations when the function is called.

A wrong type or a wrong order is reported where the user made it, in the user's words, and not by what fails inside.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence, Set, Sized
from functools import cache, wraps
from inspect import Parameter, signature
from types import NoneType, UnionType
from typing import Annotated, Any, NamedTuple, ParamSpec, TypeVar, Union, get_args, get_origin, get_type_hints

from symbody.errors import ArgumentError, JointError, SymbodyError
from symbody.symbolic import Expr, ExprLike, number
from symbody.symbolic.given.arguments import comparison_note, described, unknown_option

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


class _Door(NamedTuple):
    """The arguments of one function, and what their annotations expect."""

    where: str
    error: type[SymbodyError]
    positional: tuple[tuple[str, Any], ...]
    repeated: tuple[str, Any] | None
    """The argument that takes all further ones."""
    named: dict[str, Any]
    takes_others: bool
    """Whether further arguments with names are passed on."""

    def place(self, args: tuple[object, ...], kwargs: dict[str, object]) -> str:
        """Return the function as messages call it; with the name of the part of a mechanism that it makes."""
        names = [name for name, _ in self.positional if name != "self"]
        if self.error is not JointError or names[:1] != ["name"]:
            return self.where
        name = dict(zip((name for name, _ in self.positional), args, strict=False)).get(
            "name", kwargs.get("name")
        )
        return f"{self.where} {name}" if isinstance(name, str) and name.isidentifier() else self.where

    @classmethod
    def of(cls, function: Callable[..., object], error: type[SymbodyError]) -> _Door:
        hints = get_type_hints(function, include_extras=True)
        parameters = signature(function).parameters.values()
        kinds = {p.kind for p in parameters}
        named = {p.name: hints.get(p.name, object) for p in parameters}
        in_order = [p.name for p in parameters if p.kind is Parameter.POSITIONAL_OR_KEYWORD]
        repeated = [p.name for p in parameters if p.kind is Parameter.VAR_POSITIONAL]
        return cls(
            _called(function),
            error,
            tuple((name, named[name]) for name in in_order),
            (repeated[0], named[repeated[0]]) if repeated else None,
            named,
            Parameter.VAR_KEYWORD in kinds,
        )

    def check(self, args: tuple[object, ...], kwargs: dict[str, object]) -> None:
        for (name, hint), value in zip(self.positional, args, strict=False):
            if not _fits(hint, value):
                raise self._fault(self.place(args, kwargs), name, hint, value)
        if self.repeated is not None:
            for value in args[len(self.positional) :]:
                if not _fits(self.repeated[1], value):
                    raise self._fault(self.where, *self.repeated, value)
        for name, value in kwargs.items():
            if name in self.named:
                if not _fits(self.named[name], value):
                    raise self._fault(self.place(args, kwargs), name, self.named[name], value)
            elif not self.takes_others:
                raise ArgumentError(f"{self.where}: {unknown_option(name, self.named)}")

    def _fault(self, where: str, name: str, hint: Any, value: object) -> SymbodyError:
        """Return the error of an argument that doesn't fit its annotation."""
        found = _stranger(hint, value)
        found_text = (
            f"{name} = {described(value)}" if found is None else f"in {name}, {described(found.value)}"
        )
        stranger = value if found is None else found.value
        of_sympy = type(stranger).__module__.startswith("sympy.")
        way_out = "; from_sympy converts it" if of_sympy else _way(type(stranger).__name__, hint)
        if "expression" in _wanted(hint):
            way_out += comparison_note(stranger)
        return self.error(f"{where}: {found_text}; expected {_wanted(hint)}{way_out}")


def _fits(hint: Any, value: object) -> bool:
    return type(value) is hint or (type(value) is Expr and hint is ExprLike) or accepts(hint, value)


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


def accepts(hint: Any, value: object) -> bool:
    """Return whether a value fits an annotation."""
    origin, parts = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return accepts(parts[0], value)
    if hint == ExprLike:
        return _is_scalar(value)
    if origin in (Union, UnionType):
        scalars = {*get_args(ExprLike)} if {*get_args(ExprLike)} <= {*parts} else set()
        others = (part for part in parts if part not in scalars)
        return (bool(scalars) and _is_scalar(value)) or any(accepts(part, value) for part in others)
    if isinstance(hint, TypeVar):
        return hint.__bound__ is None or accepts(hint.__bound__, value)
    if origin is not None and issubclass(origin, Iterable):
        return _is_collection(value, origin) and _strangers(hint, value) == []
    return not isinstance(hint, type) or isinstance(value, hint)


def _is_scalar(value: Any) -> bool:
    if isinstance(value, Expr):
        return True
    if isinstance(value, str):  # `number` reads texts, which may be mistakes elsewhere
        return False
    try:
        number(value)
    except (TypeError, ValueError):
        return False
    return True


def _is_collection(value: object, origin: type) -> bool:
    """Return whether a value can be iterated over; only once is enough if the annotation says so.

    A dictionary is no list of its keys, and a set has no order.
    """
    if isinstance(value, str | bytes) or issubclass(origin, Mapping) != isinstance(value, Mapping):
        return False
    if issubclass(origin, Sequence) and isinstance(value, Set):
        return False
    return isinstance(value, Iterable) and (origin is Iterable or isinstance(value, Sized))


def _strangers(hint: Any, value: object) -> list[object]:
    """Return the entries of a collection that don't fit; iterators, which work only once, are left alone."""
    if not (isinstance(value, Iterable) and isinstance(value, Sized)):
        return []
    entry = get_args(hint)[0]
    return [item for item in value if not accepts(entry, item)]


def _stranger(hint: Any, value: object) -> _Stranger | None:
    """Return the first entry of a collection that doesn't fit, where a collection would."""
    for part in _parts(hint):
        origin = get_origin(part)
        if isinstance(origin, type) and issubclass(origin, Iterable) and _is_collection(value, origin):
            return _Stranger(_strangers(part, value)[0])
    return None


def _parts(hint: Any) -> tuple[Any, ...]:
    """Return the alternatives of an annotation."""
    origin, parts = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return _parts(parts[0])
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
