"""What bad input gets: an error of the right kind that names the argument, what came and what is
wanted.
"""

import inspect

import irbkin
import numpy as np
import pytest
from irbkin import (
    InvalidJointsError,
    InvalidModelError,
    InvalidPoseError,
    IrbkinError,
    UnknownRobotError,
)

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
Q = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
POSE = ROBOT.fk(Q)

TAKING_JOINTS = {
    "fk": ROBOT.fk,
    "link_frames": ROBOT.link_frames,
    "jacobian": ROBOT.jacobian,
    "singularity": ROBOT.singularity,
}
TAKING_A_POSE = {
    "ik": ROBOT.ik,
    "ik_nearest": lambda T: ROBOT.ik_nearest(T, Q),
    "check_pose": ROBOT.check_pose,
    "with_tool": ROBOT.with_tool,
    "with_base": ROBOT.with_base,
    "to_xyz_wxyz": irbkin.to_xyz_wxyz,
    "to_xyz_euler_zyx": irbkin.to_xyz_euler_zyx,
}
# Those that take many, too.
TAKING_POSES = ("ik_nearest", "to_xyz_wxyz", "to_xyz_euler_zyx")
TAKING_A_VECTOR = {
    "seed": (lambda seed: ROBOT.ik_nearest(POSE, seed), 6, InvalidJointsError),
    "weights": (lambda weights: ROBOT.ik_nearest(POSE, Q, weights=weights), 6, InvalidJointsError),
    "xyz": (irbkin.pose, 3, InvalidPoseError),
    "wxyz": (lambda wxyz: irbkin.pose([0, 0, 0], wxyz), 4, InvalidPoseError),
    "xyzw": (lambda xyzw: irbkin.pose([0, 0, 0], xyzw=xyzw), 4, InvalidPoseError),
    "euler_zyx": (lambda euler: irbkin.pose([0, 0, 0], euler_zyx=euler), 3, InvalidPoseError),
}
NO_NUMBERS = {
    "text": "abc",
    "texts": ["1", "2", "3", "4", "5", "6"],
    "complex": Q * 1j,
    "bool": Q > 0,
    "object": Q.astype(object),
    "None": None,
    "dict": {},
    "dates": np.zeros(6, dtype="M8[s]"),
    "records": np.zeros(6, dtype=[("a", "f8")]),
    "integers beyond 64 bits": [10**30] * 6,
}


def spoiled(i, j, value):
    pose = POSE.copy()
    pose[i, j] = value
    return pose


def sheared(by):
    """Two columns of the rotation are `by` from a right angle, as a cosine."""
    shear = np.eye(4)
    shear[0, 1] = by
    return POSE @ shear


@pytest.mark.parametrize("value", NO_NUMBERS.values(), ids=NO_NUMBERS)
def test_non_numeric_input_is_a_type_error(value):
    calls = {
        **TAKING_JOINTS,
        **TAKING_A_POSE,
        "ik_batch": ROBOT.ik_batch,
        "with_limits": ROBOT.with_limits,
    }
    calls["follow"] = lambda T: ROBOT.follow(T, Q)
    # None is an answer to the others: they have a default.
    calls |= {name: TAKING_A_VECTOR[name][0] for name in ("seed", "xyz")}
    calls |= {"from_mdh": irbkin.Robot.from_mdh, "from_sdh": irbkin.Robot.from_sdh}
    if value is not None:
        calls |= {name: call for name, (call, _, _) in TAKING_A_VECTOR.items()}
    for call in calls.values():
        with pytest.raises(
            TypeError, match=r"^\w+ must be real numbers, got (an array of dtype|None)"
        ):
            call(value)


@pytest.mark.parametrize("shape", [(), (5,), (7,), (0,), (2, 5), (6, 1), (3, 6, 7)], ids=str)
@pytest.mark.parametrize("name", TAKING_JOINTS)
def test_joints_of_another_shape(name, shape):
    with pytest.raises(InvalidJointsError) as refused:
        TAKING_JOINTS[name](np.zeros(shape))
    assert str(refused.value) == f"q must have shape (..., 6), got {shape}"


