"""HTML of notebooks: light tables with small pictures, which need nothing else."""

import re
from html.parser import HTMLParser

import irbkin
import numpy as np
import pytest
from irbkin import scene, trajectory

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
T = irbkin.pose([0.85, 0.32, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0])
MOVE = trajectory.joint(np.zeros(6), np.radians([10, 20, 30, 40, 50, 60]), duration=2.0)
ALONE = {"br", "path", "polyline"}


class Parser(HTMLParser):
    """Checks that all elements are closed in order, and keeps the texts of cells."""

    def __init__(self):
        super().__init__()
        self.open, self.cells = [], []

    def handle_starttag(self, tag, attributes):
        if tag not in ALONE:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in ALONE:
            assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "td":
            self.cells.append(data)


def shown(thing):
    text = thing._repr_html_()
    parser = Parser()
    parser.feed(text)
    assert parser.open == []
    assert "http" not in text.replace("http://www.w3.org/2000/svg", "")
    return text, parser.cells


THINGS = {
    "robot": ROBOT,
    "solutions": ROBOT.ik(T),
    "none": ROBOT.ik(irbkin.pose([9, 0, 0], wxyz=[1, 0, 0, 0])),
    "plan": ROBOT.plan(ROBOT.fk(MOVE.q)),
    "trajectory": MOVE,
    "yumi": irbkin.Robot("IRB 14050"),
}


@pytest.mark.parametrize("name", THINGS)
def test_a_notebook_shows_little(name):
    text, _ = shown(THINGS[name])
    assert len(text) < 14_000
    assert ("<svg" in text) == (name in ("robot", "solutions", "yumi"))


def test_the_table_of_solutions_has_their_angles():
    solutions = THINGS["solutions"]
    text, cells = shown(solutions)
    assert "8 solutions" in text
    rows = [cells[8 * i : 8 * i + 8] for i in range(len(solutions))]
    for row, it in zip(rows, solutions, strict=True):
        np.testing.assert_allclose([float(cell) for cell in row[1:7]], it.q_deg, atol=5e-3)
        assert (row[0], row[7]) == (str(it.slot), "inside" if it.is_within_limits else "outside")
    assert "beyond reach" in shown(THINGS["none"])[0]


def test_the_picture_has_the_faces_of_each_hull_and_the_tones_of_each_capsule():
    for name, least in (("IRB 2600-12/1.65", 2 * 7), ("IRB 140-6/0.81", 3)):
        robot = irbkin.Robot(name)
        text, _ = shown(robot)
        least = least if robot.body.hulls else least * len(robot.body.capsules)
        paths = re.findall(r'<path d="(M[^"]*Z)" fill="(#\w{6})"', text)
        assert len(paths) >= least
        assert len({fill for _, fill in paths}) > 5
        numbers = [float(it) for path, _ in paths for it in re.findall(r"[\d.]+", path)]
        assert 0 <= min(numbers) < 10
        assert 190 < max(numbers) <= 200


def test_a_trajectory_shows_its_peaks():
    _, cells = shown(MOVE)
    np.testing.assert_allclose(
        [float(it) for it in cells[1:7]], np.degrees(MOVE.peaks().velocity), atol=0.05
    )


@pytest.mark.extra
def test_joints_of_a_view_are_any_array_of_their_number(monkeypatch):
    monkeypatch.setattr("irbkin.scene._page.engine", lambda: "")
    import traitlets

    robot = irbkin.Robot("IRB 2600-12/1.65")
    view = scene.of(robot).view()
    q = np.radians([10, 20, -10, 5, 30, 5])
    for given in (q, list(q), tuple(q), robot.ik_nearest(robot.fk(q), q)):
        view.q = given
        np.testing.assert_allclose(view.q, q, atol=1e-9)
        assert isinstance(view.q, list)
        np.testing.assert_allclose(view.T, robot.fk(view.q), atol=1e-12)
    for wrong in ([1, 2, 3], np.zeros(7), np.zeros((1, 6)), "abcdef", 1.0, [np.nan] * 6, None):
        with pytest.raises(traitlets.TraitError, match=r"q must be 6 finite joint angles \[rad\]"):
            view.q = wrong
        np.testing.assert_allclose(view.q, q, atol=1e-9)
