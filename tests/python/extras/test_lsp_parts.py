"""Parts of the language server: texts, programs read in parts, the queue of checks."""

import re

import irbkin
import pytest
from editor import WHOLE, offset, position
from hypothesis import given
from hypothesis import strategies as st
from irbkin._core import check_codes
from irbkin.check.checker import Checker
from irbkin.check.jobs import Job
from irbkin.check.settings import Settings
from irbkin.lsp import reading as reading_module
from irbkin.lsp.code import blocks, calls_at, occurrences
from irbkin.lsp.queue import Queue
from irbkin.lsp.reading import Reading
from irbkin.lsp.session import Session
from irbkin.lsp.text import Text
from irbkin.rapid.program import ModuleFile, program_of
from lsprotocol import types

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
FAR = "[9E9,9E9,9E9,9E9,9E9,9E9]"


class Failing(Checker):
    """The programs of one file, whose checks fail as often as is wanted."""

    def __init__(self, fails):
        super().__init__({}, Settings())
        self.fails = fails

    def sessions(self, path, options):
        self.fail()
        return [Session(Job(None, program_of([]), ""), [path], self)]

    def check(self, job):
        self.fail()
        return super().check(job)

    def fail(self):
        if self.fails:
            self.fails -= 1
            raise ValueError(self.fails)


@pytest.mark.asyncio
@pytest.mark.parametrize("fails", range(3))
async def test_an_error_ends_nothing_but_what_it_is_about(fails):
    errors, done, texts = [], [], {"a.mod": Text("MODULE a\nENDMODULE")}
    queue = Queue(Failing(fails), lambda: texts, done.append, errors.append)
    for _ in range(3):
        queue.open("a.mod", {})
        await queue.rest("a.mod", 10)
    queue.change("a.mod")
    await queue.rest("a.mod", 10)
    queue.stop()
    assert [str(it) for it in errors] == [str(it) for it in reversed(range(fails))]
    assert done[-1].result.job.program.modules[0].name == "a"


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


def typed(texts):
    return {name: Text(text) for name, text in texts.items()}


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
        assert seen(reading.program(typed(texts))) == seen(whole)


def test_only_what_a_change_affects_is_read_again(monkeypatch):
    read, texts = [], {name: versions[1] for name, versions in PARTS.items()}
    reader = reading_module.read_module

    def counted(content, context=None):
        read.append((content.split()[1], context is not None))
        return reader(content, context)

    monkeypatch.setattr(reading_module, "read_module", counted)
    reading = Reading(PARTS)
    first = reading.program(typed(texts))
    read.clear()
    assert reading.program(typed(texts)).modules == first.modules
    assert read == []
    texts["a.mod"] = texts["a.mod"].replace("num n", "! comment\nnum n")
    reading.program(typed(texts))
    assert read == [("a", False), ("a", True)]
    read.clear()
    texts["a.mod"] = texts["a.mod"].replace("100", "101")
    reading.program(typed(texts))
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


WORDS = [":=", ";", "(", ")", "{", "]", ",", "\\", ".", ":", '"', "!", "\n", "\r\n", "1", "é"]
WORDS += [
    "IF",
    "THEN",
    "ENDIF",
    "FOR",
    "ENDFOR",
    "RECORD",
    "ENDRECORD",
    "PROC",
    "VAR",
    "MoveL",
    "a",
]


@given(st.lists(st.sampled_from(WORDS), max_size=12).map(" ".join), st.data())
def test_any_text_may_be_typed(source, data):
    offset = data.draw(st.integers(0, len(source)))
    assert calls_at(source, offset)
    for begin, end, _ in blocks(source):
        assert source[begin:end].split()[0] in WORDS
    before = [at for at in occurrences(source, "a") if at < offset]
    assert all(source[at] == "a" for at in before)


def test_halves_of_characters_are_replaced():
    assert Text("a\ud83db").source == "a\ufffdb"
    assert offset("a😀b", types.Position(0, 3)) == 2


def checks_of(paths):
    """A session of files that counts the groups that are checked."""
    checker = Failing(0)
    checker.codes = {code for code, _, _, _ in check_codes()}
    session = Session(Job(ROBOT, program_of([]), ""), paths, checker)
    checked, check = [], checker.check

    def counted(job):
        checked.extend([[it.name for it in job.program.modules]] if job.robot else [])
        return check(job)

    checker.check = counted
    return session, checker, checked


SPELLED = re.compile(r"; did you mean [^']*\?")
"""Names that are spelled alike are looked for in the group of a module alone."""


def shown(findings):
    return sorted(SPELLED.sub("", str(it)) for it in findings)


def moved(moves):
    """Moves with the modules that they are in, whatever these are counted among."""
    return sorted((module, repr(it).partition("line=")[2]) for module, it in moves)


def all_of(result):
    """The findings and the moves of a result."""
    found = shown(it for own in result.found_in.values() for it in own)
    return found, moved((module, it) for module, own in result.moves.items() for it in own)


@given(st.lists(VERSIONS, min_size=2, max_size=5))
def test_a_program_checked_in_groups_is_the_one_checked_at_once(versions):
    session, checker, _ = checks_of(list(PARTS))
    for texts in versions:
        texts = {name: texts[name] for name in PARTS if texts[name] is not None}
        files = [ModuleFile(name, text.encode()) for name, text in texts.items()]
        checked, found = Checker.check(checker, Job(ROBOT, program_of(files), ""))
        moves = moved((it.module, it) for it in checked.moves)
        assert all_of(session.check(typed(texts))) == (shown(found), moves)


def test_only_groups_that_a_change_affects_are_checked_again():
    names = [f"m{number}.mod" for number in range(4)]
    texts = {
        name: module(f"m{at}", f"CONST {TARGET.format(at, FAR)}", *(it.format(at) for it in MOVE))
        for at, name in enumerate(names)
    }
    texts = {
        name: text.replace("p1", f"p{at}_").replace("tGun", f"t{at}").replace("p2", f"p{at}_")
        for at, (name, text) in enumerate(texts.items())
    }
    session, _, checked = checks_of(names)
    session.check(typed(texts))
    assert checked == [["m0"], ["m1"], ["m2"], ["m3"]]
    checked.clear()
    session.check(typed(texts))
    assert checked == []
    texts["m1.mod"] = texts["m1.mod"].replace("900", "901")
    session.check(typed(texts))
    assert checked == [["m1"]]
    checked.clear()
    texts["m1.mod"] = texts["m1.mod"].replace("ENDPROC", "r3;\nENDPROC")
    session.check(typed(texts))
    assert checked == [["m1", "m3"]]
    checked.clear()
    texts["m3.mod"] = texts["m3.mod"].replace("900", "901")
    session.check(typed(texts))
    assert checked == [["m1", "m3"]]
