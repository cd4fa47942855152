"""The Python blocks of the README and of the documents run as they stand, and their links lead
somewhere.
"""

import contextlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

import irbkin
import pytest

ROOT = Path(__file__).parents[2]
README = ROOT / "README.md"
DOCS = sorted((ROOT / "docs").rglob("*.md"))
NAMES = ("ARCHITECTURE", "CONTRIBUTING", "CHANGELOG", "RELEASING", "SECURITY")
PAGES = [README, *(ROOT / f"{name}.md" for name in NAMES), *DOCS]
BLOCK = re.compile(r"^```python\n(.*?)^```$(?:\n\n```text\n(.*?)^```$)?", re.MULTILINE | re.DOTALL)
FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
# Pages whose blocks need an extra.
EXTRA = ("calibrate.md", "plot.md", "general.md")
# Transcripts of a shell, and the files that they read: their names stand behind the fence.
TRANSCRIBED = [
    ROOT / "docs" / "guide" / f"{name}.md"
    for name in ("cli", "check", "backup", "robotstudio", "replace")
]
SHELL = re.compile(
    r"^```(?:console\n(?P<console>.*?)|\w+ (?P<file>[\w-]+\.\w+)\n(?P<content>.*?))^```$",
    re.MULTILINE | re.DOTALL,
)
README_WORDS = 600
# Folders of the checkout that a page reads, copied beside it.
GIVEN = {
    "backup.md": ROOT / "examples" / "backup",
    "robotstudio.md": ROOT / "examples" / "robotstudio",
}
LINE = 100


def marked(page):
    """A page with the mark of what its blocks need."""
    marks = [pytest.mark.recipes] * (page.name == "recipes.md")
    return pytest.param(page, marks=marks + [pytest.mark.extra] * (page.name in EXTRA))


RUN = [marked(page) for page in PAGES if BLOCK.search(page.read_text())]


def given(page, folder):
    """Copy what a page reads into a folder."""
    if page.name in GIVEN:
        shutil.copytree(GIVEN[page.name], folder / GIVEN[page.name].name)


@pytest.mark.parametrize("page", RUN, ids=lambda page: page.name)
def test_the_blocks_of_a_page_run_top_to_bottom_and_print_what_it_shows(
    page, tmp_path, monkeypatch
):
    # An empty folder: no block reads another file of the checkout.
    given(page, tmp_path)
    monkeypatch.chdir(tmp_path)
    namespace = {}
    for block, shown in BLOCK.findall(page.read_text()):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(block, page.name, "exec"), namespace)
        if shown:
            assert printed.getvalue() == shown


def test_the_readme_shows_what_its_blocks_print():
    blocks = BLOCK.findall(README.read_text())
    assert len(blocks) >= 3
    for block, shown in blocks:
        assert shown or "print(" not in block, block


def transcript(console, folder):
    """The commands of a block with what they print."""
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    lines = []
    for command in re.findall(r"^\$ (.*)$", console, re.MULTILINE):
        done = subprocess.run(
            ["bash", "-c", command],
            cwd=folder,
            env={**os.environ, "PATH": path},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=60,
        )
        lines.append(f"$ {command}\n{done.stdout.decode()}")
    return "".join(lines)


@pytest.mark.extra
@pytest.mark.parametrize("page", TRANSCRIBED, ids=lambda page: page.name)
def test_the_transcripts_of_a_page_are_what_a_shell_prints(page, tmp_path):
    given(page, tmp_path)
    text = page.read_text()

    def printed(block):
        if block["file"]:
            (tmp_path / block["file"]).write_text(block["content"])
            return block[0]
        return f"```console\n{transcript(block['console'], tmp_path)}```"

    own = SHELL.sub(printed, text)
    assert own.count("\n$ ") >= 3
    if os.environ.get("IRBKIN_WRITE") == "1":
        page.write_text(own)
    assert text == own, "IRBKIN_WRITE=1 pytest tests/python/test_documents.py writes it"


