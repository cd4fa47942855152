"""Write the docstrings of the extension module into `python/irbkin/_core.pyi`.

The doc comments in `crates/irbkin-python` are what `help()` shows; this puts the same words into
the stub of a wheel, which editors read (`ship/documented.sh`). In the sources the stub has types
alone.
"""

import ast
import inspect
import textwrap
from pathlib import Path

from irbkin import _core

STUB = Path(__file__).parents[2] / "python/irbkin/_core.pyi"
WIDTH = 100


def with_docs(stub: str) -> str:
    """The stub with the docstring of each public function, class, method and property."""
    lines = stub.splitlines()
    # From the end, so that the numbers of the lines before stay as they are.
    found = sorted(documented(ast.parse(stub)), key=lambda found: found[0].lineno)
    for node, thing in reversed(found):
        set_doc(lines, node, inspect.getdoc(thing))
    return "\n".join(lines) + "\n"


def documented(tree: ast.Module):
    """The definitions that are documented, with what they are in the extension."""
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            owner = getattr(_core, node.name)
            yield node, owner
            yield from ((member, getattr(owner, member.name)) for member in public(node.body))
    yield from ((node, getattr(_core, node.name)) for node in public(tree.body))


def public(body: list[ast.stmt]):
    """The functions of public names; of overloads the first, which stands for all."""
    seen = set()
    for node in body:
        is_public = isinstance(node, ast.FunctionDef) and not node.name.startswith("_")
        if is_public and node.name not in seen:
            seen.add(node.name)
            yield node


def set_doc(lines: list[str], node: ast.FunctionDef | ast.ClassDef, doc: str) -> None:
    """Put a docstring into a definition: of a function in place of `...`."""
    first = node.body[0]
    is_bare = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    text = quoted(doc, " " * (node.col_offset + 4))
    if is_bare:
        assert first.value.value is ..., f"{node.name} has a docstring"
        start = first.lineno - 1
        head = lines[start][: first.col_offset].rstrip()
        lines[start : start + 1] = ([head] if head else []) + text
    else:
        assert not isinstance(node, ast.FunctionDef), f"{node.name} has a body"
        decorators = getattr(first, "decorator_list", [])
        start = min([first.lineno, *(decorator.lineno for decorator in decorators)]) - 1
        lines[start:start] = [*text, ""]


def quoted(doc: str, indent: str) -> list[str]:
    """The lines of a docstring; its first paragraph is wrapped again, behind the quotes."""
    mark = 'r"""' if "\\" in doc else '"""'
    first, *rest = doc.split("\n\n", 1)
    first = " ".join(first.split())
    if not rest and len(indent + mark + first) + 3 <= WIDTH:
        return [f'{indent}{mark}{first}"""']
    # A formatter puts the last quotes behind a text of one line.
    head = textwrap.wrap(f"{mark}{first}", WIDTH - len(indent) - (0 if rest else 3))
    body = ["", *rest[0].splitlines()] if rest else []
    return [f"{indent}{line}".rstrip() for line in [*head, *body, '"""']]


def main() -> None:
    STUB.write_text(with_docs(STUB.read_text()))


if __name__ == "__main__":
    main()
