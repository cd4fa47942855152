"""Lines, arcs and rounded polylines of the tool."""

import itertools

import irbkin
import numpy as np
import pytest
from irbkin import InvalidMotionError, InvalidPoseError, paths, trajectory
from reference import rotation_apart

A = irbkin.pose([0.8, -0.2, 0.6], euler_zyx=[0.0, 3.0, 0.2])
B = irbkin.pose([0.8, 0.3, 0.7], euler_zyx=[1.0, 2.5, -0.4])
C = irbkin.pose([0.5, 0.4, 0.9], euler_zyx=[0.5, 2.0, 0.0])


@pytest.mark.extra
def test_a_line_is_that_of_scipy_s_slerp():
    from scipy.spatial import transform

    both = transform.Rotation.from_matrix([A[:3, :3], B[:3, :3]])
    slerp = transform.Slerp([0, 1], both)(np.linspace(0, 1, 30)).as_matrix()
    np.testing.assert_allclose(paths.line(A, B, steps=30)[:, :3, :3], slerp, rtol=0, atol=1e-14)


def test_a_followed_line_is_straight():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    start = irbkin.pose([0.9, -0.4, 0.8], euler_zyx=[0, np.pi - 0.3, 0])
    end = irbkin.pose([0.9, 0.4, 0.8], euler_zyx=[0.5, np.pi - 0.3, 0])
    followed = robot.follow(paths.line(start, end, step=0.002), np.zeros(6))
    assert followed.breaks == ()
    assert len(followed.q) == 401


@pytest.mark.parametrize("zone", [0.0, 0.02, 0.05, "z20", "z200", "fine"])
def test_a_corner_is_passed_at_the_distance_that_is_said(zone):
    radius = {"z20": 0.02, "z200": 0.2, "fine": 0.0}.get(zone, zone)
    ways = [B[:3, 3] - A[:3, 3], C[:3, 3] - B[:3, 3]]
    lengths = np.linalg.norm(ways, axis=1)
    cos = ways[0] @ ways[1] / lengths.prod()
    kept = min(radius, lengths.min() / 2)
    path = paths.polyline([A, B, C], zone, steps=2001)
    nearest = np.linalg.norm(path[:, :3, 3] - B[:3, 3], axis=1).min()
    assert abs(nearest - kept / 2 * np.sqrt((1 - cos) / 2)) < 1e-12
    np.testing.assert_array_equal(path[[0, -1]], [A, C])


@pytest.mark.extra
def test_a_spline_is_that_of_scipy_over_its_chords():
    from scipy import interpolate

    rng = np.random.default_rng(5)
    met = np.tile(A, (7, 1, 1))
    met[:, :3, 3] = rng.uniform(-0.5, 0.5, (7, 3))
    chords = np.linalg.norm(np.diff(met[:, :3, 3], axis=0), axis=1)
    knots = np.r_[0, np.cumsum(chords)]
    curve = interpolate.CubicSpline(knots, met[:, :3, 3], bc_type="not-a-knot")
    dense = curve(np.linspace(0, knots[-1], 200_001))
    for point in paths.spline(met, steps=60)[:, :3, 3]:
        assert np.linalg.norm(dense - point, axis=1).min() < 2e-5
    # And its length is the curve's, to the chords' rounding off.
    length = np.linalg.norm(np.diff(dense, axis=0), axis=1).sum()
    own = paths.spline(met, step=1e-4)[:, :3, 3]
    assert abs(np.linalg.norm(np.diff(own, axis=0), axis=1).sum() / length - 1) < 1e-6


def test_every_path_is_spaced_by_the_tool_s_speed():
    calls = (
        lambda **spacing: paths.line(A, B, **spacing),
        lambda **spacing: paths.arc(A, B, C, **spacing),
        lambda **spacing: paths.polyline([A, B, C], 0.05, **spacing),
        lambda **spacing: paths.spline([A, B, C], **spacing),
    )
    for call in calls:
        path = call(speed=0.25, dt=0.004)
        np.testing.assert_array_equal(path, call(step=0.001))
        speeds = np.linalg.norm(np.diff(path[:, :3, 3], axis=0), axis=1) / 0.004
        assert speeds.max() <= 0.25 * (1 + 1e-9)
        assert np.median(speeds) > 0.249
        slow = call(speed=0.25, dt=0.004, turn=1e-3)
        assert len(slow) > len(path)
        turns = [rotation_apart(one, other) for one, other in itertools.pairwise(slow)]
        assert max(turns) <= 1e-3 * (1 + 1e-9)


