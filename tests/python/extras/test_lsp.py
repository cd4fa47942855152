"""`irbkin lsp`, asked by a client as editors do."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import irbkin
import numpy as np
import pytest
from editor import editing, part_of
from irbkin.lsp.server import WATCHED
from lsprotocol import types

ROOT = Path(__file__).parents[3]
NAME = "IRB 2600-12/1.65"
FAR = "[9E9,9E9,9E9,9E9,9E9,9E9]"
SEAM = f"""MODULE Seam
    PERS tooldata tGun:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
    CONST robtarget pNear:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],{FAR}];
    CONST robtarget pCopy:=[[900,-200,500],[0,0,1,0],[1,0,1,0],{FAR}];
    CONST robtarget pAway:=[[2900,0,500],[0,0,1,0],[0,0,0,0],{FAR}];
    PROC main()
        MoveJ pNear,v1000,z20,tGun;
        MoveJ pCopy,v200,fine,tGun;
        MoveJ pAway,v1000,fine,tGun;
    ENDPROC
ENDMODULE
"""
OPTIONS = {"robot": NAME}


@pytest.fixture
def seam(tmp_path):
    file = tmp_path / "seam.mod"
    file.write_text(SEAM)
    return file


@pytest.fixture
def backup(tmp_path):
    return shutil.copytree(ROOT / "examples" / "backup", tmp_path / "backup")


def main_of(backup):
    return backup / "RAPID" / "TASK1" / "PROGMOD" / "MainModule.mod"


@pytest.mark.asyncio
async def test_findings_come_with_their_statement_and_go(seam):
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(seam)
        wrong, away = await editor.marks(uri)
        assert (wrong.code, wrong.source) == ("C201", "irbkin")
        assert wrong.severity == types.DiagnosticSeverity.Error
        assert part_of(SEAM, wrong.range) == "MoveJ pCopy,v200,fine,tGun"
        assert "[-1, 0, -1, 0]" in wrong.message
        address, _, anchor = wrong.code_description.href.partition("#")
        assert anchor == "c201-wrong-confdata"
        assert "### C201 wrong-confdata" in Path(address.removeprefix("file://")).read_text()
        assert part_of(SEAM, away.range) == "MoveJ pAway,v1000,fine,tGun"
        editor.change(uri, "[2900,0,500]", "[900,0,500]")
        assert await editor.codes(uri) == ["C201"]
        editor.change(uri, "500],[0,0,1,0],[1,0,1,0]", "500],[0,0,1,0],[-1,0,-1,0]")
        assert await editor.marks(uri) == ()
        assert seam.read_text() == SEAM
        editor.write(uri, SEAM)
        assert await editor.codes(uri) == ["C201", "R101"]
        editor.close(uri)
        while editor.published[-1].diagnostics:
            await editor.client.wait_for_notification("textDocument/publishDiagnostics")


@pytest.mark.asyncio
async def test_the_tool_of_the_options_stands_for_undeclared_ones(seam):
    text = SEAM.replace(",tGun;", ",tGrip;", 1)
    for tool, is_said in (({}, True), ({"tool": [0, 0, 180]}, False)):
        async with editing(seam.parent, options={"robot": NAME, **tool}) as editor:
            codes = await editor.codes(editor.open(seam, text))
        assert ("N602" in codes) == is_said, codes


@pytest.mark.parametrize("here", ["project", "moves", ".", "elsewhere", "link"])
@pytest.mark.asyncio
async def test_findings_and_corrections_in_any_working_folder(tmp_path, monkeypatch, here):
    lines = SEAM.splitlines()
    data = "\n".join(["MODULE Data(SYSMODULE)", *lines[1:5], "MoveJ;", "ENDMODULE", ""])
    (moves := tmp_path / "project" / "moves").mkdir(parents=True)
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "link").symlink_to("project")
    (moves / "seam.mod").write_text("\n".join(["MODULE Moves", *lines[5:], ""]))
    (moves.parent / "data.sys").write_text(data)
    options = f'[check]\nrobot = "{NAME}"\nper-file-ignores = {{ "data.sys" = ["E"] }}\n'
    (moves.parent / "irbkin.toml").write_text(options)
    monkeypatch.chdir(moves if here == "moves" else tmp_path / here)
    for root in ("project", "link"):
        async with editing(tmp_path / root) as editor:
            uri = editor.open(tmp_path / root / "moves" / "seam.mod")
            assert await editor.codes(uri) == ["C201", "R101"]
            quick, _ = await editor.actions(uri, "MoveJ pCopy")
            other = (tmp_path / root / "data.sys").as_uri()
            assert list(quick.edit.changes) == [other]
            assert "**C201** wrong-confdata" in await editor.hover(uri, "MoveJ pCopy")
            assert await editor.marks(editor.open(tmp_path / root / "data.sys")) == ()
    (moves.parent / "arm.urdf").write_text(irbkin.Robot(NAME).to_urdf())
    async with editing(moves.parent, options={"robot": "arm.urdf"}) as editor:
        await editor.codes(editor.open(moves / "seam.mod"))
        assert "**pCopy**" in await editor.hover(editor.open(moves / "seam.mod"), "MoveJ pCopy")
        assert editor.messages() == []


@pytest.mark.asyncio
async def test_the_text_counts_as_it_is_typed(seam):
    many = SEAM.replace(
        "    ENDPROC", 500 * "        MoveJ pNear,v1000,fine,tGun;\n" + "    ENDPROC"
    )
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(seam, many)
        assert await editor.codes(uri) == ["C201", "R101"]
        typed = "        MoveJ pAway"
        for end in range(len(typed)):
            at = "        MoveJ pNear"
            editor.change(uri, typed[:end] + at, typed[: end + 1] + at)
        broken = await editor.codes(uri)
        assert "E001" in broken
        editor.change(uri, typed, "")
        assert await editor.codes(uri) == ["C201", "R101"]
        # Of versions that follow each other without a pause only the last must be checked.
        versions = {it.version for it in editor.published}
        assert len(versions) < len(typed)


@pytest.mark.asyncio
async def test_without_an_arm_only_the_text_is_checked(seam):
    async with editing() as editor:
        uri = editor.open(seam)
        assert await editor.marks(uri) == ()
        editor.change(uri, "ENDPROC", "ENDPROCC")
        assert await editor.codes(uri) == ["E001", "E001"]
        (message,) = editor.messages()
        assert "no arm is known for seam.mod" in message
        assert "irbkin.toml" in message
        assert "tooldata" in await editor.hover(uri, "tGun;")


@pytest.mark.parametrize("client", ["visual-studio-code", "neovim", "emacs"])
@pytest.mark.asyncio
async def test_the_arm_of_a_file_of_options(seam, client):
    toml = (
        f'[check]\nrobot = "{NAME}"\nignore = ["R101"]\nper-file-ignores = {{ "no.mod" = ["C"] }}'
    )
    (seam.parent / "irbkin.toml").write_text(toml)
    async with editing(seam.parent, client=client) as editor:
        assert await editor.codes(editor.open(seam)) == ["C201"]
        shutil.copy(seam, other := seam.with_name("no.mod"))
        assert await editor.codes(editor.open(other, SEAM.replace("Seam", "No"))) == []
        assert editor.messages() == []


@pytest.mark.asyncio
async def test_the_arm_of_the_command_of_options_and_of_settings(seam):
    async with editing(None, "--robot", "IRB 2600-12/1.85") as editor:
        assert await editor.codes(editor.open(seam)) == ["C201", "R101"]
    settings = {"irbkin": {"robot": NAME, "limits": [[1, -5, 5]]}}
    async with editing(settings=settings) as editor:
        uri = editor.open(seam)
        while await editor.codes(uri) == []:
            await editor.client.wait_for_notification("textDocument/publishDiagnostics")
        assert "R102" in await editor.codes(uri)
        editor.client.set_configuration({"irbkin": {"robot": NAME}})
        editor.client.workspace_did_change_configuration(
            types.DidChangeConfigurationParams(settings=None)
        )
        while "R102" in await editor.codes(uri):
            await editor.client.wait_for_notification("textDocument/publishDiagnostics")
        assert await editor.codes(uri) == ["C201", "R101"]


@pytest.mark.asyncio
async def test_wrong_options_are_a_message(seam):
    async with editing(options={"robot": "IRB 26000"}) as editor:
        assert await editor.marks(editor.open(seam)) == ()
        assert "IRB 2600" in editor.messages()[0]
    async with editing(options={"robbot": NAME}) as editor:
        assert await editor.marks(editor.open(seam)) == ()
        assert "unknown key; did you mean robot?" in editor.messages()[0]
    (seam.parent / "irbkin.toml").write_text("[check]\nrobot = 3\n")
    async with editing() as editor:
        assert await editor.marks(editor.open(seam)) == ()
        assert "irbkin.toml: line 2, check.robot" in editor.messages()[0]
        (seam.parent / "irbkin.toml").write_text(f'[check]\nrobot = "{NAME}"\n')
        changed = types.FileEvent(
            (seam.parent / "irbkin.toml").as_uri(), types.FileChangeType.Changed
        )
        editor.client.workspace_did_change_watched_files(
            types.DidChangeWatchedFilesParams([changed])
        )
        while await editor.codes(seam.as_uri()) == []:
            await editor.client.wait_for_notification("textDocument/publishDiagnostics")


@pytest.mark.asyncio
async def test_a_cell_and_a_mesh_that_change_are_read_again(seam):
    folder, files = seam.parent, []
    (folder / "irbkin.toml").write_text('[check]\ncell = "own.toml"\nselect = ["K"]\n')
    (folder / "own.toml").write_text("")

    async def after(editor, name, content):
        path = folder / name
        path.write_text(content) if isinstance(content, str) else np.save(path, content)
        files.append(path)
        event = types.FileEvent(path.as_uri(), types.FileChangeType.Changed)
        before = len(editor.published)
        params = types.DidChangeWatchedFilesParams([event])
        editor.client.workspace_did_change_watched_files(params)
        while len(editor.published) == before:
            await editor.client.wait_for_notification("textDocument/publishDiagnostics")
        return [it.code for it in editor.published[-1].diagnostics]

    async with editing(folder, options=OPTIONS) as editor:
        assert await editor.codes(editor.open(seam)) == []
        post = "[obstacles.post]\nsphere = 3.0\n"
        assert "K901" in await after(editor, "own.toml", post)
        np.save(folder / "far.npy", [[9.0, 9.0, 9.0]])
        points = '[obstacles.post]\npoints = "far.npy"\nradius = 3.0\n'
        assert await after(editor, "own.toml", points) == []
        assert "K901" in await after(editor, "far.npy", [[0.0, 0.0, 0.0]])
    others = ("A.cfg", "p.pgf", "irbkin.toml", "pyproject.toml", "a.stl")
    for path in (*files, *map(Path, others)):
        assert path.suffix[1:] in re.search(r"\*\.\{(.*)\}", WATCHED[0])[1].split(",")


@pytest.mark.asyncio
async def test_a_backup_gives_the_arm_and_the_other_modules(backup):
    async with editing() as editor:
        uri = editor.open(main_of(backup))
        marks = await editor.marks(uri)
        assert "T_ROB1: ROB_1, IRB 4600-40/2.55" in await editor.hover(uri, "pHome:=")
        texts = editor.texts[uri][1].splitlines()
        names = [texts[it.range.start.line].strip() for it in marks if it.code == "R101"]
        assert "GoPos pFar,v500,fine,tGun,wobj0;" in names
        # A tool in another module that is changed and not saved counts.
        data = editor.open(backup / "HOME" / "cell" / "CellData.sys")
        assert await editor.marks(data) == ()
        before = len(editor.published)
        editor.change(data, "tooldata tGun", "tooldata tGum")
        await editor.marks(data)
        other = [it for it in editor.published[before:] if it.uri == uri][-1].diagnostics
        unknown = [{it.message for it in of if it.code == "N602"} for of in (marks, other)]
        assert unknown[0] != unknown[1]
        old = editor.open(backup / "HOME" / "old" / "MainModule.mod")
        assert await editor.marks(old) == ()
        (message,) = editor.messages()
        assert "MainModule.mod is in no task of its backup" in message
        # Closed, the text of the file counts again.
        before = len(editor.published)
        editor.close(data)
        while not [it for it in editor.published[before:] if it.uri == uri]:
            await editor.client.wait_for_notification("textDocument/publishDiagnostics")
        assert list(editor.client.diagnostics[uri]) == list(marks)


@pytest.mark.asyncio
async def test_a_file_behind_a_link_into_a_backup_has_its_arm(backup, tmp_path):
    (tmp_path / "programs").symlink_to(main_of(backup).parent)
    async with editing() as editor:
        codes = await editor.codes(editor.open(main_of(backup)))
        assert await editor.codes(editor.open(tmp_path / "programs" / "MainModule.mod")) == codes
        assert "R101" in codes


@pytest.mark.asyncio
async def test_hovers_show_joints_confdata_and_distances(seam):
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(seam)
        text = await editor.hover(uri, "MoveJ pCopy")
        assert f"**pCopy** ({NAME})" in text
        joints = [float(it) for it in re.findall(r"-?\d+\.\d\d(?=\|)", text)]
        assert len(joints) == 6
        assert joints[0] == pytest.approx(-12.53, abs=0.005)
        assert "confdata [-1, 0, -1, 0], written is [1, 0, 1, 0]" in text
        assert re.search(r"nearest limit: J\d, \d+\.\d deg to the (lower|upper) one", text)
        assert re.search(r"from singularities: wrist \d+\.\d deg, elbow .*, shoulder \d+ mm", text)
        assert "**C201** wrong-confdata: No solution" in text
        at_name = await editor.hover(uri, "pCopy,v200")
        assert "CONST robtarget pCopy" in at_name
        assert "[[900,-200,500]" in at_name
        declared = await editor.hover(uri, "pCopy:=")
        assert "**seam.mod:8: pCopy**" in declared
        assert "wrist center 1265.3 mm beyond reach" in await editor.hover(uri, "pAway:=")
        tool = await editor.hover(uri, "tGun;")
        assert "Tool, held by the robot: (0, 0, 180) mm" in tool
        assert "2 kg at (0, 0, 50) mm" in tool
        assert await editor.hover(uri, "ENDMODULE") is None


@pytest.mark.asyncio
async def test_a_correction_leaves_no_finding(seam):
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(seam)
        assert await editor.actions(uri, "MoveJ pNear", [types.CodeActionKind.QuickFix]) == ()
        quick, everything = await editor.actions(uri, "MoveJ pCopy")
        assert quick.title == "Correct the confdata of pCopy (C201)"
        assert [it.code for it in quick.diagnostics] == ["C201"]
        assert everything.kind == "source.fixAll.irbkin"
        only = await editor.actions(uri, "MODULE", [types.CodeActionKind.SourceFixAll])
        assert [it.kind for it in only] == ["source.fixAll.irbkin"]
        assert editor.apply(quick.edit) == {}
        assert await editor.codes(uri) == ["R101"]
        assert editor.texts[uri][1] == SEAM.replace("],[1,0,1,0],", "],[-1,0,-1,0],", 1)


@pytest.mark.asyncio
async def test_a_correction_may_be_in_another_file(tmp_path):
    lines = SEAM.splitlines()
    data = "\n".join(["MODULE Data(SYSMODULE)", "    ! größe 😀", *lines[1:5], "ENDMODULE", ""])
    (tmp_path / "data.sys").write_text(data, encoding="utf-8")
    (tmp_path / "moves.mod").write_text("\n".join(["MODULE Moves", *lines[5:], ""]))
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(tmp_path / "moves.mod")
        assert await editor.codes(uri) == ["C201", "R101"]
        _, everything = await editor.actions(uri, "MoveJ pCopy")
        (text,) = editor.apply(everything.edit).values()
        assert text == data.replace("],[1,0,1,0],", "],[-1,0,-1,0],", 1)
        assert await editor.definition(uri, "pCopy", 2) == ("data.sys", 5, "pCopy")
        (tmp_path / "data.sys").write_text(text)
        editor.client.text_document_did_save(
            types.DidSaveTextDocumentParams(types.TextDocumentIdentifier(uri))
        )
        await editor.client.wait_for_notification("textDocument/publishDiagnostics")
        assert [it.code for it in editor.client.diagnostics[uri]] == ["R101"]
        # A file that vanishes takes its data with it.
        (tmp_path / "data.sys").unlink()
        editor.change(uri, "fine", "z10")
        assert await editor.codes(uri) == ["N601"] * 3


@pytest.mark.asyncio
async def test_names_lead_to_their_declarations_over_the_backup(backup):
    local = "MODULE Own\n  LOCAL CONST robtarget pHome:=[[1,2,3],[1,0,0,0],[0,0,0,0],{}];\n"
    local += "  VAR socketdev sock;\n  LOCAL PROC rSeam(robtarget pGiven, \\switch slow)\n"
    local += "    VAR num pFar;\n    moveL PHOME,v5,fine,TGUN;\n    MoveL pGiven,v5,fine,tgun;\n"
    local += "    pFar:=1; IF Present(slow) RETURN; SocketClose sock;\n  ENDPROC\n"
    local += "  PROC rAll()\n    rSeam pFar; RARCS;\n  ENDPROC\nENDMODULE\n"
    file = main_of(backup).with_name("Own.mod")
    file.write_text(local.format(FAR))
    async with editing() as editor:
        uri = editor.open(main_of(backup))
        assert await editor.definition(uri, "GoPos pApp1") == ("Moves.mod", 12, "GoPos")
        assert await editor.definition(uri, "pApp1,v1000") == ("MainModule.mod", 10, "pApp1")
        assert await editor.definition(uri, "wFix;", 2) == ("CellData.sys", 3, "wFix")
        assert await editor.definition(uri, "v1000") is None
        assert await editor.definition(uri, "rStation;") == ("Moves.mod", 20, "rStation")
        own = editor.open(file)
        assert await editor.definition(own, "PHOME") == ("Own.mod", 2, "pHome")
        assert await editor.definition(own, "TGUN") == ("CellData.sys", 2, "tGun")
        assert await editor.definition(own, "pGiven,v5") == ("Own.mod", 4, "pGiven")
        assert await editor.definition(own, "slow)", 1) == ("Own.mod", 4, "slow")
        assert await editor.definition(own, "pFar:=") == ("Own.mod", 5, "pFar")
        assert await editor.definition(own, "sock;\n  ENDPROC") == ("Own.mod", 3, "sock")
        assert await editor.definition(own, "rSeam pFar") == ("Own.mod", 4, "rSeam")
        assert await editor.definition(own, "pFar; RARCS") == ("MainModule.mod", 21, "pFar")
        assert await editor.definition(own, "RARCS") == ("MainModule.mod", 53, "rArcs")


@pytest.mark.asyncio
async def test_symbols_have_data_inside_their_routines(seam):
    text = SEAM.replace("    PROC main()\n", "    PROC main()\n        VAR num n:=1;\n")
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(seam, text)
        params = types.DocumentSymbolParams(types.TextDocumentIdentifier(uri))
        symbols = await editor.client.text_document_document_symbol_async(params)
        assert [it.name for it in symbols] == ["tGun", "pNear", "pCopy", "pAway", "main"]
        assert [it.name for it in symbols[-1].children] == ["n"]
        assert symbols[0].detail == "tooldata"
        assert symbols[1].kind == types.SymbolKind.Constant
        whole = part_of(text, symbols[-1].range)
        assert whole.startswith("PROC main()")
        assert whole.endswith("ENDPROC")
        assert all(part_of(text, it.selection_range) == it.name for it in symbols)


@pytest.mark.parametrize("ends", ["\n", "\r\n"])
@pytest.mark.asyncio
async def test_places_count_units_of_utf_16(tmp_path, ends):
    lines = SEAM.replace("        MoveJ pCopy", "    ; ! 😀 größe \x0c\x85\n        MoveJ pCopy")
    text = lines.replace("MoveJ pNear", "; MoveJ pNear").replace("\n", ends)
    text = text.replace("MoveJ pAway", 'TPWrite "😀ß"; MoveJ pAway')
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(tmp_path / "new.mod", text)
        wrong, away = await editor.marks(uri)
        assert part_of(text, wrong.range) == "MoveJ pCopy,v200,fine,tGun"
        assert part_of(text, away.range) == "MoveJ pAway,v1000,fine,tGun"
        # Behind characters that only some take for ends of lines, edits are at their places.
        editor.change(uri, "pCopy,v200", "pNone,v200")
        (wrong, _) = await editor.marks(uri)
        assert wrong.code == "N601"
        assert "pNone" in wrong.message
        assert part_of(editor.texts[uri][1], wrong.range) == "MoveJ pNone,v200,fine,tGun"
        hover = await editor.hover(uri, "MoveJ pAway")
        assert "wrist center" in hover


@pytest.mark.asyncio
async def test_files_in_latin_1_beside_the_open_one(tmp_path):
    text = SEAM.replace("MODULE Seam", "! Größe\nMODULE Seam")
    (file := tmp_path / "old.mod").write_bytes(text.encode("latin-1"))
    caller = (
        "MODULE Caller\n  PROC rCall()\n    MoveJ pNear,v5,fine,tGun; ! ü\n  ENDPROC\nENDMODULE\n"
    )
    (tmp_path / "caller.mod").write_bytes(caller.encode("latin-1"))
    async with editing(options=OPTIONS) as editor:
        # Editors put another character where the bytes are no UTF-8.
        uri = editor.open(file)
        assert "\ufffd" in editor.texts[uri][1]
        assert await editor.codes(uri) == ["C201", "R101"]
        other = editor.open(tmp_path / "caller.mod")
        assert await editor.marks(other) == ()
        assert await editor.definition(other, "pNear") == ("old.mod", 4, "pNear")


@pytest.mark.asyncio
async def test_a_huge_file_is_refused_in_words(tmp_path):
    huge = SEAM + "! a comment\n" * 1_700_000
    (tmp_path / "seam.mod").write_text(SEAM.replace("Seam", "Other"))
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(tmp_path / "huge.mod", huge)
        assert await editor.marks(uri) == ()
        (message,) = editor.messages()
        assert "huge.mod has 20.4 MB, more than 4 MB" in message
        assert await editor.hover(uri, "tGun;") is None
        editor.write(uri, SEAM)
        # The other file declares the same names.
        assert await editor.codes(uri) == ["N609", "C201", "R101"]


@pytest.mark.asyncio
async def test_nothing_that_a_client_sends_ends_the_server(seam):
    async with editing(options=OPTIONS) as editor:
        uri = editor.open(seam)
        await editor.marks(uri)
        nowhere = types.TextDocumentIdentifier((seam.parent / "none.mod").as_uri())
        client, far = editor.client, types.Position(10**6, 10**6)
        client.text_document_did_close(types.DidCloseTextDocumentParams(nowhere))
        client.text_document_did_save(types.DidSaveTextDocumentParams(nowhere))
        client.protocol.notify("textDocument/unheardOf", {"x": 1})
        for document in (nowhere, types.TextDocumentIdentifier(uri)):
            assert await client.text_document_hover_async(types.HoverParams(document, far)) is None
            at = types.DefinitionParams(document, far)
            assert await client.text_document_definition_async(at) is None
        editor.send(uri, types.TextDocumentContentChangePartial(types.Range(far, far), "! end\n"))
        for change in ("", "\ud800", "\x00", "MODULE", '"', "😀" * 3, SEAM):
            editor.write(uri, change) if "\ud800" not in change else None
            await editor.marks(uri)
        assert await editor.codes(uri) == ["C201", "R101"]
        untitled = editor.open("untitled:Untitled-1", SEAM)
        assert await editor.codes(untitled) == ["C201", "R101"]


@pytest.mark.asyncio
async def test_a_file_that_is_excluded_has_no_findings(seam):
    seam.with_name("irbkin.toml").write_text('[check]\nexclude = ["out.mod"]\n')
    async with editing(options=OPTIONS) as editor:
        shutil.copy(seam, excluded := seam.with_name("out.mod"))
        out, uri = editor.open(excluded), editor.open(seam)
        assert await editor.codes(uri) == ["C201", "R101"]
        assert out not in editor.client.diagnostics


def test_the_missing_extra_is_named():
    code = "import sys; sys.modules['pygls'] = None; from irbkin.cli import main; "
    code += "sys.exit(main(['lsp']))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr == "irbkin: irbkin.lsp needs pygls: pip install 'irbkin[lsp]'\n"
