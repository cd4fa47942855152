"""Xacro files: what is expanded, and what a message says is missing."""

import sys

import irbkin
import pytest
from irbkin import _bounded
from irbkin._xacro import expanded
from irbkin.errors import InvalidModelError

HEAD = '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">'
# A chain of six joints, whose lengths an included file has.
AXES = ["0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"]
MACRO = """<xacro:macro name="turn" params="n axis">
  <link name="${prefix}link_${n}"/>
  <joint name="${prefix}joint_${n}" type="revolute">
    <parent link="${prefix}link_${n - 1}"/><child link="${prefix}link_${n}"/>
    <origin xyz="0 0 ${length}"/><axis xyz="${axis}"/>
    <limit lower="${-pi / 2}" upper="${pi / 2}" effort="0" velocity="1"/>
  </joint></xacro:macro>"""


def file(folder, body, name="arm.urdf.xacro"):
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"{HEAD}{body}</robot>")
    return path


def arm(prefix="$(arg prefix)"):
    turns = (f'<xacro:turn n="{n}" axis="{axis}"/>' for n, axis in enumerate(AXES, 1))
    return (
        f'<xacro:property name="prefix" value="{prefix}"/>{MACRO}'
        f'<link name="${{prefix}}link_0"/>{"".join(turns)}'
    )


def package(folder, name, length=0.25):
    (folder / name).mkdir()
    file(folder, f'<xacro:property name="length" value="{length}"/>', f"{name}/urdf/lengths.xacro")
    return folder / name


def fault(path, *arguments):
    with pytest.raises(InvalidModelError) as caught:
        expanded(path, *arguments)
    words = str(caught.value)
    assert "\n" not in words
    assert words.startswith(str(path) if "<" not in str(path) else "the text: ")
    return words.removeprefix(str(path)).removeprefix("the text").lstrip(": ")


def test_a_file_with_an_argument_an_include_and_a_package_is_a_robot(tmp_path):
    package(tmp_path, "arm_data")
    find = '<xacro:include filename="$(find arm_data)/urdf/lengths.xacro"/>'
    path = file(tmp_path, find + arm(), "arm_support/urdf/arm.urdf.xacro")
    robot = irbkin.Robot.from_urdf(path, args={"prefix": "left_"})
    assert robot.joint_names == tuple(f"left_joint_{n}" for n in range(1, 7))
    assert robot.fk([0] * 6)[2, 3] == 6 * 0.25
    assert robot.limits[0, 1] == pytest.approx(1.5707963267948966, abs=0)


def test_includes_are_relative_to_their_file(tmp_path, monkeypatch):
    file(tmp_path, '<xacro:property name="length" value="0.5"/>', "parts/b.xacro")
    file(tmp_path, '<xacro:include filename="b.xacro"/>', "parts/a.xacro")
    path = file(tmp_path, '<xacro:include filename="parts/a.xacro"/>' + arm("x_"))
    monkeypatch.chdir("/")
    assert 'xyz="0 0 0.5"' in expanded(path)


def test_a_text_and_a_plain_urdf_are_expanded():
    assert "<link name='2'" in expanded(f'{HEAD}<link name="${{1 + 1}}"/></robot>').replace(
        '"', "'"
    )
    assert "xacro" not in expanded("<robot name='a'><link name='b'/></robot>")


def test_a_package_that_is_missing_is_named_and_can_be_given(tmp_path):
    find = '<xacro:include filename="$(find far_data)/urdf/lengths.xacro"/>'
    path = file(tmp_path, find + arm("x_"), "here/arm.xacro")
    words = "the package 'far_data' is not found: pass packages={'far_data': folder}"
    assert fault(path) == words
    (tmp_path / "there").mkdir()
    there = package(tmp_path / "there", "any_name")
    assert 'xyz="0 0 0.25"' in expanded(path, {}, {"far_data": there})


def test_an_argument_without_a_value_is_named(tmp_path):
    path = file(tmp_path, '<link name="$(arg side)_link"/>')
    words = "the argument 'side' has no value: pass args={'side': value}"
    assert fault(path) == words
    assert fault(path, {"sides": "left"}) == words
    assert "left_link" in expanded(path, {"side": "left"})


def test_a_file_that_is_missing_is_named_with_the_arguments_that_may_choose_it(tmp_path):
    model = '<xacro:arg name="model" default="none"/>'
    path = file(tmp_path, f'{model}<xacro:include filename="$(arg model).xacro"/>')
    absent = str(tmp_path / "none.xacro")
    assert fault(path) == f"{absent!r}: No such file or directory (arguments of the file: model)"
    with pytest.raises(FileNotFoundError):
        expanded(tmp_path / "absent.xacro")


@pytest.mark.parametrize("body", ["", "<link name='a'/>" * 6000])
def test_a_file_that_includes_itself_is_refused(tmp_path, body):
    path = file(tmp_path, body + '<xacro:include filename="arm.urdf.xacro"/>')
    assert fault(path).endswith("includes itself")


def test_a_condition_may_end_an_inclusion(tmp_path):
    guard = '<xacro:property name="n" default="0"/><xacro:if value="${n == 0}">'
    body = '<xacro:property name="n" value="1"/><xacro:include filename="arm.urdf.xacro"/>'
    assert "once" in expanded(file(tmp_path, f'{guard}{body}<link name="once"/></xacro:if>'))


def test_an_expression_that_fails_is_named_with_its_line(tmp_path):
    path = file(tmp_path, '\n\n<link name="${width / 2}"/>')
    assert fault(path) == ", line 3: ${width / 2}: name 'width' is not defined"
    file(tmp_path, '\n<xacro:property name="w" value="${1 / 0}"/>', "b.xacro")
    path = file(tmp_path, '<xacro:include filename="b.xacro"/><link name="${w}"/>')
    assert "b.xacro, line 2: ${1 / 0}: division by zero" in fault(path)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("<link>", "mismatched tag: line 1"),
        ("<xacro:nope/>", "unknown macro name: xacro:nope"),
        (
            '<xacro:macro name="m" params="a"/><xacro:m b="1"/>',
            "Invalid parameter \"b\" (macro 'm')",
        ),
        ('<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>', "calls itself without end"),
        ("<a>" * 20000 + "</a>" * 20000, "nested too deeply"),
        ('<link name="${9 ** 9 ** 9}"/>', "takes more than 1 s to read"),
        ('<link name="${[0] * 10 ** 10}"/>', "needs more than 150 MB to read"),
    ],
)
def test_broken_and_hostile_files_are_refused_in_bounded_time(body, words):
    assert words in fault(f"{HEAD}{body}</robot>")


def test_the_readers_process_does_not_import_from_the_working_folder(tmp_path, monkeypatch):
    (tmp_path / "json.py").write_text("raise SystemExit(3)")
    (tmp_path / "xacro.py").write_text("raise SystemExit(3)")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [it for it in sys.path if it])
    assert "link" in expanded(f'{HEAD}<link name="a"/></robot>')


def test_a_reader_that_ends_without_an_answer_is_refused():
    with pytest.raises(InvalidModelError, match="xacrodoc ended with code 7"):
        _bounded.call("xacrodoc", "os._exit", 7)


def test_without_the_extra_its_name_is_in_the_error(monkeypatch):
    monkeypatch.setitem(sys.modules, "xacrodoc", None)
    with pytest.raises(ImportError, match=r"a xacro file needs xacrodoc: .*irbkin\[xacro\]"):
        expanded("<robot name='a'/>")
