"""What `irbkin lsp` does while one edits, asked by a client as editors do."""

import os

import pytest
from backups import backinfo, cfg, written
from editor import editing, part_of
from lsprotocol import types

OPTIONS = {"robot": "IRB 2600-12/1.65"}
FAR = "[9E9,9E9,9E9,9E9,9E9,9E9]"
DATA = f"""MODULE Data(SYSMODULE)
    PERS tooldata tGun:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
    PERS wobjdata wFix:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    CONST robtarget pAway:=[[2900,0,500],[0,0,1,0],[0,0,0,0],{FAR}];
    CONST robtarget pNear:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],{FAR}];
    CONST robtarget pCopy:=[[900,-200,500],[0,0,1,0],[1,0,1,0],{FAR}];
    CONST jointtarget jHome:=[[0,0,0,0,30,0],{FAR}];
    CONST jointtarget jOut:=[[0,0,300,0,30,0],{FAR}];
    CONST speeddata vSlow:=[7,500,5000,1000];
    LOCAL CONST robtarget pOwn:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],{FAR}];
    PROC rShared(\\switch slow | switch fast, robtarget pGiven, PERS tooldata tGiven)
        MoveL pGiven,v5,fine,tGiven\\WObj:=wFix;
    ENDPROC
    FUNC robtarget pAbove(robtarget pGiven)
        RETURN Offs(pGiven,0,0,10);
    ENDFUNC
    LOCAL PROC rHidden()
        MoveL pOwn,v5,fine,tGun;
    ENDPROC
ENDMODULE
"""
MAIN = """MODULE Main
    VAR num nCount;
    PROC main()
        VAR robtarget pLocal;
        MoveJ pNear,v1000,z20,tGun;
        MoveJ pCopy,v200,fine,tGun;
        MoveJ pAway,v1000,fine,tGun;
        FOR i FROM 1 TO 3 DO
            nCount:=nCount+i;
            ! pNear is a comment
            TPWrite "pNear, ""pNear"" too";
            IF nCount=2 rShared \\SLOW,PNEAR,tGun;
        ENDFOR
    ENDPROC
    PROC rOther()
        VAR num i;
        i:=nCount;
        rShared pAbove(pNear),tGun;
    ENDPROC
ENDMODULE
"""
HERE = "        MoveJ pCopy"


@pytest.fixture
def program(tmp_path):
    (tmp_path / "data.sys").write_text(DATA)
    (tmp_path / "main.mod").write_text(MAIN)
    return tmp_path


@pytest.mark.parametrize(
    "line",
    [
        "MoveL Offs(pNear,0,0,10),v100,z1,tGun\\WObj:=wFix;",
        "nCount:=nCount+1;",
        'TPWrite "a text; " + "of two";',
        "rShared \\slow, pNear, tGun; ! a comment",
    ],
)
@pytest.mark.asyncio
async def test_an_error_is_in_the_line_that_is_typed_and_what_follows_stays(program, line):
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(program / "main.mod")
        before = {it.code for it in await editor.marks(uri)}
        editor.change(uri, HERE, f"\n{HERE}")
        row = editor.texts[uri][1].split("\n").index("")
        rest = [(it.range.start.line, it.code) for it in await editor.marks(uri)]
        assert before == {"C201", "R101"}
        wrong = 0
        for end in range(len(line)):
            editor.insert(uri, f"\n{HERE}", line[end])
            marks = await editor.marks(uri)
            wrong += any(it.code == "E001" for it in marks)
            assert {it.range.start.line for it in marks if it.code == "E001"} <= {row}
            below = [(it.range.start.line, it.code) for it in marks if it.range.start.line > row]
            assert below == rest
        assert wrong >= line.index(";") - 1
        assert not any(it.code == "E001" for it in marks)


