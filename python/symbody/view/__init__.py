"""What a motion looks like: plots over time, and animations as pages."""

from symbody.view.animation import animate
from symbody.view.motion import Motion
from symbody.view.plot import plot, save
from symbody.view.shape import Box, Cylinder, Ellipsoid, Plate, Shape

__all__ = ["Box", "Cylinder", "Ellipsoid", "Motion", "Plate", "Shape", "animate", "plot", "save"]
