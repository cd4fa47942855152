"""What the figures were measured on."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

# Instruction sets that matter to such code, the widest first, as Linux names them.
INSTRUCTION_SETS = {"avx512f": "AVX-512", "avx2": "AVX2", "avx": "AVX", "asimd": "NEON"}


def versions(packages: Iterable[str]) -> dict[str, str]:
    """Versions of those distributions that are installed."""
    found = {}
    for package in packages:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found


def cpu() -> tuple[str, str]:
    """Model and widest instruction set of the processor, as far as the system reports it."""
    info = Path("/proc/cpuinfo")
    fields: dict[str, str] = {}
    if info.exists():
        for line in info.read_text().splitlines():
            key, _, value = line.partition(":")
            fields.setdefault(key.strip(), value.strip())
    model = fields.get("model name") or platform.processor() or platform.machine()
    if "cpu family" in fields and "model" in fields:
        # The name alone does not tell the generation, and with it how wide its units are.
        model += f" (family {fields['cpu family']}, model {fields['model']})"
    flags = (fields.get("flags") or fields.get("Features") or "").split()
    return model, next(
        (name for flag, name in INSTRUCTION_SETS.items() if flag in flags), platform.machine()
    )


def describe(packages: Iterable[str]) -> list[str]:
    """Lines that name the machine, Python and every version."""
    model, instructions = cpu()
    system = f"{platform.system()} {platform.machine()}, Python {platform.python_version()}"
    lines = [f"{model}, {instructions}, {os.cpu_count()} cores, {system}"]
    if hasattr(os, "getloadavg"):
        lines[0] += f"; load before the run {os.getloadavg()[0]:.2f}"
    lines.append(
        ", ".join(
            f"{name} {number}" for name, number in versions([*packages, "numpy", "scipy"]).items()
        )
    )
    return lines