@pytest.mark.asyncio
async def test_what_may_be_written_depends_on_the_place(program):
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(program / "main.mod")
        await editor.marks(uri)

        async def offered(typed, trigger=None):
            editor.write(uri, MAIN.replace(HERE, f"        {typed}\n{HERE}"))
            return await editor.labels(uri, f"        {typed}\n", 8 + len(typed), trigger)

        for typed in ("", "Mo", "IF nCount=1 ", "IF nCount=1 THEN ", "MoveL pNear,v5,z1,tGun; "):
            found = await offered(typed)
            assert {"MoveL", "TPWrite", "rShared", "rOther", "IF", "nCount", "pLocal"} <= {*found}
            assert {"rHidden", "pNear", "v1000", "Offs"}.isdisjoint(found)
        assert await offered("", " ") == []
        for typed in ("MoveL ", "MoveL p", "MoveL\\Conc,", "movec pNear,", "rShared \\fast,"):
            found = await offered(typed)
            assert found[:2] == ["pLocal", "pNear"]
            assert found[-2:] == ["pAway", "pCopy"]
            assert {"Offs", "pAbove"} <= {*found}
            assert {"pOwn", "jHome", "v1000", "tGun", "MoveL", "nCount"}.isdisjoint(found)
        assert await offered("MoveAbsJ ") == ["jHome", "CalcJointT", "CJointT", "jOut"]
        found = await offered("MoveL pNear,")
        assert found[:4] == ["vSlow", "v5", "v10", "v20"]
        assert found[-1] == "vmax"
        assert (await offered("MoveL pNear,v5,"))[:3] == ["fine", "z0", "z1"]
        assert await offered("MoveL Offs(pNear,1,2,3),v5\\V:=7,z1,") == ["tGun", "tool0"]
        assert await offered("MoveL pNear,v5,z1,tGun\\WObj:=") == ["wFix", "wobj0"]
        assert await offered("MoveL pNear,v5,z1,tGun,") == []
        assert (await offered("nCount:="))[0] == "nCount"
        assert {"tGun", "tool0"} <= {*await offered("PERS tooldata tNew:=")}
        assert "robtarget" in await offered("VAR ")
        assert await offered("VAR num ") == []
        assert await offered("! Mo") == []
        assert await offered('TPWrite "Mo') == []
        assert await offered("rShared pNear,") == ["tGun", "tool0"]
        assert await offered("pLocal.") == []


@pytest.mark.asyncio
async def test_options_are_those_of_what_is_called_that_are_not_written(program):
    async with editing(options=OPTIONS) as editor:
        text = MAIN.replace(
            HERE, f"        MoveL\\Conc,pNear,v5,z1,tGun\\;\n        rShared \\\n{HERE}"
        )
        uri = editor.open(program / "main.mod", text)
        found = await editor.completions(uri, "tGun\\;", 5, "\\")
        assert [it.label for it in found] == ["Corr", "ID", "Inpos", "T", "TLoad", "V", "WObj", "Z"]
        assert {it.label: it.insert_text for it in found}["WObj"] == "WObj:="
        assert {it.label: it.insert_text for it in found}["Corr"] == "Corr"
        assert await editor.labels(uri, "rShared \\\n", 9) == ["fast", "slow"]


@pytest.mark.asyncio
async def test_why_a_target_comes_last_is_said(program):
    async with editing(options=OPTIONS) as editor:
        text = MAIN.replace(HERE, f"        MoveL \n{HERE}")
        uri = editor.open(program / "main.mod", text)
        found = {it.label: it.detail for it in await editor.completions(uri, "MoveL \n", 6)}
        assert found["pNear"] == "CONST robtarget pNear"
        assert found["pAway"] == "R101 out-of-reach"
        assert found["pCopy"] == "C201 wrong-confdata"


