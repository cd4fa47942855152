"""Broken files of backups: findings, never another error, in linear time."""

import gc
import itertools
import time
from pathlib import Path

import pytest
from backups import MODULE, written
from irbkin.abb import load_backup, parse_backinfo, parse_cfg
from irbkin.abb.folders import decoded
from irbkin.abb.machine import read_machine
from mangling import INPUTS, dice, enough, mangled

EXAMPLE = Path(__file__).parents[2] / "examples" / "backup"


def test_broken_files_are_findings_and_never_another_error(tmp_path):
    random_ = dice(20261126)
    names = ["BACKINFO/backinfo.txt", "SYSPAR/MOC.cfg", "SYSPAR/SYS.cfg"]
    sound = {name: (EXAMPLE / name).read_bytes() for name in names}
    written(tmp_path, {**sound, "RAPID/TASK1/PROGMOD/Main.mod": MODULE})
    robots = tasks = 0
    # Of whole backups, a hundredth.
    count = max(INPUTS // 100, 100)
    for _ in range(count):
        name = random_.choice(names)
        (tmp_path / name).write_bytes(mangled(random_, sound[name]))
        backup = load_backup(tmp_path)
        (tmp_path / name).write_bytes(sound[name])
        robots += sum(it.robot is not None for it in backup.robots.values())
        tasks += sum(it.robot is not None for it in backup.tasks)
        assert all(it.line >= 0 and it.message for it in backup.findings)
    # Broken lines cost little of the rest.
    assert enough(robots > 1.8 * count)
    assert enough(tasks > 1.8 * count)


SHORT = b"""MOC:CFG_1.0:6:0::
ARM:

      -name "r_1" -upper_joint_bound 2 -lower_joint_bound -2\\
      -upper_joint_coupl_bound 1
#
JOINT:

      -name "T" -logical_axis 7
ROBOT:

      -name "R" -use_robot_type "ROB1_6660_1.90_205" -use_joint_0 "r_1"\\
      -base_frame_orient_u1 0.01 -base_frame_coordinated "T"
SINGLE:

      -name "T" -use_single_type "IRBT4004"
MECHANICAL_UNIT:

      -name "T" -use_single_0 "T"
>>PRODUCTS_ID:
RobotWare Version: 6.08
>>TASK1: (T_ROB1,,)
SYSMOD/user.sys @ user.sys
"""


def test_broken_texts_are_read_to_their_end():
    random_ = dice(20261127)
    robots = modules = 0
    for _ in range(INPUTS):
        text = decoded(mangled(random_, SHORT))
        found = parse_cfg(text, "SYSPAR/MOC.cfg")
        machine = read_machine(found, ())
        robots += sum(it.robot is not None for it in machine.robots.values())
        modules += sum(len(it.modules) for it in parse_backinfo(text).tasks)
    assert enough(robots > 0.8 * INPUTS)
    assert enough(modules > 0.8 * INPUTS)


LONG = [
    "-a ",
    "-name ",
    '"',
    '-a "b" ',
    "\\\n",
    "-name x\\\n",
    "-name x\n",
    "-name x\n\n",
    "ROBOT:\n",
    '-name "R" -use_joint_0 "a" -base_frame_coordinated "R"\n\n',
    "a:",
    "1" * 10,
    ">>TASK1: (a)\n",
    "a/",
    "a.",
    "RobotWare",
    "a @ b\n",
    "x" * 10,
    "\r",
    "=======\n",
]


@pytest.mark.parametrize("piece", LONG, ids=repr)
def test_time_is_linear_in_the_text(tmp_path, piece):
    def seconds(size):
        text = piece * (size // len(piece))
        head = "MOC:CFG_1.0:6:0::\nROBOT:\n\n", ">>PRODUCTS_ID:\n", ">>TASK1: (a)\n"
        files = {
            "SYSPAR/MOC.cfg": head[0] + text,
            "SYSPAR/SYS.cfg": head[0].replace("ROBOT", "CAB_TASKS") + text,
            "BACKINFO/backinfo.txt": head[1] + text + "\n" + head[2] + text,
        }
        written(tmp_path, files)
        # Of this process alone: others may be running. A collection takes longer the more other
        # tests have left.
        gc.disable()
        try:
            start = time.process_time()
            load_backup(tmp_path)
            return time.process_time() - start
        finally:
            gc.enable()

    # Eight times the text; a quadratic step would take 64 times as long, in each pair.
    pairs = ((seconds(20_000), seconds(160_000)) for _ in range(12))
    slow = list(itertools.takewhile(lambda pair: pair[1] > 20 * pair[0], pairs))
    assert len(slow) < 12, slow
