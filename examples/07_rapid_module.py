"""A RAPID module: the joint angles of its moves, and the module written back with valid
confdata.
"""

from pathlib import Path

import irbkin
import numpy as np
from irbkin import rapid

MODULE = Path(__file__).parent / "pick_and_place.mod"


def degrees(q: np.ndarray) -> str:
    # Adding zero turns -0.0 into 0.0.
    return " ".join(f"{round(np.degrees(angle), 2) + 0.0:8.2f}" for angle in q)


def show(table: rapid.TargetTable) -> None:
    for row, (kind, name, finding) in enumerate(
        zip(table.kinds, table.names, table.findings, strict=True)
    ):
        confdata = [int(numbers[row]) for numbers in table.configuration]
        joints = degrees(table.q[row]) if np.isfinite(table.q[row]).all() else " " * 53
        print(f"  {kind:8} {name[:22]:22} {joints}  {confdata}  {finding.name if finding else ''}")


def main() -> None:
    robot = irbkin.Robot("IRB 2600-12/1.65")
    module = rapid.load(MODULE)
    print(f"{MODULE.name}: {len(module.data)} data, {len(module.moves)} moves")
    for part in module.skipped:
        print(f"  line {part.line}: {part.what}")

    print("\nas read: CalcJointT of every target")
    show(rapid.calc_moves(robot, module))

    # Where confdata was not calculated, use the solution nearest to the joints before. Poses stay
    # as written.
    home = np.radians([0, 0, 0, 0, 30, 0])
    table = rapid.calc_targets(
        robot, module, module["tGripper"], module["wTray"], fallback="nearest", seed=home
    )
    corrected = {
        name: module[name]._replace(robconf=[numbers[row] for numbers in table.configuration])
        for row, (name, finding) in enumerate(zip(table.names, table.findings, strict=True))
        if finding is not None and np.isfinite(table.q[row]).all()
    }
    text = module.rewritten(corrected)
    print(f"\nwritten back with {len(corrected)} corrected configurations")
    for before, after in zip(module.source.splitlines(), text.splitlines(), strict=True):
        if before != after:
            print(f"  {after.strip()[:96]}")

    print("\nread again")
    show(rapid.calc_moves(robot, rapid.parse(text)))


if __name__ == "__main__":
    main()
