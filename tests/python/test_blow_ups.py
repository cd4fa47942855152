"""Inputs of 100 kB that once took minutes or gigabytes: they are bounded, and said to be."""

import time

import command
import pytest
from irbkin import Cell
from irbkin._cell.entries import parsed
from irbkin.errors import InvalidModelError

DEEP = ".".join("a" * 33)


@pytest.mark.parametrize(
    "text",
    [
        f"{'.'.join('a' * 50_000)} = 1",
        f"x = 1\n[{'.'.join('a' * 50_000)}]",
        f"x = {{ {'.'.join('a' * 50_000)} = 1 }}",
        f"{'.'.join([chr(34) + 'a.b' + chr(34)] * 15_000)} = 1",
        " . ".join(["'a'"] * 15_000) + " = 1",
    ],
)
def test_a_key_of_many_parts_is_refused_by_name(tmp_path, text):
    file = tmp_path / "cell.toml"
    file.write_text(text)
    began = time.process_time()
    with pytest.raises(InvalidModelError, match=r"line \d: the key .* parts, at most 32"):
        Cell.load(file)
    # An irbkin.toml is read unasked.
    (tmp_path / "irbkin.toml").write_text(text)
    (tmp_path / "a.mod").write_text("MODULE a\nENDMODULE\n")
    message = command.refused("check", "IRB 2600-12/1.65", tmp_path / "a.mod")
    assert "parts, at most 32" in message
    assert len(message) < 1000
    assert time.process_time() - began < 1.0


def test_dots_in_texts_and_comments_are_no_keys():
    text = f'x = "a\\"{DEEP}"\ny = \'{DEEP}\' # {DEEP}\nz = """\n{DEEP} \\""" "" {DEEP}"""\n'
    assert parsed(text)["y"] == DEEP
    assert parsed(".".join("a" * 32) + "=1")["a"]
