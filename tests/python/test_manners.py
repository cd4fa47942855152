"""What an answer shows of itself, and the columns that it is written as."""

import csv
import io
import re
from pathlib import Path

import irbkin
import irbkin.abb
import irbkin.map
import numpy as np
import pytest
from irbkin import paths, placement, rapid, scene, trajectory

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
BACKUP = Path(__file__).parents[2] / "examples" / "backup"
AXIS = np.linspace(-1.2, 1.2, 9)
MAP = irbkin.map.reach(ROBOT, AXIS, 0.0, AXIS, irbkin.map.orientations(20))


Q = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7]
POSES = np.stack([ROBOT.fk(ROBOT.random(200, rng=1))] * 3)
POSES[1, :199, 0, 3] += 9.0
POSES[1, 199, 0, 3] = np.nan
LINE = paths.line(
    *(irbkin.pose([0.9, y, 0.7], euler_zyx=[0, 2.8, 0]) for y in (-0.2, 0.2)), steps=81
)
START = ROBOT.ik_nearest(LINE[0], np.zeros(6))
FAR = LINE.copy()
FAR[4:74:5, 0, 3] += 9.0
PROGRAM = """MODULE M
CONST robtarget p10:=[[900,0,1200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
CONST robtarget p20:=[[9000,0,1200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
ENDMODULE
"""


def broken():
    with pytest.raises(irbkin.PathError) as caught:
        ROBOT.plan(FAR)
    return caught.value.plan


BROKEN = broken()


def placed():
    region = placement.Region(x=(-0.5, 0.5), y=(-0.5, 0.5))
    targets = [irbkin.pose([1.2, 0.1 * i, 0.5], euler_zyx=[0, 3, 0]) for i in range(50)]
    return placement.best_base(ROBOT, targets, region, steps=3, refine=False)


def motion():
    return scene.of(trajectory.joint([0.0] * 6, Q, duration=1.0, steps=500), ROBOT) + scene.of(MAP)


SHOWN = [
    (MAP, r"9 x 1 x 9 positions, 20 orientations each\nx -1.2 .. 1.2, y 0, z -1.2 .. 1.2 m\nreac"),
    (MAP, rf"{np.count_nonzero(MAP.share)} of 81 positions, .*\nbest: {MAP.share.max():.1%} at"),
    (placed(), r"^<Placement: at most 20 of 50 .* 20, 21, .* and 20 more; 9 bases on the grid>$"),
    (irbkin.abb.load_backup(BACKUP), r"backup: IRC5 6.08.01.00 .*\nrobots: ROB_1 \(IRB 4600-40/2"),
    (
        irbkin.abb.load_backup(BACKUP),
        r"\nunits: TRACK_2, .*\ntasks: T_ROB1 \(4 modules\), .*\nfindings: 2 ",
    ),
    (ROBOT.ik_batch(POSES), r"^<IkBatch: 3 x 200 poses, 8 slots: 400 with .* without, 1 invalid>$"),
    (ROBOT.plan(LINE), r"^<Plan: 81 poses, 6 joints, certified, bottleneck .* rad\^2, no break>$"),
    (BROKEN, r"^<Plan: 81 poses, 6 joints, certified, .*, 14 breaks\nbetween poses 3 and 5\n"),
    (BROKEN, r"\n6 more>$"),
    (ROBOT.follow(LINE, START), r"^<FollowResult: 81 poses, 6 joints, 81 met, no break>$"),
    (ROBOT.follow(FAR, START), r"^<FollowResult: 81 poses, 6 joints, 67 met, 14 breaks\npose 4: "),
    (motion(), r"^Scene\(title='IRB 2600-12/1.65', arms=\(Arm\(.*motion=Motion\(t=<.*points=<"),
]


@pytest.mark.parametrize(("answer", "words"), SHOWN)
def test_an_answer_says_in_ten_lines_what_came_out(answer, words):
    text = repr(answer)
    assert len(text.splitlines()) <= 10
    assert len(text) < 1000
    assert re.search(words, text), text


TABLES = [
    MAP,
    ROBOT.ik(ROBOT.fk(Q)),
    ROBOT.ik_batch(POSES),
    ROBOT.plan(LINE),
    ROBOT.follow(np.stack([LINE, LINE]), START),
    trajectory.joint([0.0] * 6, Q, duration=1.0),
    rapid.calc_targets(ROBOT, rapid.parse_module(PROGRAM)),
]


