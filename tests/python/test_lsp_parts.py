"""Parts of the language server: texts, programs read in parts, the queue of checks."""

import irbkin
import pytest
from editor import WHOLE, offset, position
from hypothesis import given
from hypothesis import strategies as st
from irbkin.lsp import reading as reading_module
from irbkin.lsp.queue import Queue
from irbkin.lsp.reading import Reading
from irbkin.lsp.text import Text
from irbkin.rapid.program import ModuleFile, program_of
from lsprotocol import types

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
FAR = "[9E9,9E9,9E9,9E9,9E9,9E9]"


class Desk:
    """Tasks of one file that fail as often as is wanted."""

    title, robot, notes = "", None, ()

    def __init__(self, fails):
        self.fails, self.paths = fails, ["a.mod"]

    def tasks(self, path, options):
        self.fail()
        return [self]

    def check(self, program):
        self.fail()
        return None, ()

    def fail(self):
        if self.fails:
            self.fails -= 1
            raise ValueError(self.fails)


@pytest.mark.asyncio
@pytest.mark.parametrize("fails", range(3))
async def test_an_error_ends_nothing_but_what_it_is_about(fails):
    errors, done, texts = [], [], {"a.mod": "MODULE a\nENDMODULE"}
    queue = Queue(Desk(fails), lambda: texts, done.append, errors.append)
    for _ in range(3):
        queue.open("a.mod", {})
        await queue.rest("a.mod", 10)
    queue.change("a.mod")
    await queue.rest("a.mod", 10)
    queue.stop()
    assert [str(it) for it in errors] == [str(it) for it in reversed(range(fails))]
    assert done[-1].result.program.modules[0].name == "a"


def module(name, *lines):
    return "\n".join([f"MODULE {name}", *lines, "ENDMODULE", ""])


TARGET = "robtarget p1:=[[900,{},500],[0,0,1,0],[0,0,0,0],{}];"
MOVE = ["PROC r{0}()", "MoveJ p1,v100,fine,tGun;", "MoveJ p2,v100,fine,tGun;", "ENDPROC"]
PARTS = {
    "a.mod": [
        None,
        module("a", *(f"CONST {TARGET.format(100, FAR)}", "CONST num n:=3;")),
        module("a", *(f"PERS {TARGET.format(200, FAR)}", "CONST num n:=4;")),
        module("a", *(f"LOCAL CONST {TARGET.format(200, FAR)}", "CONST num n:=4;")),
        module("a", f"CONST {TARGET.format(100, FAR)}", "PROC q()", "p2:=p1;", "ENDPROC"),
    ],
    "b.mod": [
        None,
        module("b", "PERS robtarget p2:=p1;", *(it.format("b") for it in MOVE)),
        module("b", "PERS robtarget p2:=Offs(p1,n,0,0);", *(it.format("b") for it in MOVE)),
        module("b", "CONST num n:=1", *(it.format("b") for it in MOVE)),
    ],
    "c.mod": [
        None,
        module("c", "PERS tooldata tGun:=[TRUE,[[0,0,9],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];"),
        module("c", "TASK PERS tooldata tGun;", *(it.format("c") for it in MOVE)),
        module("c", "PROC rC()", "q;", "p1:=p2;", "tGun.tload.mass:=2;", "ENDPROC"),
    ],
}
VERSIONS = st.fixed_dictionaries({name: st.sampled_from(it) for name, it in PARTS.items()})


def seen(program):
    """All that a program shows of itself."""
    checked = program.check(ROBOT)
    faults = [(it.file, it.line, it.code, it.message) for it in program.findings]
    modules = [(it.source, it, [str(part) for part in it.skipped]) for it in program.modules]
    return faults, modules, [str(it) for it in checked.findings], list(checked.moves)


@given(st.lists(VERSIONS, min_size=2, max_size=5))
def test_a_program_read_in_parts_is_the_one_read_at_once(versions):
    reading = Reading(PARTS)
    for texts in versions:
        texts = {name: texts[name] for name in PARTS if texts[name] is not None}
        whole = program_of([ModuleFile(name, text.encode()) for name, text in texts.items()])
        assert seen(reading.program(texts)) == seen(whole)


def test_only_what_a_change_affects_is_read_again(monkeypatch):
    read, texts = [], {name: versions[1] for name, versions in PARTS.items()}
    reader = reading_module.read_module

    def counted(content, context=None):
        read.append((content.split()[1], context is not None))
        return reader(content, context)

    monkeypatch.setattr(reading_module, "read_module", counted)
    reading = Reading(PARTS)
    first = reading.program(texts)
    read.clear()
    assert reading.program(texts).modules == first.modules
    assert read == []
    texts["a.mod"] = texts["a.mod"].replace("num n", "! comment\nnum n")
    reading.program(texts)
    assert read == [("a", False), ("a", True)]
    read.clear()
    texts["a.mod"] = texts["a.mod"].replace("100", "101")
    reading.program(texts)
    assert read == [("a", False), ("a", True), ("b", True)]


def places():
    return st.text(st.sampled_from("aß😀\n\r\x85\u2028;"), max_size=30)


@given(places(), st.data())
def test_offsets_and_positions_are_inverse(source, data):
    text = Text(source)
    at = data.draw(st.integers(0, len(source)))
    if source[at - 1 : at + 1] != "\r\n":
        place = text.position(at)
        assert place == position(source, at)
        assert text.offset(place) == at
    line, column = text.place(at)
    assert text.at(line, column) == at
    assert text.row(line) == source.split("\n")[line - 1].rstrip("\r")
    begin = len(source[:at].encode())
    assert text.range_of_bytes(begin, begin).start == text.position(at)


@given(places(), places(), st.data())
def test_a_change_replaces_its_range(source, new, data):
    text = Text(source)
    begin, end = sorted(data.draw(st.integers(0, len(source))) for _ in range(2))
    area = types.Range(text.position(begin), text.position(end))
    begin, end = text.offset(area.start), text.offset(area.end)
    changed = text.changed(types.TextDocumentContentChangePartial(area, new))
    assert changed.source == source[:begin] + new + source[end:]
    assert text.changed(WHOLE(new)).source == new


def test_halves_of_characters_are_replaced():
    assert Text("a\ud83db").source == "a\ufffdb"
    assert offset("a😀b", types.Position(0, 3)) == 2