@pytest.mark.asyncio
async def test_of_very_many_names_the_nearest_are_offered_and_those_that_are_typed(program):
    many = "".join(f"    CONST num nMany{number}:=1;\n" for number in range(3000))
    (program / "many.sys").write_text(f"MODULE Many(SYSMODULE)\n{many}ENDMODULE\n")
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(program / "main.mod", MAIN.replace(HERE, f"        nCount:=\n{HERE}"))
        found = await editor.labels(uri, "nCount:=\n", 8)
        assert len(found) == 1000
        assert found[0] == "nCount"
        editor.insert(uri, f"\n{HERE}", "MANY2999")
        assert await editor.labels(uri, "MANY2999", 8) == ["nMany2999"]


@pytest.mark.asyncio
async def test_the_parameter_of_a_call_is_shown(program):
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(program / "main.mod")
        header, at = await editor.parameter(uri, "pNear,v1000", 0)
        assert header.startswith("PROC MoveJ(\\switch Conc, robtarget ToPoint")
        assert at == "robtarget ToPoint"
        assert (await editor.parameter(uri, "v1000,z20", 4))[1] == "speeddata Speed"
        assert (await editor.parameter(uri, "z20,tGun", 4))[1] == "PERS tooldata Tool"
        header, at = await editor.parameter(uri, "SLOW,PNEAR", 5)
        assert header.startswith("PROC rShared(")
        assert at == "robtarget pGiven"
        header, at = await editor.parameter(uri, "pAbove(pNear)", 7)
        assert (header, at) == ("FUNC robtarget pAbove(robtarget pGiven)", "robtarget pGiven")
        assert (await editor.parameter(uri, "pAbove(pNear),tGun", 14))[1] == "PERS tooldata tGiven"
        assert await editor.parameter(uri, "nCount+i", 3) is None


@pytest.mark.asyncio
async def test_references_are_over_the_program_outside_strings_and_comments(program):
    async with editing(options=OPTIONS) as editor:
        uri, data = editor.open(program / "main.mod"), program / "data.sys"
        near = [("data.sys", 5), ("main.mod", 5), ("main.mod", 12), ("main.mod", 18)]
        assert await editor.references(uri, "pNear,v1000") == near
        assert await editor.references(uri, "pNear,v1000", is_whole=False) == near[1:]
        assert await editor.references(uri, "rShared pAbove") == [
            ("data.sys", 11),
            ("main.mod", 12),
            ("main.mod", 18),
        ]
        # A counter is its loop's, an option its routine's.
        assert await editor.references(uri, "i FROM") == [("main.mod", 8), ("main.mod", 9)]
        assert await editor.references(uri, "i;\n        i:=") == [
            ("main.mod", 16),
            ("main.mod", 17),
        ]
        assert await editor.references(uri, "SLOW,") == [("data.sys", 11), ("main.mod", 12)]
        assert await editor.references(uri, "pNear is a comment") == []
        assert await editor.references(uri, "v1000") == []
        open_data = editor.open(data)
        own = [("data.sys", 11), ("data.sys", 12)]
        assert await editor.references(open_data, "pGiven, PERS") == own
        assert await editor.references(open_data, "pGiven)\n") == [
            ("data.sys", 14),
            ("data.sys", 15),
        ]
        assert await editor.references(open_data, "pOwn,v5") == [("data.sys", 10), ("data.sys", 18)]


@pytest.mark.asyncio
async def test_a_name_is_changed_over_the_program(program):
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(program / "main.mod")
        before = await editor.codes(uri)
        assert before == ["C201", "R101"]
        (data,) = (await editor.rename(uri, "PNEAR,", "pSeam")).values()
        assert data == DATA.replace("pNear", "pSeam")
        main = MAIN.replace("MoveJ pNear", "MoveJ pSeam").replace("PNEAR", "pSeam")
        assert editor.texts[uri][1] == main.replace("(pNear)", "(pSeam)")
        other = editor.open(program / "data.sys", data)
        assert await editor.marks(other) == ()
        assert await editor.rename(uri, "SLOW,", "calm") == {}
        assert await editor.codes(uri) == before
        assert "\\switch calm | switch fast" in editor.texts[other][1]
        assert "rShared \\calm,pSeam" in editor.texts[uri][1]
        await editor.rename(uri, "i FROM", "k")
        assert "FOR k FROM 1 TO 3 DO\n            nCount:=nCount+k;" in editor.texts[uri][1]
        assert "VAR num i;" in editor.texts[uri][1]
        assert await editor.rename(uri, "pLocal;", "PLOCAL") == {}
        assert "VAR robtarget PLOCAL;" in editor.texts[uri][1]
        spot = types.PrepareRenameParams(*editor.spot(uri, "nCount;"))
        area = await editor.client.text_document_prepare_rename_async(spot)
        assert part_of(editor.texts[uri][1], area) == "nCount"
        spot = types.PrepareRenameParams(*editor.spot(uri, "TPWrite"))
        assert await editor.client.text_document_prepare_rename_async(spot) is None


