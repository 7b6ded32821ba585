"""Movement encodings, and how a recorded trajectory becomes a policy."""

from sgim.primitives.piecewise_acceleration import PiecewiseAcceleration

__all__ = ["PiecewiseAcceleration"]
