"""Sketches: outlines of solids."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from symbody import (
    Body,
    Expr,
    Point,
    System,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    spring,
    subs,
    symbols,
    translate,
)
from symbody.document.reference_position import Still, still
from symbody.document.subject import Subject
from symbody.view.drawable_motion import OneInstant
from symbody.view.drawing_options import DrawingOptions
from symbody.view.mark import Ellipse, Line, outermost
from symbody.view.scene import scene
from symbody.view.shape import Ellipsoid
from symbody.view.sketch import sketch, sketch_of

DIRECTIONS = np.array([[np.cos(a), np.sin(a)] for a in np.linspace(0, np.pi, 12)])
k, l = symbols("k l")
SIDES = [(1.0, 1.0, 1.0), (3.0, 1.0, 2.0)]


@pytest.mark.parametrize("sides", SIDES, ids=["ball", "ellipsoid"])
def test_the_outline_is_as_wide_as_the_solid_in_all_directions(sides: tuple[float, float, float]) -> None:
    """The width of an ellipse in a direction w is ``|(a w_1, b w_2)|`` in its axes; that of the solid is sampled."""
    s = functions_of_time("s")
    frame = rotate("X", 0.4) * rotate("Y", 0.8) * translate(s, 0, 0)
    body = Body(frame, 1, 1, 1, 1)
    motion = OneInstant(Still(System([body], coordinates=[s]), {s: 0.5}))
    content = scene(motion, DrawingOptions(shapes={body: Ellipsoid(*sides)}), "")
    (outline,) = [mark for mark in sketch_of(content).marks if isinstance(mark, Ellipse)]
    axes = np.radians([outline.turn, outline.turn + 90])
    along = DIRECTIONS @ np.array([np.cos(axes), np.sin(axes)])
    drawn = np.linalg.norm(along * np.array(outline.radii), axis=1)

    surface = np.random.default_rng(1).normal(size=(3, 20_000))
    surface = surface / np.linalg.norm(surface, axis=0) * np.array(sides)[:, None]
    turned = (
        np.array([[entry.evaluate({}) for entry in row] for row in frame.pose.rows], dtype=float) @ surface
    )
    towards, up = np.array(content["view"]["direction"]), np.array(content["view"]["up"])
    right = np.cross(up, towards) / np.linalg.norm(np.cross(up, towards))
    sampled = (DIRECTIONS @ np.array([right, -np.cross(towards, right)]) @ turned).max(axis=1)
    np.testing.assert_allclose(sampled / sampled[0], drawn / drawn[0], rtol=0.01)
    if sides == SIDES[0]:
        assert outline.radii[0] == outline.radii[1]


def test_a_turned_ellipse_reaches_as_far_as_its_box() -> None:
    low, high = outermost(Ellipse((1.0, 2.0), (5.0, 3.0), 90.0, "#000000", 1.0))
    np.testing.assert_allclose([low, high], [(-2, -3), (4, 7)])


@pytest.mark.parametrize(("stiffness", "is_coil"), [(k, True), (0, False)])
def test_springs_are_zigzags_and_dampers_lines(stiffness: Expr | int, is_coil: bool) -> None:
    """Their ends are those of the element, on either side; a zigzag has many short lines."""
    x = functions_of_time("x")
    cart = Body(translate(x, 0, 0), 1)
    wall = Point(ground, -2, 0, 0)
    element = spring(cart.center_of_mass, wall, stiffness, free_length=1, damping=1, on=cart)
    assert [end.coordinates[0] for end in element.ends] == [0, -2]
    system = System([cart], [element], coordinates=[x])
    marks = sketch(still(Subject(newton_euler(system), None, {}, {}, {}))).marks
    thin = [mark for mark in marks if isinstance(mark, Line) and mark.color == "#444444"]
    assert (len(thin) > 10) == is_coil
    assert thin[0].start != thin[-1].end
    assert all(a.end == b.start for a, b in pairwise(thin))


def test_the_ends_of_a_spring_are_substituted_with_it() -> None:
    x = functions_of_time("x")
    cart = Body(translate(x, 0, 0), 1)
    element = spring(cart.center_of_mass, Point(ground, l, 0, 0), k, on=cart)
    assert [end.coordinates[0] for end in subs(element, {l: 3 * k}).ends] == [0, 3 * k]
