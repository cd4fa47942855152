"""Arms that cannot be built, limits that cannot be kept, names that are not known."""

import numpy as np
import pytest
from arms import ABB, IRB2400
from irbkin import InvalidModelError, Robot, UnknownRobotError

ROBOT = Robot("IRB 2600-12/1.65")
ROWS = ABB[ROBOT.name].rows
BUILDERS = {"from_mdh": Robot.from_mdh, "from_sdh": Robot.from_sdh}


@pytest.mark.parametrize("shape", [(5, 4), (8, 4), (2, 6, 4), (6, 3), (24,), ()], ids=str)
@pytest.mark.parametrize("build", BUILDERS.values(), ids=BUILDERS)
def test_a_table_of_another_shape(build, shape):
    with pytest.raises(InvalidModelError, match=r"^rows must have shape .*4\), got \("):
        build(np.zeros(shape))


@pytest.mark.parametrize(("column", "field"), [(0, "alpha"), (1, "a"), (2, "d"), (3, "theta")])
@pytest.mark.parametrize("build", BUILDERS.values(), ids=BUILDERS)
def test_a_table_that_is_not_finite_names_the_number(build, column, field):
    rows = ROWS.copy()
    rows[2, column] = np.nan
    # A standard row's twist and length stand behind its joint: they belong to the next row of the
    # modified table.
    row = 4 if build is Robot.from_sdh and column < 2 else 3
    with pytest.raises(
        InvalidModelError, match=rf"^{field} of row {row} is NaN, it must be finite$"
    ):
        build(rows)


@pytest.mark.parametrize(
    ("changed", "error", "words"),
    [
        ({"a1": np.nan}, InvalidModelError, "^a1 is NaN, it must be finite$"),
        ({"c4": np.inf}, InvalidModelError, "^c4 is inf, it must be finite$"),
        ({"c2": 0}, InvalidModelError, "^upper arm c2 is 0 m, it must be at least 1e-6 m$"),
        ({"c2": -0.5}, InvalidModelError, r"^upper arm c2 is -0\.5 m, it must be at least 1e-6 m$"),
        (
            {"a2": 0, "c3": 0},
            InvalidModelError,
            r"^forearm hypot\(a2, c3\) is 0 m, it must be at least 1e-6 m$",
        ),
        (
            {"signs": [1, 1, 1, 1, 1, 0.5]},
            InvalidModelError,
            r"^joint 6 sign is 0\.5, it must be 1 or -1$",
        ),
        (
            {"signs": [1, 0, 1, 1, 1, 1]},
            InvalidModelError,
            "^joint 2 sign is 0, it must be 1 or -1$",
        ),
        ({"signs": [1, 1]}, InvalidModelError, r"^signs must have shape .*6.*, got \(2,\)$"),
        ({"offsets": [0] * 5}, InvalidModelError, r"^offsets must have shape .*6.*, got \(5,\)$"),
        (
            {"offsets": [0, 0, np.inf, 0, 0, 0]},
            InvalidModelError,
            "^offset of joint 3 is inf, it must be finite$",
        ),
        ({"a1": "x"}, TypeError, "must be real number, not str"),
        ({"name": 5}, TypeError, "str"),
    ],
)
def test_wrong_parameters_are_named(changed, error, words):
    with pytest.raises(error, match=words):
        Robot.from_opw(**(IRB2400 | changed))


def test_missing_parameters_are_named():
    with pytest.raises(TypeError, match="missing 2 required keyword arguments: 'c3' and 'c4'"):
        Robot.from_opw(a1=0.1, a2=0, b=0, c1=0.4, c2=0.5)


LIMIT_SETTERS = {
    "with_limits": ROBOT.with_limits,
    "from_mdh": lambda limits: Robot.from_mdh(ROWS, limits=limits),
    "from_sdh": lambda limits: Robot.from_sdh(ROWS, limits=limits),
    "from_opw": lambda limits: Robot.from_opw(**IRB2400, limits=limits),
}


