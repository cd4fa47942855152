"""The stub of a wheel says what `help()` says, and the docstrings are whole."""

import ast
import inspect
import re

import irbkin
import pytest
from irbkin import rapid
from stub_docs import STUB, documented, with_docs


def test_the_stub_has_no_docstrings_and_that_of_a_wheel_has_all():
    tree = ast.parse(STUB.read_text())
    assert [node.name for node, _ in documented(tree) if ast.get_docstring(node)] == []
    written = ast.parse(with_docs(STUB.read_text()))
    things = list(documented(written))
    assert len(things) > 400
    for node, thing in things:
        # The first paragraph is wrapped again.
        assert ast.get_docstring(node).split() == inspect.getdoc(thing).split(), node.name


def test_docstrings_are_put_in():
    bare = "def catalog_entry(name: str) -> CatalogEntry: ...\n"
    assert with_docs(bare).startswith(
        'def catalog_entry(name: str) -> CatalogEntry:\n    """Return'
    )
    owner = "class Robot:\n    @property\n    def dof(self) -> int: ...\n"
    lines = with_docs(owner).splitlines()
    assert lines[1].startswith('    """')
    assert lines[-3:] == [
        "    @property",
        "    def dof(self) -> int:",
        f'        """{irbkin.Robot.dof.__doc__}"""',
    ]


def test_the_stub_has_every_structure():
    doc = " ".join(irbkin.Robot.structure.__doc__.split())
    literal = re.search(r"def structure\(.*?Literal\[(.*?)\]", STUB.read_text(), re.DOTALL)
    names = set(re.findall(r'"([^"]+)"', doc))
    assert len(names) == 9
    assert set(re.findall(r'"([^"]+)"', literal[1])) == names
    assert {irbkin.Robot(name).structure for name in irbkin.catalog()} < names


def offered():
    for module in (irbkin, rapid):
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isroutine(thing):
                yield name, thing
            elif inspect.isclass(thing) and thing.__module__.startswith("irbkin"):
                yield name, thing
                for member, value in vars(thing).items():
                    # Fields of records have their words in the source.
                    is_documented = inspect.isroutine(value) or inspect.isdatadescriptor(value)
                    is_field = member in getattr(thing, "__match_args__", ())
                    if is_documented and not is_field and not member.startswith("_"):
                        yield f"{name}.{member}", getattr(thing, member)


@pytest.mark.parametrize(("name", "thing"), sorted(offered(), key=lambda found: found[0]))
def test_a_docstring_begins_with_a_sentence_and_fits_a_line(name, thing):
    doc = inspect.getdoc(thing)
    assert doc, name
    first = doc.split("\n\n")[0].strip()
    assert re.search(r"[.:]$", first), f"{name}: {first}"
    assert first[0].isupper() or first[0] in '`"', name
    assert max(map(len, doc.splitlines())) <= 100


@pytest.mark.parametrize("owner", [irbkin.Robot, irbkin.Solutions, irbkin.Solution, rapid.Module])
def test_docstrings_name_the_arguments(owner):
    for name in vars(owner):
        method = getattr(owner, name)
        if name.startswith("_") or not inspect.isroutine(method):
            continue
        doc = inspect.getdoc(method)
        arguments = [a for a in inspect.signature(method).parameters if a != "self"]
        if len(arguments) > 1 and name not in ("index", "count", "get"):
            for argument in arguments:
                assert re.search(rf"\b{argument}\b", doc), f"{owner.__name__}.{name}: {argument}"