NAN = A.copy()
NAN[0, 3] = np.nan


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: paths.line(A, B), ValueError, "give steps, or step"),
        (lambda: paths.line(A, B, steps=5, step=0.1), ValueError, "give steps, or step"),
        (lambda: paths.line(A, B, steps=1), InvalidMotionError, "steps must be 2 to .*, got 1$"),
        (lambda: paths.line(A, B, steps=10**18), InvalidMotionError, f"2 to .*, got {10**18}"),
        (lambda: paths.polyline([A, B, C], 0, steps=2), InvalidMotionError, "3 to .*, got 2"),
        (lambda: paths.line(A, B, step=-0.1), InvalidMotionError, "step is -0.1, .* positive"),
        (lambda: paths.line(A, B, step=np.nan), InvalidMotionError, "step is NaN"),
        (lambda: paths.line(A, B, step=0), InvalidMotionError, "step is 0.0, .* positive"),
        (lambda: paths.line(A, B, turn=0), InvalidMotionError, "turn is 0.0, .* positive"),
        (lambda: paths.line(A, B, turn=np.inf), InvalidMotionError, "step or turn is inf"),
        (lambda: paths.line(A, B, speed=0.25), ValueError, r"speed \[m/s\] with dt \[s\]"),
        (lambda: paths.line(A, B, dt=0.004), ValueError, r"speed \[m/s\] with dt \[s\]"),
        (lambda: paths.line(A, B, speed=0.2, dt=0.1, step=1), ValueError, "give steps, or step"),
        (lambda: paths.line(A, B, speed=0, dt=0.1), InvalidMotionError, "speed is 0.0, it must"),
        (lambda: paths.line(A, B, speed=-1, dt=0.1), InvalidMotionError, "speed is -1.0"),
        (lambda: paths.line(A, B, speed=1, dt=np.nan), InvalidMotionError, "dt is NaN"),
        (
            lambda: paths.line(A, B, speed=1e-200, dt=1e-200),
            InvalidMotionError,
            r"speed \* dt is 0.0",
        ),
        (
            lambda: paths.line(A, B, speed=1e-9, dt=1e-3),
            InvalidMotionError,
            "speed in m/s and dt in s",
        ),
        (
            lambda: paths.line(A, B, steps=3, axis=[0, np.nan, 0]),
            InvalidMotionError,
            r"axis\[1\] is NaN",
        ),
        (lambda: paths.line(NAN, B, steps=2), InvalidPoseError, r"T0: pose\[0, 3\] is NaN"),
        (lambda: paths.line(A, NAN, steps=2), InvalidPoseError, r"T1: pose\[0, 3\] is NaN"),
        (lambda: paths.arc(A, NAN, C, steps=2), InvalidPoseError, r"T_via: pose\[0, 3\] is NaN"),
        (lambda: paths.polyline([A, NAN], 0, steps=2), InvalidPoseError, r"T\[1\]: pose\[0, 3\]"),
        (lambda: paths.spline([A, NAN], steps=2), InvalidPoseError, r"T\[1\]: pose\[0, 3\]"),
        (lambda: paths.spline(np.zeros((0, 4, 4)), steps=2), InvalidMotionError, "T has 0 rows"),
        (lambda: paths.spline([A, B, C], steps=2), InvalidMotionError, "steps must be 3 to"),
        (lambda: paths.spline([A, B, C]), ValueError, "give steps, or step"),
        (
            lambda: paths.spline(A, steps=2),
            InvalidPoseError,
            r"T must have shape \(m, 4, 4\), got \(4, 4\)",
        ),
        (
            lambda: paths.spline([A, B, B @ np.diag([-1.0, -1, 1, 1])], steps=9),
            InvalidMotionError,
            "180.000000 deg to pose 2, there are two ways",
        ),
        (lambda: paths.arc(A, B, A, steps=5), InvalidMotionError, "must not lie on a line"),
        (lambda: paths.line(A, B, step=1e-12), InvalidMotionError, "is step in m"),
        (lambda: paths.line(A, B[:3], steps=2), InvalidPoseError, r"T1 must have shape \(4, 4\)"),
        (lambda: paths.line(A, 2 * B, steps=2), InvalidPoseError, "row 3 must be"),
        (lambda: paths.arc(A, A, B, steps=5), InvalidMotionError, "must not lie on a line"),
        (
            lambda: paths.arc(A, B, C, orientation="ABB", steps=5),
            ValueError,
            'orientation must be "path", "object" or "via", got "ABB"',
        ),
        (lambda: paths.polyline(np.zeros((0, 4, 4)), [], steps=2), InvalidMotionError, "0 rows"),
        (
            lambda: paths.polyline(A, "fine", steps=2),
            InvalidPoseError,
            r"T must have shape \(m, 4, 4\), got \(4, 4\)",
        ),
        (lambda: paths.polyline([A, B], "z7", steps=5), InvalidMotionError, "got 'z7'"),
        (lambda: paths.polyline([A, B], [0.1], steps=5), InvalidMotionError, "must have 2"),
        (lambda: paths.polyline([A, B], None, steps=5), InvalidMotionError, "got None"),
        (lambda: paths.polyline([A, B], np.nan, steps=5), InvalidMotionError, r"zones\[0\] is NaN"),
        (lambda: paths.polyline([A, B], -1, steps=5), InvalidMotionError, r"zones\[0\] is -1"),
    ],
)
def test_what_makes_no_path_is_refused(call, error, words):
    with pytest.raises(error, match=words):
        call()


RETIMED = np.linspace(0, 0.1, 18).reshape(3, 6)


@pytest.mark.parametrize(
    "call",
    [
        lambda A, B, C: paths.line(A, B, steps=3),
        lambda A, B, C: paths.arc(A, B, C, steps=3),
        lambda A, B, C: paths.polyline([A, B, C], "z10", steps=5),
        lambda A, B, C: paths.spline([A, B, C], steps=5),
        lambda *T: trajectory.retime(RETIMED, 1.0, 1.0, T=T, max_tool_speed=0.1),
        lambda *T: trajectory.at_tool_speed(RETIMED, T, 0.01, 1.0),
        lambda *T: trajectory.tool_speed_limits(RETIMED, T, 1.0),
    ],
)
def test_a_path_in_millimeters_is_asked_back(call):
    poses = [irbkin.pose(xyz) for xyz in ([0.85, 0.3, 0.6], [0.9, 0.0, 0.6], [0.85, -0.3, 0.6])]
    site, rail = irbkin.pose([4e5, -300, 2]), np.array(poses)
    rail[:, 0, 3] += [0, 40, 80]
    for path in (poses, site @ poses, rail):
        call(*path)
    for pose in poses:
        pose[:3, 3] *= 1e3
    with pytest.raises(irbkin.InvalidPoseError, match="is the pose in millimeters"):
        call(*poses)