@pytest.mark.parametrize("set_limits", LIMIT_SETTERS.values(), ids=LIMIT_SETTERS)
def test_limits_are_checked_by_every_function(set_limits):
    good = np.array([[-1.0, 2.0]] * 6)
    np.testing.assert_array_equal(set_limits(good).limits, good)
    empty = good.copy()
    empty[2] = [1.2, -0.5]
    with pytest.raises(InvalidModelError) as refused:
        set_limits(empty)
    assert str(refused.value) == "joint 3 limit is empty: lower 1.2 rad > upper -0.5 rad"
    for column, side in ((0, "lower"), (1, "upper")):
        missing = good.copy()
        missing[4, column] = np.nan
        with pytest.raises(InvalidModelError, match=f"^{side} limit of joint 5 is NaN,"):
            set_limits(missing)
    for shape in ((5, 2), (6, 3), (12,), (7, 2)):
        with pytest.raises(InvalidModelError, match=r"^limits must have shape .*6, 2.*, got \("):
            set_limits(np.zeros(shape))


@pytest.mark.parametrize("shape", [(2, 6, 2), (1, 6, 2)], ids=str)
def test_limits_of_several_robots_are_refused(shape):
    with pytest.raises(InvalidModelError, match=r"^limits must have shape .*6, 2.*, got \("):
        ROBOT.with_limits(np.zeros(shape))


def test_limits_may_be_infinite_or_a_point():
    limits = np.array([[-np.inf, np.inf], [-np.inf, 1], [-1, np.inf], [0.5, 0.5], [-1, 1], [-1, 1]])
    robot = ROBOT.with_limits(limits)
    np.testing.assert_array_equal(robot.limits, limits)
    q = np.array([3.0, 0.2, -0.3, 0.5, 0.4, 0.6])
    assert np.abs(robot.ik_nearest(robot.fk(q), q) - q).max() <= 1e-9


def test_without_limits_there_are_none():
    np.testing.assert_array_equal(Robot.from_opw(**IRB2400).limits, [[-np.inf, np.inf]] * 6)


@pytest.mark.parametrize(
    ("name", "close"),
    [
        (
            "IRB 2600",
            ["IRB 2600-12/1.65", "IRB 2600-12/1.85", "IRB 2600-20/1.65", "IRB 2600ID-15/1.85"],
        ),
        ("IRB 140", ["IRB 140-6/0.81"]),
        ("2600-12/1.65", ["IRB 2600-12/1.65"]),
        ("irb2600-12-165", ["IRB 2600-12/1.65"]),
        ("IRB 6700-220/2.65", ["IRB 6700-220/2.65 (MH6, LeanID)"]),
        ("irb2600-12/1.66", ["IRB 2600-12/1.65"]),
        ("IRB 6700-150/3.1", ["IRB 6700-150/3.2"]),
        ("Pandaa", ["Panda"]),
        ("IRB1600 6/1.45 X", ["IRB 1600-6/1.45"]),
    ],
)
def test_an_unknown_name_lists_close_ones(name, close):
    with pytest.raises(UnknownRobotError) as unknown:
        Robot(name)
    message = str(unknown.value)
    assert message.startswith(f'unknown robot "{name}"; close names: "{close[0]}"')
    assert all(f'"{other}"' in message for other in close)


@pytest.mark.parametrize("name", ["", "zzzz", "?"])
def test_a_name_without_close_ones_is_reported_so(name):
    with pytest.raises(KeyError) as unknown:
        Robot(name)
    assert str(unknown.value) == (
        f'unknown robot "{name}"; no name of the catalog is close to it: '
        "catalog() lists all, from_urdf and from_mdh take other arms"
    )


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("CRX-30iA", "one source, the maker's URDF"),
        ("YuMi", "seven axes of no form that irbkin solves"),
        ("IRB 910SC", "four axes, one of them prismatic"),
        ("abb irb 460", "four axes, a second linkage keeps the flange level"),
        ("IRB 6400/2.8-120", "its one source has a forearm of 1705 mm"),
    ],
)
def test_an_arm_that_is_left_out_says_why(name, reason):
    with pytest.raises(UnknownRobotError, match="; left out of the catalog: ") as unknown:
        Robot(name)
    assert reason in str(unknown.value)


@pytest.mark.parametrize(
    ("maker", "arms"),
    [("franka", ("Panda", "FR3")), ("Universal Robots", ("UR3", "UR5e")), ("ABB", ("IRB",))],
)
def test_a_makers_name_says_which_arms_there_are(maker, arms):
    with pytest.raises(UnknownRobotError, match="close names: ") as unknown:
        Robot(maker)
    assert all(arm in str(unknown.value) for arm in arms)


@pytest.mark.parametrize("name", [5, None, b"Panda", ["Panda"]])
def test_a_name_is_text(name):
    with pytest.raises(TypeError):
        Robot(name)