@pytest.mark.parametrize(
    ("part", "new", "why"),
    [
        ("pNear,v1000", "2nd", "is not a RAPID identifier"),
        ("pNear,v1000", "p near", "is not a RAPID identifier"),
        ("pNear,v1000", "EndProc", "is not a RAPID identifier"),
        ("pNear,v1000", "p" * 33, "more than RAPID's 32"),
        ("pNear,v1000", "movel", "is a name of RAPID itself"),
        ("pNear,v1000", "tool0", "is a name of RAPID itself"),
        ("pNear,v1000", "T_ROB1", "T_ROB1 is the name of a task"),
        ("pNear,v1000", "PCOPY", "PCOPY is taken: "),
        ("pNear,v1000", "pLocal", "pLocal is taken: "),
        ("nCount;", "rother", "rother is taken: "),
        ("pLocal;", "pNear", "pNear is taken: "),
        ("TPWrite", "pNew", "nothing that is declared is here"),
        ("pNear is a", "pNew", "nothing that is declared is here"),
        ("main()", "rMain", "a controller begins at main: "),
        ("rOther()", "Main", "a controller begins at main: "),
    ],
)
@pytest.mark.asyncio
async def test_a_name_that_cannot_be_is_refused(program, part, new, why):
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(program / "main.mod")
        assert why in await editor.rename(uri, part, new)
        assert editor.texts[uri][1] == MAIN
        assert editor.messages() == []


@pytest.mark.asyncio
async def test_a_name_is_changed_in_all_tasks_that_share_its_module(tmp_path):
    record = f"[[900,-300,500],[0,0,1,0],[-1,0,-1,0],{FAR}]"
    shared = f"MODULE Shared\n CONST robtarget pBoth:={record};\n"
    shared += " PROC rBoth()\n  rTask;\n  MoveL pBoth,v5,fine,tool0;\n ENDPROC\nENDMODULE\n"
    files = {"HOME/Shared.sys": shared}
    for n, own in ((1, "One"), (2, "Two"), (3, "Three")):
        text = f"MODULE {own}\n PROC rTask()\n  MoveL pBoth,v5,fine,tool0;\n ENDPROC\nENDMODULE\n"
        files[f"RAPID/TASK{n}/PROGMOD/{own}.mod"] = text
    tasks = [f'-Name "T{n}" -Type "NORMAL"' for n in (1, 2, 3)]
    both = [f'-File "HOME:/Shared.sys" -ModName "Shared" -Task "T{n}"' for n in (1, 2)]
    files["SYSPAR/SYS.cfg"] = cfg("SYS", "6:0", CAB_TASKS=tasks, CAB_TASK_MODULES=both)
    files["BACKINFO/backinfo.txt"] = backinfo(("T1",), ("T2",), ("T3",))
    paths = {name: written(tmp_path, files) / name for name in files if name.endswith(("od", "ys"))}
    for part, new, name in (("pBoth", "pNew", "Shared.sys"), ("rTask", "rOwn", "One.mod")):
        first = next(path for path in paths.values() if path.name == name)
        async with editing() as editor:
            uri = editor.open(first)
            await editor.marks(uri)
            others = await editor.rename(uri, part, new)
            texts = {path: others.get(path.as_uri(), files[it]) for it, path in paths.items()}
            texts[first] = editor.texts[uri][1]
        for it, path in paths.items():
            text = files[it] if "Three" in it else files[it].replace(part, new)
            assert texts[path] == text, path
    (two,) = (path for path in paths.values() if path.name == "Two.mod")
    two.write_text(two.read_text().replace("PROC rTask", "PROC pTaken() ENDPROC PROC rTask"))
    async with editing() as editor:
        uri = editor.open(paths["RAPID/TASK1/PROGMOD/One.mod"])
        await editor.marks(uri)
        assert f"pTaken is taken: {two}:2" in await editor.rename(uri, "rTask", "pTaken")


