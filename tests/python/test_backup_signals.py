"""Signals and cross connections of backups."""

import pytest
from backups import SMALL, cfg, written
from irbkin.abb import load_backup, parse_cfg
from irbkin.abb.load import signals_of

SIGNALS = [
    '-Name "diStart" -SignalType "DI" -Device "d652" -DeviceMap "0"',
    '-Name "doLamp" -SignalType "DO"',
    '-Name "aiForce" -SignalType "ai"',
    '-Name "goProgram" -SignalType "GO"\\\n      -Device "d652" -DeviceMap "0-7"',
    '-Name "odd" -SignalType "XY"',
    '-SignalType "DI"',
    '-Name "untyped"',
]
TYPES = {"diStart": "DI", "doLamp": "DO", "aiForce": "AI", "goProgram": "GO"}


def backup(folder, version="6:0", signals=SIGNALS, crosses=()):
    """A backup with these signals and cross connections."""
    types = {"EIO_SIGNAL": signals, "EIO_CROSS": crosses}
    return load_backup(written(folder, {**SMALL, "SYSPAR/EIO.cfg": cfg("EIO", version, **types)}))


@pytest.mark.parametrize("version", ["5:0", "6:0", "7:0"])
def test_signals_have_their_types_by_name(tmp_path, version):
    own = backup(tmp_path, version)
    assert own.signals == TYPES
    assert not own.findings


def test_without_eio_there_are_no_signals(tmp_path):
    own = load_backup(written(tmp_path, SMALL))
    assert own.signals == {}
    assert not own.findings


@pytest.mark.parametrize("end", [0, 7, 40, 111, 130, 180, 260])
def test_broken_files_have_the_signals_that_can_be_read(tmp_path, end):
    whole = cfg("EIO", "6:0", EIO_SIGNAL=SIGNALS)
    for text in (whole[:end], whole + whole[:end], whole[end:]):
        assert signals_of(parse_cfg(text)).items() <= TYPES.items()
    assert signals_of(parse_cfg(whole + whole)) == TYPES
    path = written(tmp_path, {**SMALL, "SYSPAR/eio.CFG": b"\x00\xff" + whole.encode()})
    own = load_backup(path)
    assert own.signals == {}
    assert [it.code for it in own.findings] == ["not-text"]
    # Of a file that ends in a line every undeclared name may be a signal.
    cut = written(tmp_path / "cut", {**SMALL, "SYSPAR/EIO.cfg": whole[: whole.index("aiForce")]})
    assert (load_backup(cut).signals, len(load_backup(cut).findings)) == ({}, 1)


def test_a_cross_connection_has_signals(tmp_path):
    crosses = [
        '-Name "xLamp" -Res "DOLAMP" -Act1 "diStart" -Act2 "untyped" -Act2_invert -Act3',
        '-Res "doLamp" -Act1 "DRV1BRAKE"',
        '-Name "xGone" -Res "doGone" -Act1 "diStart" -Oper1 "OR" -Act2 "diLost"',
    ]
    found = backup(tmp_path, crosses=crosses).findings
    assert [(it.code, it.severity) for it in found] == [("cross-signal", "warning")] * 2
    assert found[0].message == (
        "cross connection xGone: doGone of its -res is no signal of EIO.cfg"
    )
    assert "diLost of its -act2" in found[1].message
    lines = (tmp_path / "SYSPAR" / "EIO.cfg").read_text().split("\n")
    assert all("xGone" in lines[it.line - 1] for it in found)