def test_a_seven_axis_arm_asks_for_seven():
    with pytest.raises(InvalidJointsError, match=r"q must have shape \(\.\.\., 7\), got \(6,\)"):
        irbkin.Robot("Panda").fk(Q)


def test_a_ragged_list_is_refused():
    with pytest.raises(InvalidJointsError, match="q must be an array of numbers"):
        ROBOT.fk([[1, 2], [3]])


@pytest.mark.parametrize(("value", "word"), [(np.nan, "NaN"), (np.inf, "inf"), (-np.inf, "-inf")])
@pytest.mark.parametrize("name", TAKING_JOINTS)
def test_joints_that_are_not_finite_are_named(name, value, word):
    q = Q.copy()
    q[2] = value
    with pytest.raises(InvalidJointsError) as refused:
        TAKING_JOINTS[name](q)
    assert str(refused.value) == f"q: joint 3 is {word}, every angle must be finite [rad]"


NO_POSES = [(), (4,), (16,), (3, 4), (4, 3)]
# Calls that have a batch beside them.
MANY_POSES = [(2, 4, 4), (1, 4, 4)]


@pytest.mark.parametrize(
    ("name", "shape"),
    [
        (name, shape)
        for name in TAKING_A_POSE
        for shape in NO_POSES + MANY_POSES * (name not in TAKING_POSES)
    ],
    ids=str,
)
def test_a_pose_of_another_shape(name, shape):
    with pytest.raises(InvalidPoseError) as refused:
        TAKING_A_POSE[name](np.zeros(shape))
    message = str(refused.value)
    assert message.startswith("T must have shape ")
    if shape in MANY_POSES and name == "ik":
        assert message.endswith(f"4, 4), got {shape} (for many poses take ik_batch)")
    elif shape in MANY_POSES:
        assert message.endswith(f"4), got {shape}: {name} takes a single pose, call it for each")
    else:
        assert message.endswith(f"4, 4), got {shape}")


@pytest.mark.parametrize("shape", [(), (4,), (5, 16), (3, 4), (2, 4, 3)], ids=str)
def test_batches_of_another_shape(shape):
    with pytest.raises(InvalidPoseError) as refused:
        ROBOT.ik_batch(np.zeros(shape))
    assert str(refused.value) == f"T must have shape (..., 4, 4), got {shape}"


FAULTS = {
    "NaN": (spoiled(0, 1, np.nan), r"^pose\[0, 1\] is NaN: every element must be finite$"),
    "inf": (spoiled(2, 3, -np.inf), r"^pose\[2, 3\] is -inf: every element must be finite$"),
    "far": (spoiled(0, 3, 1e155), r"^pose\[0, 3\] is 1e155 m, its size must be at most 1e6 m$"),
    "far the other way": (
        spoiled(2, 3, -1.1e6),
        r"^pose\[2, 3\] is -1\.1e6 m, its size must be at most 1e6 m$",
    ),
    "last row": (spoiled(3, 0, 0.5), r"^pose row 3 must be \[0, 0, 0, 1\], got \[0\.5, 0, 0, 1\]$"),
    "last row by little": (
        spoiled(3, 2, 2e-9),
        r"^pose row 3 must be \[0, 0, 0, 1\], got \[0, 0, 0\.000000002, 1\]$",
    ),
    "transposed": (
        POSE.T.copy(),
        r"^pose row 3 must be \[0, 0, 0, 1\], got \[.*\], and column 3 is \[0, 0, 0, 1\] "
        r"\(is it transposed\?\)$",
    ),
    "mirrored": (
        POSE @ np.diag([1, 1, -1, 1]),
        r"^pose rotation mirrors: its determinant is -1\.000000, it must be 1",
    ),
    "scaled": (
        POSE @ np.diag([2, 2, 2, 1]),
        r"^pose rotation is off orthonormal by 3\.000e0, more than the 1e-5",
    ),
    "sheared": (
        sheared(1.1e-5),
        r"^pose rotation is off orthonormal by 1\.100e-5, more than the 1e-5",
    ),
    "no rotation": (np.diag([0.0, 0, 0, 1]), r"^pose rotation is off orthonormal by 1\.000e0"),
}


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("name", TAKING_A_POSE)
def test_a_pose_that_is_not_a_rigid_transform_is_reported_with_the_deviation(name, fault):
    pose, words = FAULTS[fault]
    with pytest.raises(InvalidPoseError, match=words):
        TAKING_A_POSE[name](pose)