def test_the_check_that_readme_shows_is_what_a_shell_prints(tmp_path):
    (tmp_path / "examples").mkdir()
    shutil.copy(ROOT / "examples" / "pick_and_place.mod", tmp_path / "examples")
    text = README.read_text()
    (shown,) = re.findall(
        r"^```console\n(\$ irbkin check .*?)^```$", text, re.MULTILINE | re.DOTALL
    )
    own = transcript(shown, tmp_path)
    if os.environ.get("IRBKIN_WRITE") == "1":
        README.write_text(text.replace(shown, own))
    assert shown == own, "IRBKIN_WRITE=1 pytest tests/python/test_documents.py writes it"


def notebook(text):
    """A page as a notebook (nbformat 4.5) that has been run: its Python and what that prints."""
    prose, cells = 0, []

    def add(kind, source, **more):
        if source.strip():
            lines = source.strip().splitlines(keepends=True)
            base = {"cell_type": kind, "id": str(len(cells)), "metadata": {}, "source": lines}
            cells.append(base | more)

    for count, block in enumerate(BLOCK.finditer(text), 1):
        add("markdown", text[prose : block.start()])
        stream = {
            "name": "stdout",
            "output_type": "stream",
            "text": (block[2] or "").splitlines(True),
        }
        add("code", block[1], execution_count=count, outputs=[stream] if block[2] else [])
        prose = block.end()
    add("markdown", text[prose:])
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    whole = {
        "cells": cells,
        "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(whole, indent=1, ensure_ascii=False) + "\n"


def test_the_notebook_is_the_tutorial():
    page = ROOT / "docs" / "guide" / "tutorial.md"
    own, file = notebook(page.read_text()), page.with_suffix(".ipynb")
    if os.environ.get("IRBKIN_WRITE") == "1":
        file.write_text(own)
    assert file.read_text() == own, "IRBKIN_WRITE=1 pytest tests/python/test_documents.py writes it"


def test_the_arms_of_a_maker_are_counted():
    makers = Counter(irbkin.catalog_entry(name).maker for name in irbkin.catalog())
    assert f"{makers['ABB']} arms of ABB" in README.read_text()
    arms = (ROOT / "docs" / "guide" / "arms.md").read_text()
    assert f"{makers['ABB']} of ABB" in arms
    assert f"{makers['Universal Robots']} of Universal Robots" in arms


def words(text):
    """Number of words outside code blocks, tables and pictures; an address is no word."""
    text = FENCED.sub("", text)
    text = re.sub(r"^\|.*$", "", text, flags=re.MULTILINE)
    text = re.sub(r"!\[[^]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    return sum(bool(re.search(r"\w", word)) for word in text.split())


def test_the_readme_is_short():
    assert words(README.read_text()) <= README_WORDS


def anchors(page):
    """The anchors of a page's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", FENCED.sub("", page.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_and_anchors_lead_somewhere(page):
    links = re.findall(r"\]\((?!https?:)([^)#]*)(?:#([^)]*))?\)", page.read_text())
    for link, anchor in links:
        target = page.parent / link if link else page
        assert target.exists(), link
        if anchor:
            assert anchor in anchors(target), f"{link}#{anchor}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_lines_of_prose_are_short(page):
    lines = FENCED.sub("", page.read_text()).splitlines()
    prose = [line for line in lines if not line.startswith(("|", "    ", "!["))]
    # A link may not be broken.
    assert not [line for line in prose if len(line) > LINE and line.count(" ") > 2]


def test_files_that_are_named_exist():
    named = re.compile(r"`((?:src|tests|benches|docs|python)/[\w./]+)`")
    files = {file for page in PAGES for file in named.findall(page.read_text())}
    assert len(files) > 10
    assert not [file for file in files if not (ROOT / file).exists()]


def test_make_targets_and_suites_that_are_named_exist():
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    script = (ROOT / "benches" / "evidence.sh").read_text()
    suites = set(re.findall(r"^([a-z-]+)\(\) \{ ## ", script, re.MULTILINE))
    assert len(targets) > 20
    assert len(suites) > 15
    for page in PAGES:
        text = page.read_text()
        for target in re.findall(r"`make ([a-z-]+)`", text):
            assert target in targets, f"{page.name}: make {target}"
        for suite in re.findall(r"SUITE=([a-z-]+)", text):
            assert suite in suites, f"{page.name}: SUITE={suite}"
