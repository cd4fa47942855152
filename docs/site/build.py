"""The site: README, docs, a page for each arm of the catalog, a reference of each module.

`make site` builds it into target/site, from the files that one reads in the sources too.
"""

import contextlib
import io
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path
from urllib.parse import quote

import irbkin
from irbkin.cli import main as command

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
sys.path.append(str(ROOT / "tests" / "python"))
from stub_docs import with_docs  # noqa: E402

PAGE = ROOT / "target" / "page" / "irbkin.html"
SITE = ROOT / "target" / "site"
PAGES = SITE / "pages"
PROJECT = ("CHANGELOG.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "RELEASING.md", "SECURITY.md")
COPIED = (
    "README.md", *PROJECT, "docs", "examples", "crates/*.md", "crates/irbkin-capi/examples", "ros",
    "benches/instructions.md", "benches/peers/arms.py", "python/irbkin/check/rules.md",
)  # fmt: skip
"""What pages are, and link to. Folders stay as they are in the sources, so links do, too."""
MODULES = (
    "irbkin", "irbkin.abb", "irbkin.body", "irbkin.calibration", "irbkin.errors", "irbkin.map",
    "irbkin.paths", "irbkin.placement", "irbkin.plot", "irbkin.rapid", "irbkin.records",
    "irbkin.ros", "irbkin.scene", "irbkin.stream", "irbkin.stream.egm", "irbkin.trajectory",
)  # fmt: skip


def main() -> None:
    """Write the pages and build them; a dead link is an error."""
    shutil.rmtree(SITE, ignore_errors=True)
    copy_sources()
    copy_package()
    arms = [write_arm(name) for name in irbkin.catalog()]
    write("arms/README.md", "# Arms\n\n```text\n" + answer("catalog") + "```\n")
    modules = [write_module(name) for name in MODULES]
    nav = {
        "irbkin": ["README.md"],
        **chapters(),
        "Arms": ["arms/README.md", *arms],
        "Reference": modules,
        "Project": ["docs/README.md", "docs/releases/0.1.0.md", *PROJECT],
    }
    settings = (HERE / "zensical.toml").read_text(encoding="utf-8")
    tabs = ",\n".join(f"    {{{json.dumps(tab)} = {json.dumps(own)}}}" for tab, own in nav.items())
    own = SITE / "zensical.toml"
    own.write_text(settings.replace("[project]\n", f"[project]\nnav = [\n{tabs},\n]\n"))
    program = Path(sys.executable).with_name("zensical")
    subprocess.run([program, "build", "--strict", "--config-file", own], check=True)
    print(f"target/site/html/index.html: {len(arms)} arms, {len(modules)} modules")


def copy_sources() -> None:
    """Copy the documents, and the page if it was built."""
    listed = subprocess.check_output(["git", "ls-files", *COPIED], cwd=ROOT, text=True)
    for name in listed.splitlines():
        text = (ROOT / name).read_bytes()
        if name.endswith(".md"):
            # Words behind the language of a block are for the tests that run it.
            text = re.sub(rb"(?m)^(```\w+) .*$", rb"\1", text)
        write(name, text)
    if PAGE.exists():
        write("arms/page.html", PAGE.read_bytes())
    else:
        print("The site shows no arms: target/page/irbkin.html is missing, `make page` builds it")


def copy_package() -> None:
    """Copy the package, with the docstrings of the extension in its stub."""
    copied = SITE / "python"
    shutil.copytree(ROOT / "python", copied, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    stub = copied / "irbkin" / "_core.pyi"
    stub.write_text(with_docs(stub.read_text(encoding="utf-8")), encoding="utf-8")


def write(name: str, text: str | bytes) -> None:
    """Write a file of the pages."""
    path = PAGES / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text if isinstance(text, bytes) else text.encode())


def chapters() -> dict[str, list[str]]:
    """The pages of each chapter of docs/README.md, in its order."""
    text = (ROOT / "docs" / "README.md").read_text(encoding="utf-8")
    found = {}
    for chapter in text.split("\n## ")[1:]:
        rows = "".join(it.split("|")[1] for it in chapter.splitlines() if it.startswith("|"))
        if names := re.findall(r"\(((?:guide|theory|evidence)/\w+\.md)\)", rows):
            found[chapter.split()[0].strip(",:")] = [f"docs/{name}" for name in names]
    return found


def write_arm(name: str) -> str:
    """Write the page of an arm: it can be dragged there; its limits, speeds and sources."""
    file = f"arms/{re.sub(r'[^a-z0-9]+', '-', name.lower())}.md"
    address = f"page.html#arm={quote(name)}"
    frame = f'<iframe class="arm" title="{name}" src="{address}"></iframe>' if PAGE.exists() else ""
    write(
        file,
        f"# {name}\n\n{frame}\n\n```text\n{answer('catalog', name)}```\n\n"
        f'```python\nrobot = irbkin.Robot("{name}")\n```\n',
    )
    return file


def answer(*words: str) -> str:
    """The answer of the command `irbkin`."""
    printed = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
    with contextlib.redirect_stdout(printed):
        assert command(list(words)) == 0
    printed.flush()
    return printed.buffer.getvalue().decode()


def write_module(name: str) -> str:
    """Write the page of a module, from its docstrings."""
    file = f"reference/{name}.md"
    write(file, f"# {name}\n\n::: {name}\n")
    return file


if __name__ == "__main__":
    main()
