"""Scalars that have been evaluated: the names on which they depend, and whether one of these has changed since."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.worksheet.evaluation.state import Seen, State

__all__ = ["depend_on", "guarded", "has_changed"]


def depend_on(session: State, names: Iterable[str]) -> None:
    """Note that the scalar that is being evaluated depends on names."""
    if session.depends:
        session.depends[-1].update(names)


def guarded(session: State) -> set[str]:
    """Names whose meaning here isn't that of the session: those being resolved, and local ones."""
    names = set(session.resolving)
    scope = session.scope
    while scope is not None:
        names |= scope.local
        scope = scope.parent
    return names


def has_changed(session: State, seen: Seen) -> bool:
    """Whether a scalar may have another value by now than when it was evaluated."""
    if session.scopes and seen.names & guarded(session):
        return True
    if session.resolving and not seen.names.isdisjoint(session.resolving):
        return True
    since = session.count - seen.stamp
    if since < len(seen.names):
        return any(name in seen.names for name in session.log[seen.stamp :])
    return any(session.assigned.get(name, 0) > seen.stamp for name in seen.names)
