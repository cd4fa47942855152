"""Programs that the guides name read `Robot.to_urdf()` as the same arm: a table of all of them.

`make evidence SUITE=readers` installs them, which are large, and prints it.
"""

from importlib.metadata import PackageNotFoundError, version

import numpy as np
import pytest
from irbkin import Robot, catalog
from reference import random_pose
from urdf_readers import FOLLOW, PACKAGES, READERS, assert_agrees

SAMPLES = 20


@pytest.mark.evidence
@pytest.mark.parametrize("reader", READERS)
def test_every_arm_of_the_catalog_is_the_same_in(reader, capsys):
    try:
        number = version(PACKAGES.get(reader, reader))
    except PackageNotFoundError:
        pytest.skip(f"{reader} is not installed")
    rng = np.random.default_rng(1)
    cases = [(Robot(name), "tool0") for name in catalog()]
    cases += [
        (arm.with_base(random_pose(rng)).with_tool([0.1, 0, 0.2]), "tool") for arm, _ in cases
    ]
    wrong, most = [], 0.0
    for robot, tip in cases:
        try:
            # Inside the limits: compas_robots moves what is outside to the next limit.
            off = assert_agrees(robot, reader, robot.random(SAMPLES, rng), tip)
        except AssertionError as error:
            wrong.append(str(error))
        else:
            most = max(most, off)
    linkage = "follows its mimic" if reader in FOLLOW else "is one joint more"
    with capsys.disabled():
        print(f"\n{reader:16} {number:13} {len(cases)} URDFs, {len(wrong)} wrong, ", end="")
        print(f"others within {most:.1e}, a linkage {linkage} ", end="")
    assert len(cases) > 200
    assert not wrong, wrong[0]