def test_off_by_less_is_repaired():
    inverted = spoiled(3, 2, 0.5e-9)
    np.testing.assert_array_equal(ROBOT.ik(inverted).q, ROBOT.ik(POSE).q)
    assert max(solution.residual for solution in ROBOT.ik(sheared(0.9e-5))) <= 1e-14


@pytest.mark.parametrize("name", TAKING_A_VECTOR)
def test_a_vector_of_another_length_is_told_the_length(name):
    """And not that leading dimensions were welcome where an argument is one vector."""
    call, count, error = TAKING_A_VECTOR[name]
    for shape in ((), (count + 1,), *([(1, count)] if name == "weights" else [])):
        with pytest.raises(error) as refused:
            call(np.zeros(shape))
        assert str(refused.value).startswith(f"{name} must have shape ")
        assert str(refused.value).endswith(f"got {shape}")
        assert ("..." in str(refused.value)) == (name != "weights")


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("seed", [0, np.nan, 0, 0, 0, 0], "seed: joint 2 is NaN, every angle must be finite"),
        (
            "seed",
            [0, 0, 0, -1e15, 0, 0],
            r"^seed: joint 4 is -1e15 rad, its size must be at most 1e5 rad "
            r"\(remove whole turns\)$",
        ),
        ("xyz", [0, 0, 2e6], r"^xyz\[2\] is 2e6 m, its size must be at most 1e6 m$"),
        (
            "weights",
            [1, 1, 1, 1, 1, -2],
            "weights: joint 6 is -2, a weight must be finite and not negative",
        ),
        (
            "weights",
            [np.inf, 1, 1, 1, 1, 1],
            "weights: joint 1 is inf, a weight must be finite and not negative",
        ),
        ("xyz", [0, np.nan, 0], r"xyz\[1\] is NaN: every element must be finite"),
        ("wxyz", [1, 0, np.inf, 0], r"wxyz\[2\] is inf: every element must be finite"),
        (
            "wxyz",
            [1.1, 0, 0, 0],
            r"quaternion norm is 1\.100000, it must be 1 within 2e-3 \(order is w, x, y, z\)",
        ),
        ("wxyz", [1.0021, 0, 0, 0], r"quaternion norm is 1\.002100, it must be 1 within 2e-3"),
        ("wxyz", [0, 0, 0, 0], r"quaternion norm is 0\.000000"),
        ("euler_zyx", [0, 0, np.inf], r"euler_zyx\[2\] is inf: every element must be finite"),
    ],
)
def test_a_vector_with_a_wrong_value_names_it(name, value, words):
    call, _, error = TAKING_A_VECTOR[name]
    with pytest.raises(error, match=words):
        call(value)


def test_selection_checks_its_seed_like_the_solve():
    solutions = ROBOT.ik(POSE)
    for choose in (solutions.nearest, solutions.least_motion):
        with pytest.raises(InvalidJointsError, match="seed: joint 1 is NaN"):
            choose([np.nan] * 6)
        with pytest.raises(InvalidJointsError, match="weights: joint 1 is -1"):
            choose(Q, weights=[-1] * 6)


