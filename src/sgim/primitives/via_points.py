"""Movements through via points, smoothed by Gaussian weights in time (eq. 3.6, 4.1)."""

from __future__ import annotations

from typing import Any

import numpy as np

from sgim.errors import SpaceError
from sgim.primitives.recordings import positions_of
from sgim.primitives.via_point_timing import Timing
from sgim.records import Trajectory
from sgim.spaces import Box, FloatArray

_EXACT = 1e-9
_SLACK = 1e-9


class ViaPoints:
    """Joints that follow a weighted mean of via points, the nearest in time weighing most.

    At time t the position is Σ wᵢ(t) uᵢ / Σ wᵢ(t) with wᵢ(t) = exp(−σ (t − tᵢ)²), i over the
    via points. (Eq. 3.6 and 4.1 print weights that grow with distance, and one index too many.)
    The movement lasts from the first instant tᵢ to the last; before and after it the joints stand
    still. It need not pass through its via points: the smaller σ, the smoother.

    A policy is the positions of all joints at the first via point, at the second, …, then the
    timing's parameters in s.

    Args:
        positions: Where a via point can be: a joint for each coordinate, all of one unit.
        timing: When the via points are passed: `Intervals` or `EvenlySpaced`.
        scaled: Whether all numbers of a policy are scaled to [0, 1]; else they have their units.

    Attributes:
        policy_space: The box of policies.
        joints: Names of the joints.
        unit: Unit of their positions.

    Raises:
        SpaceError: If the joints have different units, or none.
    """

    def __init__(self, positions: Box, timing: Timing, *, scaled: bool = False) -> None:
        units = set(positions.units)
        unit = positions.units[0]
        if len(units) != 1 or unit is None:
            raise SpaceError(
                f"the joints {', '.join(positions.names)} have units {list(positions.units)}, "
                "expected one unit for all"
            )
        self.timing = timing
        self.joints = positions.names
        self.unit = unit
        times, points = len(timing.names), timing.points
        names = [f"{joint}_{i}" for i in range(1, points + 1) for joint in self.joints]
        self._box = Box(
            [*positions.low.tolist() * points, *[timing.shortest] * times],
            [*positions.high.tolist() * points, *[timing.longest] * times],
            names=[*names, *timing.names],
            unit=[*[unit] * len(names), *["s"] * times],
        )
        self.scaled = scaled
        self.policy_space = Box(0.0, 1.0, names=self._box.names) if scaled else self._box

    def durations(self, policies: Any) -> FloatArray:
        """How long movements last, in s.

        Args:
            policies: Shape ``(n, parameters)``.

        Returns:
            Shape ``(n,)``.

        Raises:
            SpaceError: If the policies have another shape.
        """
        _, instants, _ = self._decoded(policies)
        return instants[:, -1]

    def positions(self, policies: Any, times: Any) -> FloatArray:
        """Where the joints are at given times; bounds are not checked.

        Each number depends on its own movement and time alone, to the last bit.

        Args:
            policies: Shape ``(n, parameters)``.
            times: In s from the start of the movements: shape ``(m,)``, or ``(n, m)`` for times
                of each movement's own.

        Returns:
            Shape ``(n, m, joints)``.

        Raises:
            SpaceError: If the policies have another shape.
        """
        points, instants, sharpness = self._decoded(policies)
        moments = np.clip(np.asarray(times, dtype=np.float64), 0.0, instants[:, -1:])
        weights = _weights(moments, instants, sharpness)
        # Sums are written out: their order must not depend on how many movements there are.
        joints = range(len(self.joints))
        sums = np.zeros((len(self.joints), *moments.shape))
        total = np.zeros(moments.shape)
        for i, weight in enumerate(weights):
            total += weight
            for joint in joints:
                sums[joint] += weight * points[:, i, joint, None]
        sums /= total
        return np.moveaxis(sums, 0, -1)

    def trajectory(self, policy: Any, rate: float) -> Trajectory:
        """The movement that a policy makes.

        Args:
            policy: Shape ``(parameters,)``, within the bounds.
            rate: Samples a second; the end of the movement is sampled as well.

        Raises:
            SpaceError: If the policy is malformed or out of bounds, or the rate is not positive.
        """
        point = self.policy_space.check(policy, "policy")
        if not self.policy_space.contains(point):
            raise SpaceError(f"policy {point!r:.200} is outside its bounds")
        if not 0 < rate < np.inf:
            raise SpaceError(f"rate is {rate}, expected a positive number of samples a second")
        end = float(self.durations(point[None])[0])
        times = np.append(np.arange(0.0, end, 1 / rate), end)
        return Trajectory(times, self.positions(point[None], times)[0], self.joints, self.unit)

    def fit(self, trajectory: Trajectory) -> tuple[FloatArray, float]:
        """The policy that best reproduces a recorded movement, by least squares (eq. 3.7).

        The movement lasts as long as the recording. For given instants positions are linear in
        the via points; from each start of the timing, both are refined together within their
        bounds by SciPy's trust-region-reflective method.

        Args:
            trajectory: Positions of this primitive's joints, in its unit; angles may also be in
                the other of rad and deg.

        Returns:
            The policy, shape ``(parameters,)``, and the root-mean-square residual in the
            primitive's unit, over all samples and joints.

        Raises:
            SpaceError: If the trajectory is of other joints, in another unit, or shorter or
                longer than movements can be.
        """
        recorded = positions_of(trajectory, self.joints, self.unit)
        times = trajectory.times - trajectory.times[0]
        self._check_duration(float(times[-1]))
        best, residual = np.empty(0), np.inf
        for start in self.timing.starts(float(times[-1])):
            parameters = self._refined(times, recorded, start)
            points = self._best_points(times, recorded, parameters)
            gap = self._normalised(times, parameters) @ points - recorded
            rms = float(np.sqrt(np.mean(gap**2)))
            if rms < residual:
                residual, best = rms, np.append(points.ravel(), parameters)
            if residual < _EXACT:
                break
        policy = self._box.encode(best) if self.scaled else best
        return self.policy_space.clip(policy), residual

    def _decoded(self, policies: Any) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Via points ``(n, points, joints)``, instants ``(n, points)`` and σ ``(n,)``."""
        values = np.asarray(policies, dtype=np.float64)
        if values.ndim != 2 or values.shape[1] != self.policy_space.dimension:
            raise SpaceError(
                f"policies have shape {values.shape}, expected (n, {self.policy_space.dimension})"
            )
        if self.scaled:
            values = self._box.decode(values)
        spatial = self.timing.points * len(self.joints)
        points = values[:, :spatial].reshape(len(values), self.timing.points, len(self.joints))
        return points, *self.timing.schedule(values[:, spatial:])

    def _check_duration(self, duration: float) -> None:
        shortest, longest = (
            float(self.timing.schedule(np.full((1, len(self.timing.names)), bound))[0][0, -1])
            for bound in (self.timing.shortest, self.timing.longest)
        )
        if not shortest * (1 - _SLACK) <= duration <= longest * (1 + _SLACK):
            raise SpaceError(
                f"trajectory lasts {duration:g} s, but movements last from {shortest:g} to "
                f"{longest:g} s: shorten it, or use another timing"
            )

    def _refined(self, times: FloatArray, recorded: FloatArray, start: FloatArray) -> FloatArray:
        """Timing parameters that fit better than ``start``, for a movement as long as it."""
        if len(start) <= 1:  # the duration alone decides
            return self.timing.with_duration(start, float(times[-1]))
        # SciPy's optimisers take long to import, and most runs never fit a trajectory.
        from scipy.optimize import least_squares

        spatial = self.timing.points * len(self.joints)
        low, high = self._box.low, self._box.high
        margin = 1e-6 * (high - low)
        # The duration is held by a stiff residual: one row more, no constraint.
        stiffness = 10 * np.sqrt(len(times)) * float(self._box.range[:spatial].max() / times[-1])

        def residuals(policy: FloatArray) -> FloatArray:
            points, timing = policy[:spatial].reshape(-1, len(self.joints)), policy[spatial:]
            gaps = self._normalised(times, timing) @ points - recorded
            end = self.timing.schedule(timing[None])[0][0, -1]
            return np.append(gaps.ravel(), stiffness * (end - times[-1]))

        points = self._best_points(times, recorded, start)
        found = least_squares(
            residuals,
            np.clip(np.append(points.ravel(), start), low + margin, high - margin),
            bounds=(low, high),
            method="trf",
            x_scale="jac",
            max_nfev=200,
            ftol=1e-12,
            xtol=1e-12,
            gtol=1e-14,
        )
        return self.timing.with_duration(found.x[spatial:], float(times[-1]))

    def _best_points(
        self, times: FloatArray, recorded: FloatArray, parameters: FloatArray
    ) -> FloatArray:
        """The best via points within their bounds for a given timing, shape ``(points, joints)``.

        Bounded linear least squares, by the same method.
        """
        from scipy.optimize import lsq_linear

        shares = self._normalised(times, parameters)
        count = len(self.joints)
        bounds = self._box.low[:count], self._box.high[:count]
        columns = [
            lsq_linear(shares, column, bounds=(low, high), method="trf", tol=1e-14).x
            for column, low, high in zip(recorded.T, *bounds, strict=True)
        ]
        return np.stack(columns, axis=1)

    def _normalised(self, times: FloatArray, parameters: FloatArray) -> FloatArray:
        """Share of each via point in the position at each time, shape ``(m, points)``."""
        weights = _weights(times[None], *self.timing.schedule(parameters[None]))[:, 0].T
        shares: FloatArray = weights / weights.sum(axis=1, keepdims=True)
        return shares


def _weights(moments: FloatArray, instants: FloatArray, sharpness: FloatArray) -> FloatArray:
    """exp(−σ (t − tᵢ)²), shape ``(points, n, m)``."""
    apart = moments - instants.T[:, :, None]
    weights: FloatArray = np.exp(-sharpness[:, None] * (apart * apart))
    return weights
