"""Movement encodings, and how a recorded trajectory becomes a policy."""

from sgim.primitives.piecewise_acceleration import PiecewiseAcceleration
from sgim.primitives.via_point_timing import EvenlySpaced, Intervals
from sgim.primitives.via_points import ViaPoints

__all__ = ["EvenlySpaced", "Intervals", "PiecewiseAcceleration", "ViaPoints"]