async def renamed_after(program, change):
    """The text of a file that a change on the disk leaves, after a rename in another one."""
    data = program / "data.sys"
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(program / "main.mod")
        await editor.marks(uri)
        change(data)
        others = await editor.rename(uri, "pNear,v1000", "pSeam")
    assert data.read_text().count("pNear") == others[data.as_uri()].count("pSeam") > 0
    return others


@pytest.mark.asyncio
async def test_a_file_that_is_not_open_is_edited_as_it_is_on_the_disk(program):
    def lengthen(data):
        data.write_text(DATA.replace("MODULE", "! a line\nMODULE", 1))

    def swap(data):
        # As long as before, with the time of before.
        at = data.stat()
        old, new = "    CONST robtarget pNear:=", "  CONST robtarget  pNear :="
        data.write_text(DATA.replace(old, new))
        os.utime(data, ns=(at.st_atime_ns, at.st_mtime_ns))

    for change in (lengthen, swap):
        (program / "data.sys").write_text(DATA)
        others = await renamed_after(program, change)
        text = (program / "data.sys").read_text()
        assert others[(program / "data.sys").as_uri()] == text.replace("pNear", "pSeam")


@pytest.mark.asyncio
async def test_a_file_that_came_to_the_folder_is_renamed_in_too(program):
    late = program / "late.mod"
    others = await renamed_after(
        program, lambda _: late.write_text(MAIN.replace("Main", "Late").replace("main", "rLate"))
    )
    assert others[late.as_uri()].count("pSeam") == 3


def two_tasks(folder, left, right):
    """A backup with a module in each of two tasks; the files of the modules."""
    tasks = ['-Name "T_ROB1" -Type "NORMAL"', '-Name "T_ROB2" -Type "NORMAL"']
    signals = ['-Name "doGrip" -SignalType "DO"', '-Name "diPart" -SignalType "DI"']
    signals += ['-Name "doAir" -SignalType "DO"', '-Name "goNumber" -SignalType "GO"']
    signals += ['-Name "aoGlue" -SignalType "AO"', '-Name "aiForce" -SignalType "AI"']
    files = {
        "RAPID/TASK1/PROGMOD/Left.mod": left,
        "RAPID/TASK2/PROGMOD/Right.mod": right,
        "SYSPAR/SYS.cfg": cfg("SYS", "6:0", CAB_TASKS=tasks),
        "SYSPAR/EIO.cfg": cfg("EIO", "6:0", EIO_SIGNAL=signals),
        "BACKINFO/backinfo.txt": backinfo(("T_ROB1",), ("T_ROB2",)),
    }
    root = written(folder, files)
    return [root / name for name in list(files)[:2]]


