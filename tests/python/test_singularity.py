"""Distances from the singularities, and the figures of the Jacobian."""

import irbkin
import numpy as np
import pytest
from arms import ABB, CATALOG, KUKA_KR6, LATERAL
from hypothesis import given
from irbkin import SingularityKind
from reference import UNIT, move, reach, turn
from strategies import subjects_with_joints


def figures(jacobian):
    values = np.linalg.svd(jacobian, compute_uv=False)
    return values[-1], np.prod(values)


@given(subjects_with_joints())
def test_singular_values_are_those_of_numpy(drawn):
    subject, q = drawn
    jacobian = subject.robot.jacobian(q)
    record = subject.robot.singularity(q)
    least, product = figures(jacobian)
    # Either decomposition is exact for a matrix that is off by a few roundings of the largest
    # singular value.
    largest = np.linalg.norm(jacobian, 2)
    assert record.min_singular_value == pytest.approx(least, abs=64 * UNIT * largest)
    assert record.manipulability == pytest.approx(
        abs(np.linalg.det(jacobian)), abs=6 * 64 * UNIT * largest**6
    )
    assert record.manipulability == pytest.approx(product, abs=6 * 64 * UNIT * largest**6)


def test_a_seven_axis_arm_has_the_figures_and_the_distances():
    robot = irbkin.Robot("Panda")
    for q in np.random.default_rng(1).uniform(*robot.limits.T, (50, 7)):
        jacobian, record = robot.jacobian(q), robot.singularity(q)
        least, product = figures(jacobian)
        assert record.min_singular_value == pytest.approx(least, abs=1e-14)
        assert record.manipulability == pytest.approx(product, abs=1e-13)
        assert record.manipulability == pytest.approx(
            np.sqrt(np.linalg.det(jacobian @ jacobian.T)), rel=1e-6
        )
        frames = robot.link_frames(q)
        # Axis 3 carries the upper arm; axes 5 and 6 meet in the origin of frame 5, the shoulder is
        # that of frame 1.
        upper = frames[2, :3, 2]
        assert record.shoulder == pytest.approx(0.316 * np.hypot(upper[0], upper[1]), abs=1e-15)
        normal, line = (
            np.cross(frames[4, :3, 2], frames[5, :3, 2]),
            frames[0, :3, 3] - frames[5, :3, 3],
        )
        assert np.sin(record.wrist) == pytest.approx(
            abs(normal @ line) / np.linalg.norm(line), abs=1e-14
        )
        stretched = -np.arctan2(0.0825, 0.316) - np.arctan2(0.0825, 0.384)
        assert np.sin(record.elbow) == pytest.approx(abs(np.sin(q[3] - stretched)), abs=1e-15)
        assert record.kinds == SingularityKind(0)


def test_an_arm_of_unknown_structure_has_the_figures_and_no_names():
    rows = CATALOG["Panda"].rows + 1e-3
    record = irbkin.Robot.from_mdh(rows).singularity(np.full(7, 0.4))
    assert record.min_singular_value > 0
    assert np.isnan([record.wrist, record.elbow, record.shoulder]).all()
    assert record.kinds == SingularityKind(0)


@pytest.mark.parametrize("name", ABB)
def test_the_determinant_is_the_product_of_the_three_factors(name):
    """|det J| = upper arm x forearm x sin elbow x distance of the wrist from axis 1 x sin q5, for
    any tool and base.
    """
    _, elbow, _, upper, forearm, _ = ABB[name].lengths
    robot = irbkin.Robot(name)
    moved = robot.with_tool(move(0.1, -0.2, 0.3) @ turn("x", 0.7)).with_base(
        turn("y", 0.4) @ move(1, 2, 3)
    )
    for q in np.random.default_rng(2).uniform(*robot.limits.T, (100, 6)):
        record = robot.singularity(q)
        factors = np.sin(record.elbow) * record.shoulder * np.sin(record.wrist)
        product = upper * np.hypot(elbow, forearm) * factors
        bound = 64 * UNIT * (1 + reach(ABB[name].rows)) ** 3
        assert abs(np.linalg.det(robot.jacobian(q))) == pytest.approx(product, abs=bound)
        assert record.manipulability == pytest.approx(product, abs=bound)
        # The tool turns the linear rows into other combinations of the same volume.
        assert moved.singularity(q).manipulability == pytest.approx(product, abs=2**3 * bound)


