"""Actions of loads in frames that are fixed in their bodies; each is taken there once per derivation."""

from __future__ import annotations

from symbody.geometry import Point, Triple
from symbody.multibody import Action
from symbody.symbolic import derivation


def anchor_of(action: Action) -> Point:
    """Return the point of a force, or the centre of mass for a torque, by its coordinates in a frame of the body."""
    with derivation() as current:
        anchors: dict[Action, Point] = current.cache.setdefault("anchors", {})
        if action not in anchors:
            anchors[action] = action.anchor
        return anchors[action]


def components_at_anchor(action: Action) -> Triple:
    """Return the components of an action in the axes of its anchor."""
    with derivation() as current:
        components: dict[Action, Triple] = current.cache.setdefault("components at anchors", {})
        if action not in components:
            components[action] = action.components(anchor_of(action).frame)
        return components[action]