def of_task(name, storage):
    return f"""MODULE {name}
 {storage} num nShared:=1;
 PROC main()
  nShared:=nShared+1;
  Stop;
 ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("storages", "is_one"),
    [
        (("PERS", "PERS"), True),
        (("PERS", "TASK PERS"), False),
        (("PERS", "VAR"), False),
        (("TASK PERS", "PERS"), False),
        (("LOCAL PERS", "PERS"), False),
    ],
)
@pytest.mark.asyncio
async def test_a_pers_is_one_datum_in_all_tasks_of_a_backup(tmp_path, storages, is_one):
    texts = [of_task(*pair) for pair in zip(("Left", "Right"), storages, strict=True)]
    left, right = two_tasks(tmp_path, *texts)
    async with editing() as editor:
        uri = editor.open(left)
        others = await editor.rename(uri, "nShared:=nS", "nBoth")
        assert editor.texts[uri][1] == texts[0].replace("nShared", "nBoth")
    assert others == ({right.as_uri(): texts[1].replace("nShared", "nBoth")} if is_one else {})


@pytest.mark.asyncio
async def test_a_pers_of_several_tasks_gets_no_name_that_one_of_them_has(tmp_path):
    taken = of_task("Right", "PERS").replace("Stop;", "nTaken:=1;")
    left, right = two_tasks(tmp_path, of_task("Left", "PERS"), taken)
    async with editing() as editor:
        uri = editor.open(left)
        refused = await editor.rename(uri, "nShared:=nS", "nTaken")
        assert refused == f"nTaken is taken: {right}:5"


@pytest.mark.parametrize(
    ("part", "new", "why"),
    [
        ("nShared", "T_ROB2", "T_ROB2 is the name of a task"),
        ("nShared", "t_rob1", "t_rob1 is the name of a task"),
        ("T_ROB2()", "rStart", "T_ROB2 is the name of a task"),
    ],
)
@pytest.mark.asyncio
async def test_the_name_of_a_task_is_neither_given_nor_changed(tmp_path, part, new, why):
    text = of_task("Left", "PERS").replace("PROC main", "PROC T_ROB2")
    left, _ = two_tasks(tmp_path, text, of_task("Right", "PERS"))
    async with editing() as editor:
        assert why in await editor.rename(editor.open(left), part, new)


@pytest.mark.asyncio
async def test_blocks_are_folded(program):
    text = """! a comment
! of two lines
MODULE Folds
    RECORD rec
        num n;
    ENDRECORD
    PROC main()
        IF nA = 1 TPWrite "IF THEN ; ENDIF";
        IF nA = 2 THEN
            FOR i FROM 1 TO 2 DO
                WHILE TRUE DO
                    Stop;
                ENDWHILE
            ENDFOR
        ELSEIF nA = 3 THEN ! ENDIF
            TEST nA
            CASE 1: Stop;
            ENDTEST
        ENDIF
    ENDPROC
    FUNC num nFunc()
        RETURN 1;
    ENDFUNC
    trap tNow
        Stop;
    endtrap
ENDMODULE
"""
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(program / "folds.mod", text)
        params = types.FoldingRangeParams(types.TextDocumentIdentifier(uri))
        found = await editor.client.text_document_folding_range_async(params)
        lines = sorted((it.start_line + 1, it.end_line + 1) for it in found)
        blocks = [(1, 2), (3, 27), (4, 6), (7, 20), (9, 19), (10, 14), (11, 13), (16, 18)]
        assert lines == [*blocks, (21, 23), (24, 26)]


@pytest.mark.asyncio
async def test_components_of_records_are_no_data(program):
    text = """MODULE Own
    RECORD seam
        num nCount;
        robtarget pNear;
    ENDRECORD
    LOCAL PROC rOwn()
        VAR seam sOwn;
        sOwn.nCount:=nCount;
        MoveL sOwn.pNear,v5,fine,tGun;
    ENDPROC
