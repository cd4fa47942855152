"""The modules of the Rust crate, and which of them uses which, read from their text."""

import re
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

SRC = Path(__file__).parents[2] / "src"

# Comments, and what quotes could hide: strings and characters.
NOISE = re.compile(
    r'//[^\n]*|/\*.*?\*/|r#".*?"#|b?"(?:\\.|[^"\\])*"|b?\'(?:\\.|[^\'\\])\'', re.DOTALL
)
USE = re.compile(r"(?:(pub)(?:\([^)]*\))?\s+)?\buse\s+([^;]*);")
# A path in the code itself. A method's `self.x` has no colons.
INLINE = re.compile(r"\b((?:crate|super|self)(?:::\w+)+)")


@dataclass
class Module:
    """A file of the crate."""

    name: tuple[str, ...]
    file: Path
    text: str
    #: Paths that it imports for itself, and paths in its code; absolute, without `crate`.
    uses: list[tuple[str, ...]] = field(default_factory=list)
    #: Names that it has from elsewhere, to use or to hand on.
    names: dict[str, tuple[str, ...]] = field(default_factory=dict)
    #: Modules whose every name it has.
    globs: list[tuple[str, ...]] = field(default_factory=list)

    def __str__(self) -> str:
        return self.file.relative_to(SRC).as_posix()

    @property
    def is_index(self) -> bool:
        """Whether it declares modules and hands on their names, and nothing else."""
        text = re.sub(r"#!?\[(?:[^\[\]]|\[[^\]]*\])*\]", "", USE.sub("", self.text))
        text = re.sub(r"(?:pub(?:\([^)]*\))?\s+)?mod\s+\w+\s*(?:;|\{[^{}]*\})", "", text)
        text = re.sub(
            r"extern crate [\w ]+;|compile_error!\([^)]*\);|pub struct ReadmeBlocks;", "", text
        )
        return not text.strip()


def without_tests(text: str) -> tuple[str, set[str]]:
    """A text without the items that only tests have, and the names of its modules of tests."""
    tests = set()
    while found := re.search(r"#\[cfg\((?:all\()?test\b[^\]]*\]", text):
        end = found.end()
        while attribute := re.compile(r"\s*#\[[^\]]*\]").match(text, end):
            end = attribute.end()
        if name := re.compile(r"\s*(?:pub(?:\([^)]*\))?\s+)?mod\s+(\w+)").match(text, end):
            tests.add(name[1])
        stop = re.compile(r"[;{]").search(text, end)
        end = stop.end()
        depth = stop[0] == "{"
        while depth:
            brace = re.compile(r"[{}]").search(text, end)
            depth += 1 if brace[0] == "{" else -1
            end = brace.end()
        text = text[: found.start()] + text[end:]
    return text, tests


def expanded(tree: str) -> list[str]:
    """The paths of a `use` with braces, at any depth: `a::{b, c::{d, e}}` has three."""
    tree = " ".join(tree.split())
    start = tree.find("{")
    if start < 0:
        return [tree]
    paths, part, depth = [], "", 0
    for character in tree[start + 1 : tree.rindex("}")] + ",":
        depth += {"{": 1, "}": -1}.get(character, 0)
        if character == "," and depth == 0:
            paths += (
                [tree[:start] + path for path in expanded(part.strip())] if part.strip() else []
            )
            part = ""
        else:
            part += character
    return paths


@cache
def modules() -> dict[tuple[str, ...], Module]:
    """Every module of the crate by its path, those of tests left out."""
    found: dict[tuple[str, ...], Module] = {}
    tests: set[tuple[str, ...]] = set()
    for file in sorted(SRC.rglob("*.rs")):
        parts = file.relative_to(SRC).with_suffix("").parts
        name = parts[:-1] if parts[-1] in ("mod", "lib") else parts
        text, of_tests = without_tests(NOISE.sub(" ", file.read_text()))
        tests |= {(*name, test) for test in of_tests}
        found[name] = Module(name, file, text)
    found = {n: m for n, m in found.items() if not any(n[: len(t)] == t for t in tests)}
    for module in found.values():
        read(module, found)
    return found


def read(module: Module, known: dict[tuple[str, ...], Module]) -> None:
    """Read what a module uses and hands on."""
    for public, tree in USE.findall(module.text):
        for path in expanded(tree):
            path, _, alias = path.partition(" as ")
            target = absolute(path.split("::"), module.name, known)
            if target is None:
                continue
            if target[-1] == "*":
                module.globs.append(target[:-1])
            elif target[-1] == "self":
                module.names[alias or target[-2]] = target = target[:-1]
            else:
                module.names[alias or target[-1]] = target
            # What a module hands on of its own children it need not use.
            if not (public and target[: len(module.name)] == module.name):
                module.uses.append(target)
    code = re.sub(r"pub\(in [^)]*\)", "", USE.sub("", module.text))
    for path in INLINE.findall(code):
        target = absolute(path.split("::"), module.name, known)
        if target:
            module.uses.append(target)


def absolute(
    path: list[str], here: tuple[str, ...], known: dict[tuple[str, ...], Module]
) -> tuple[str, ...] | None:
    """A path from the root of the crate; none where it leads out of the crate."""
    if path[0] == "crate":
        return tuple(path[1:]) or None
    if path[0] in ("self", "super"):
        base = here
        while path and path[0] in ("self", "super"):
            base = base if path[0] == "self" else base[:-1]
            path = path[1:]
        return (*base, *path)
    return (*here, *path) if (*here, path[0]) in known else None


def home(path: tuple[str, ...]) -> Module:
    """The module that defines what a path names, through what others hand on."""
    return through(path)[-1]


def through(path: tuple[str, ...], depth: int = 0) -> list[Module]:
    """The modules that hand on what a path names, and the one that defines it."""
    known = modules()
    place: tuple[str, ...] = ()
    for i, segment in enumerate(path):
        if (*place, segment) in known:
            place = (*place, segment)
            continue
        module = known[place]
        rest = path[i + 1 :]
        if segment in module.names and depth < 20 and module.names[segment] != path:
            return [module, *through((*module.names[segment], *rest), depth + 1)]
        for glob in module.globs:
            if home(glob).name != place and re.search(rf"\b{segment}\b", home(glob).text):
                return [module, *through((*glob, segment, *rest), depth + 1)]
        return [module]
    return [known[place]]


@cache
def used_by() -> dict[str, set[str]]:
    """For each module, by the file's name, the files that it uses.

    A `mod.rs` that hands a name on is used with the file that defines it, unless it is an index.
    """
    used = {}
    for module in modules().values():
        files = [file for path in module.uses for file in through(path)]
        defining = {str(home(path)) for path in module.uses}
        handing_on = {str(file) for file in files if file.name and not file.is_index}
        used[str(module)] = (defining | handing_on) - {str(module)}
    return used


def cycles(graph: dict[str, set[str]]) -> list[list[str]]:
    """Files that use one another in a circle: the strongly connected components (Tarjan)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found = []

    def visit(node: str) -> None:
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in graph[node]:
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            circle = stack[stack.index(node) :]
            del stack[stack.index(node) :]
            if len(circle) > 1:
                found.append(sorted(circle))

    for node in sorted(graph):
        if node not in index:
            visit(node)
    return sorted(found)
