"""Drawings of motions: plots over time, and animations as pages."""

from symbody.view.animation import Animation, animate
from symbody.view.branch_plot import plot_branch
from symbody.view.drawable_motion import DrawableMotion
from symbody.view.figure import save
from symbody.view.fit_plot import plot_fit
from symbody.view.free_body import free_body_diagram
from symbody.view.mode_plot import plot_mode
from symbody.view.plot import plot
from symbody.view.response_plot import plot_frequency_response, plot_time_response
from symbody.view.root_locus_plot import plot_root_locus
from symbody.view.shape import Box, Cylinder, Ellipsoid, Plate, Shape
from symbody.view.study_plot import plot_sobol_indices, plot_study
from symbody.view.sweep_plot import plot_sweep

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
    "plot_branch",
    "plot_fit",
    "plot_frequency_response",
    "plot_mode",
    "plot_root_locus",
    "plot_sobol_indices",
    "plot_study",
    "plot_sweep",
    "plot_time_response",
    "save",
]