ENDMODULE
"""
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(program / "own.mod", text)
        found = await editor.references(uri, "nCount;\n        MoveL", is_whole=False)
        assert [line for name, line in found if name == "own.mod"] == [8]
        assert await editor.references(uri, "nCount;\n        robtarget") == []
        assert await editor.references(uri, "seam sOwn") == [("own.mod", 2), ("own.mod", 7)]
        params = types.DocumentSymbolParams(types.TextDocumentIdentifier(uri))
        symbols = await editor.client.text_document_document_symbol_async(params)
        whole = part_of(text, next(it for it in symbols if it.name == "rOwn").range)
        assert whole.startswith("LOCAL PROC rOwn")
        assert whole.endswith("ENDPROC")
        editor.change(uri, "VAR seam", "VAR ")
        assert {"seam", "num"} <= {*await editor.labels(uri, "sOwn;")}


@pytest.mark.asyncio
async def test_signals_are_offered_by_their_types(tmp_path):
    left, _ = two_tasks(tmp_path, of_task("Left", "PERS"), of_task("Right", "PERS"))
    text = left.read_text()
    async with editing() as editor:
        uri = editor.open(left)

        async def offered(typed):
            editor.write(uri, text.replace("Stop;", f"{typed}\n"))
            return await editor.labels(uri, f"{typed}\n", len(typed))

        for typed in ("Set ", "Reset ", "SetDO ", "PulseDO \\PLength:=1, ", "WaitDO ", "InvertDO "):
            assert await offered(typed) == ["doAir", "doGrip"]
        assert (await offered("WaitDI ")) == ["diPart"]
        assert (await offered("SetAO ")) == ["aoGlue"]
        assert (await offered("SetGO ")) == ["goNumber"]
        assert (await offered("WaitAI ")) == ["aiForce"]
        everything = ["aiForce", "aoGlue", "diPart", "doAir", "doGrip", "goNumber"]
        assert (await offered("AliasIO ")) == everything
        assert (await offered("TriggIO trg,0\\GOp:=")) == ["goNumber"]
        assert not {*everything} & {*await offered("nShared:=")}


TOOLS = f"""MODULE Tools
    PERS tooldata tLong:=[TRUE,[[0,0,900],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
    PERS wobjdata wFar:=[FALSE,TRUE,"",[[2000,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    CONST robtarget pNear:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],{FAR}];
    CONST robtarget pLong:=[[900,-300,-300],[0,0,1,0],[-1,0,-1,0],{FAR}];
    CONST robtarget pOfWobj:=[[-1100,-300,500],[0,0,1,0],[-1,0,-1,0],{FAR}];
    CONST robtarget pShifted:=[[-1100,-300,500],[0,0,1,0],[-1,0,-1,0],{FAR}];
    CONST robtarget pUnused:=[[-1100,-300,500],[0,0,1,0],[-1,0,-1,0],{FAR}];
    PROC main()
        MoveJ pOfWobj,v5,fine,tool0\\WObj:=wFar;
        MoveJ Offs(pShifted,0,0,1),v5,fine,tool0\\WObj:=wFar;
        MoveJ pNear,v5,fine,tool0;
        MoveJ pAway,v5,fine,tool0;
        MoveL p;
    ENDPROC
    PROC rOther()
        MoveJ pAway,v5,fine,tool0\\WObj:=wFar;
    ENDPROC
ENDMODULE
"""


@pytest.mark.asyncio
async def test_a_target_is_judged_by_the_moves_that_use_it(tmp_path):
    away = TOOLS.replace("pUnused:=", "pAway:=").splitlines()[7]
    text = TOOLS.replace("    PROC main", f"{away}\n    PROC main", 1)
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(tmp_path / "tools.mod", text)
        await editor.marks(uri)
        found = {it.label: it.detail for it in await editor.completions(uri, "p;\n    ENDPROC", 1)}
        # Of several moves one that reaches it is enough.
        for name in ("pNear", "pOfWobj", "pShifted", "pAway"):
            assert found[name] == f"CONST robtarget {name}"
        # No move uses it: by the move before.
        assert found["pUnused"].startswith(("R101", "R102", "C201"))
        editor.write(uri, text.replace("MoveJ pNear,v5,fine,tool0", "MoveJ pNear,v5,fine,tLong"))
        found = {it.label: it.detail for it in await editor.completions(uri, "p;\n    ENDPROC", 1)}
        await editor.marks(uri)
        found = {it.label: it.detail for it in await editor.completions(uri, "p;\n    ENDPROC", 1)}
        assert found["pOfWobj"] == "CONST robtarget pOfWobj"