@pytest.mark.parametrize("name", ABB)
def test_distances_are_those_of_the_geometry(name):
    a1, offset, _, upper, forearm, flange = ABB[name].lengths
    robot = irbkin.Robot(name)
    rng = np.random.default_rng(3)
    for q in rng.uniform(*robot.limits.T, (100, 6)):
        record, pose = robot.singularity(q), robot.fk(q)
        wrist_centre = pose[:3, 3] - flange * pose[:3, 2]
        assert record.shoulder == pytest.approx(np.hypot(*wrist_centre[:2]), abs=1e-14)
        half_turns = q[4] / np.pi
        assert record.wrist == pytest.approx(
            abs(half_turns - np.round(half_turns)) * np.pi, abs=1e-14
        )
        # Law of cosines in the triangle of shoulder, elbow and wrist.
        shoulder = a1 * np.array([np.cos(q[0]), np.sin(q[0]), 0]) + [0, 0, ABB[name].lengths[2]]
        k, r = np.hypot(offset, forearm), np.linalg.norm(wrist_centre - shoulder)
        cosine = (r**2 - upper**2 - k**2) / (2 * upper * k)
        assert np.cos(record.elbow) == pytest.approx(abs(cosine), abs=1e-13)
        assert 0 <= record.elbow <= np.pi / 2
        assert (record.kinds, type(record.kinds)) == (SingularityKind(0), SingularityKind)


@pytest.mark.parametrize(
    ("joint", "kind"),
    [
        ("wrist", SingularityKind.WRIST),
        ("elbow", SingularityKind.ELBOW),
        ("shoulder", SingularityKind.SHOULDER),
    ],
    ids=str,
)
def test_kinds_change_at_the_threshold(joint, kind):
    """The named thresholds: 1.5e-9 rad (wrist), 1e-7 rad (elbow), 1.5e-9 m (shoulder)."""
    threshold = {"wrist": 1.5e-9, "elbow": 1e-7, "shoulder": 1.5e-9}[joint]
    robot = irbkin.Robot.from_opw(a1=0, a2=0, b=0, c1=0.4, c2=0.3, c3=0.3, c4=0.1)
    for off, expected in ((0.0, True), (0.8 * threshold, True), (1.2 * threshold, False)):
        q = np.array([0.1, 0.4, 0.7, 0.2, 0.6, 0.3])
        if joint == "wrist":
            q[4] = off
        elif joint == "elbow":
            q[2] = off
        else:
            # Equal links: the wrist is over the shoulder where the forearm leans back as the upper
            # arm leans forward.
            q[1:3] = 0.4, -0.8 + off / (0.3 * np.cos(0.4))
        record = robot.singularity(q)
        assert (kind in record.kinds) is expected
        assert getattr(record, joint) == pytest.approx(off, abs=1e-15)
        assert record.kinds & ~kind == SingularityKind(0)


@pytest.mark.parametrize("name", ABB)
def test_kinds_of_joints_are_those_of_their_solution(name):
    _, elbow, _, _, forearm, _ = ABB[name].lengths
    robot = irbkin.Robot(name)
    stretched = np.array([0.1, 0.3, np.arctan2(elbow, forearm) - np.pi / 2, 0.2, 0.6, 0.3])
    straight = np.array([0.1, 0.3, 0.2, 0.4, 0.0, 0.3])
    for q, kind in ((stretched, SingularityKind.ELBOW), (straight, SingularityKind.WRIST)):
        assert robot.singularity(q).kinds == kind
        solutions = robot.ik(robot.fk(q))
        assert kind in {solution.singularities for solution in solutions}
        for solution in solutions:
            assert robot.singularity(solution.q).kinds == solution.singularities


@pytest.mark.parametrize("opw", [LATERAL, KUKA_KR6], ids=["lateral offset", "KUKA KR 6 R700"])
def test_signs_and_offsets_do_not_change_the_law_of_the_determinant(opw):
    robot = irbkin.Robot.from_opw(**opw)
    for q in np.random.default_rng(4).uniform(-3, 3, (100, 6)):
        record = robot.singularity(q)
        factors = np.sin(record.elbow) * record.shoulder * np.sin(record.wrist)
        product = opw["c2"] * np.hypot(opw["a2"], opw["c3"]) * factors
        assert abs(np.linalg.det(robot.jacobian(q))) == pytest.approx(product, abs=64 * UNIT * 27)


def test_a_batch_is_a_record_of_arrays():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    q = np.random.default_rng(5).uniform(*robot.limits.T, (3, 4, 6))
    q[0, 0, 4] = 0
    batch = robot.singularity(q)
    for index in np.ndindex(3, 4):
        single = robot.singularity(q[index])
        for field in (
            "wrist",
            "elbow",
            "shoulder",
            "min_singular_value",
            "manipulability",
            "kinds",
        ):
            assert getattr(batch, field)[index] == getattr(single, field)
            assert isinstance(
                getattr(single, field), SingularityKind if field == "kinds" else float
            )
    assert batch.kinds.dtype == np.uint8
    assert SingularityKind(batch.kinds[0, 0]) == SingularityKind.WRIST