@pytest.mark.parametrize("angle", [1.01e5, -3.4e9, 1e15, 1e300])
def test_angles_of_too_many_turns_are_refused_as_seeds(angle):
    q = Q.copy()
    q[3] = angle
    words = r"joint 4 is .* rad, its size must be at most 1e5 rad \(remove whole turns\)$"
    for call in (
        lambda: ROBOT.ik(POSE).nearest(q),
        lambda: ROBOT.ik(POSE).least_motion(q),
        lambda: ROBOT.follow(POSE[None], q),
        lambda: ROBOT.ik_configured(POSE, [0, 0, 0, 0], fallback="nearest", seed=q),
        lambda: ROBOT.ik_nearest(np.array([POSE] * 2), q),
    ):
        with pytest.raises(InvalidJointsError, match=f"^seed: {words}"):
            call()
    with pytest.raises(InvalidJointsError, match=f"^q: {words}"):
        ROBOT.configuration(q)
    counted = np.stack(ROBOT.configuration([Q, q]), axis=-1)
    np.testing.assert_array_equal(counted[0], ROBOT.configuration(Q))
    assert (counted[1] == np.iinfo(np.int32).min).all()
    panda = irbkin.Robot("Panda")
    with pytest.raises(
        InvalidJointsError, match=r"^q7: joint 7 is .* rad, its size must be at most 1e5 rad"
    ):
        panda.ik(POSE, angle)
    assert (panda.ik_batch(POSE, [0.1, angle]).status[1] == irbkin.Status.INVALID).all()
    nearest = ROBOT.ik_nearest(np.array([POSE] * 2), [Q, q])
    assert np.isfinite(nearest[0]).all()
    assert np.isnan(nearest[1]).all()
    # Forward kinematics is that of the very number.
    rest = np.arctan2(np.sin(q), np.cos(q))
    np.testing.assert_allclose(ROBOT.fk(q), ROBOT.fk(rest), rtol=0, atol=1e-14)


def test_two_orientations_are_one_too_many():
    with pytest.raises(TypeError, match="give one orientation: wxyz or euler_zyx, not both"):
        irbkin.pose([0, 0, 0], [1, 0, 0, 0], euler_zyx=[0, 0, 0])


def test_another_frame_of_a_jacobian_is_refused():
    with pytest.raises(ValueError, match='frame must be "base" or "tool", got "world"'):
        ROBOT.jacobian(Q, frame="world")


@pytest.mark.parametrize(
    ("threads", "error", "words"),
    [
        (-1, ValueError, r"threads must be 0 \(one per core\) or more, got -1"),
        (1.5, TypeError, "'float' object cannot be interpreted as an integer"),
        ("2", TypeError, "'str' object cannot be interpreted as an integer"),
        (None, TypeError, "'NoneType' object cannot be interpreted as an integer"),
    ],
)
def test_threads_are_a_count(threads, error, words):
    with pytest.raises(error, match=words):
        ROBOT.ik_batch(POSE, threads=threads)


def test_errors_are_value_errors_with_a_common_base():
    for error in (
        InvalidPoseError,
        InvalidJointsError,
        InvalidModelError,
        irbkin.UnreachableError,
        UnknownRobotError,
    ):
        assert issubclass(error, IrbkinError)
    assert issubclass(IrbkinError, ValueError)
    assert issubclass(UnknownRobotError, KeyError)


def test_arguments_have_the_names_of_the_documentation():
    for call, names in {
        ROBOT.fk: "q out",
        ROBOT.link_frames: "q out",
        ROBOT.jacobian: "q frame out",
        ROBOT.singularity: "q out threads",
        ROBOT.ik: "T q7 given",
        ROBOT.ik_batch: "T q7 given out threads",
        ROBOT.ik_nearest: "T seed weights out threads",
        ROBOT.follow: "T seed weights singularity_mode zone out threads",
        ROBOT.ik_configured: "T configuration arm_angle fallback seed every out threads",
        ROBOT.check_pose: "T",
        ROBOT.with_tool: "T",
        ROBOT.with_base: "T",
        ROBOT.with_limits: "limits",
        irbkin.pose: "xyz wxyz xyzw euler_zyx rotation",
    }.items():
        assert list(inspect.signature(call).parameters) == names.split()


def test_nothing_is_printed(capfd):
    for call in (
        lambda: ROBOT.ik(FAULTS["NaN"][0]),
        lambda: ROBOT.fk([np.nan] * 6),
        lambda: irbkin.Robot("none"),
    ):
        with pytest.raises(IrbkinError):
            call()
    ROBOT.ik(irbkin.pose([9, 0, 0])).explain()
    assert capfd.readouterr() == ("", "")
