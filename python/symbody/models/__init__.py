"""Classic systems as functions, each with numbers and its source."""

from .arms import planar_arm, spatial_arm
from .balancing_robot import balancing_robot
from .ball_and_beam import ball_and_beam
from .bicycle import bicycle
from .blades import chaplygin_sleigh, skate, snakeboard
from .cars import full_car, half_car, quarter_car, single_track_car
from .classic_system import ClassicSystem
from .flexible_motorcycle import flexible_motorcycle
from .linkages import andrews_mechanism, bricard_mechanism, four_bar, slider_crank
from .motorcycle import motorcycle
from .pendulums import cart_pole, furuta_pendulum, n_pendulum
from .quadrotor import quadrotor_with_slung_load
from .rolling_bodies import rattleback, rolling_disc
from .tops import gyroscope_in_gimbals, heavy_top
from .touring_motorcycle import touring_motorcycle

MODELS = (
    n_pendulum,
    cart_pole,
    furuta_pendulum,
    ball_and_beam,
    planar_arm,
    spatial_arm,
    slider_crank,
    four_bar,
    andrews_mechanism,
    bricard_mechanism,
    heavy_top,
    gyroscope_in_gimbals,
    rolling_disc,
    rattleback,
    skate,
    chaplygin_sleigh,
    snakeboard,
    balancing_robot,
    bicycle,
    motorcycle,
    touring_motorcycle,
    flexible_motorcycle,
    quarter_car,
    half_car,
    full_car,
    single_track_car,
    quadrotor_with_slung_load,
)
"""All models, in the order of the gallery (docs/models.md)."""

__all__ = [
    "MODELS",
    "ClassicSystem",
    "andrews_mechanism",
    "balancing_robot",
    "ball_and_beam",
    "bicycle",
    "bricard_mechanism",
    "cart_pole",
    "chaplygin_sleigh",
    "flexible_motorcycle",
    "four_bar",
    "full_car",
    "furuta_pendulum",
    "gyroscope_in_gimbals",
    "half_car",
    "heavy_top",
    "motorcycle",
    "n_pendulum",
    "planar_arm",
    "quadrotor_with_slung_load",
    "quarter_car",
    "rattleback",
    "rolling_disc",
    "single_track_car",
    "skate",
    "slider_crank",
    "snakeboard",
    "spatial_arm",
    "touring_motorcycle",
]