@pytest.mark.parametrize("answer", TABLES, ids=lambda it: type(it).__name__)
def test_the_columns_of_an_answer_are_a_file(answer, tmp_path):
    columns, file = answer.to_dict(), io.StringIO()
    answer.to_csv(file)
    answer.to_csv(tmp_path / "rows.csv")
    assert (tmp_path / "rows.csv").read_bytes().decode() == file.getvalue()
    head, *rows = csv.reader(io.StringIO(file.getvalue()))
    assert head == list(columns)
    assert len({len(column) for column in columns.values()}) == 1
    assert len(rows) > 1
    for name, *cells in zip(head, *rows, strict=True):
        values = np.asarray(columns[name]).tolist()
        assert cells == ["" if it is None else str(it) for it in values]


def test_the_columns_of_a_map_are_its_positions():
    columns = MAP.to_dict()
    np.testing.assert_array_equal(columns["x"], np.repeat(AXIS, 9))
    np.testing.assert_array_equal(columns["z"], np.tile(AXIS, 9))
    np.testing.assert_array_equal(columns["share"], MAP.share.ravel())


class Bar:
    """What is used of tqdm's."""

    def __init__(self):
        self.n, self.total, self.steps = 0, None, []

    def update(self, n):
        self.n += n
        self.steps.append((self.n, self.total))


def base(progress):
    region = placement.Region(x=(-0.5, 0.5), y=(-0.5, 0.5))
    targets = [irbkin.pose([1.2, 0.1, 0.5], euler_zyx=[0, 3, 0])]
    found = placement.best_base(ROBOT, targets, region, steps=3, progress=progress)
    assert found == placement.best_base(ROBOT, targets, region, steps=3)


def path(progress):
    region = placement.Region(x=(-0.5, 0.5), y=(-0.5, 0.5))
    ends = [irbkin.pose([1.2, y, 0.5], euler_zyx=[0, 3, 0]) for y in (0, 0.1)]
    targets = irbkin.paths.line(*ends, steps=5)
    options = {"path": True, "steps": 4, "refine": False}
    found = placement.best_base(ROBOT, targets, region, progress=progress, **options)
    assert found == placement.best_base(ROBOT, targets, region, **options)


def reach_map(progress):
    irbkin.map.reach(ROBOT, AXIS, 0.0, AXIS, np.eye(3), block=30, progress=progress)


def plan(progress):
    # It takes some tenths of a second, and is reported every twentieth.
    path = paths.line(LINE[0], LINE[-1], steps=1200)
    options = {"rotation": 36, "tolerance": irbkin.ToolCone(0.1)}
    assert ROBOT.plan(path, progress=progress, **options) == ROBOT.plan(path, **options)


def test_a_plan_reports_its_progress():
    calls = []
    plan(lambda *both: calls.append(both))
    assert len(calls) > 2
    assert calls == sorted(calls)
    assert [total for _, total in calls] == sorted(total for _, total in calls)
    assert all(0 <= done <= total for done, total in calls)
    assert calls[-1][0] == calls[-1][1] > 800
    bar = Bar()
    plan(bar)
    assert bar.n == bar.total == calls[-1][0]
    # A short one reports its end.
    ROBOT.plan(LINE, progress=bar)
    assert 0 < bar.n == bar.total < 800

    def stop(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        plan(stop)
    with pytest.raises(TypeError, match="progress must be a callable"):
        plan(5)


WORKS = [(base, 59), (path, 16), (reach_map, 81)]


@pytest.mark.parametrize(("work", "total"), WORKS)
def test_work_reports_its_progress_to_a_callable_and_to_a_bar(work, total):
    calls, bar = [], Bar()
    work(lambda *both: calls.append(both))
    work(bar)
    assert calls[-1] == (total, total)
    assert calls == sorted(calls)
    assert len(set(calls)) > 1
    assert bar.steps == calls
    with pytest.raises(
        TypeError, match=r"a callable f\(done, total\) or a bar such as tqdm\(\), got"
    ):
        work(5)


@pytest.mark.parametrize("work", [work for work, _ in WORKS])
def test_work_ends_with_what_progress_raises(work):
    def stop(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        work(stop)
