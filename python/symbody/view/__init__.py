"""Drawings of motions: plots over time, and animations as pages."""

from symbody.view.animation import Animation, animate
from symbody.view.drawable_motion import DrawableMotion
from symbody.view.free_body import free_body_diagram
from symbody.view.plot import plot, save
from symbody.view.shape import Box, Cylinder, Ellipsoid, Plate, Shape

__all__ = [
    "Animation",
    "Box",
    "Cylinder",
    "DrawableMotion",
    "Ellipsoid",
    "Plate",
    "Shape",
    "animate",
    "free_body_diagram",
    "plot",
    "save",
]
