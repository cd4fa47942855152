"""The moves of a RAPID routine as one motion: times, findings, and the joints written back."""

from pathlib import Path

import irbkin
from irbkin import rapid

MODULE = Path(__file__).parent / "pick_and_place.mod"


def show(motion: rapid.RoutineMotion) -> None:
    for step in motion.moves:
        made = "" if step.as_programmed else "  not made as programmed"
        print(
            f"  line {step.line}  {step.kind:8} {step.start:7.3f} s to {step.end:7.3f} s "
            f"{step.length * 1e3:8.1f} mm{made}"
        )
    for finding in motion.findings:
        print(f"  {finding.code} {str(finding)[:90]}")


def main() -> None:
    robot = irbkin.Robot("IRB 2600-12/1.65")
    module = rapid.load(MODULE)
    motion = rapid.motion(robot, module)
    print(f"{motion.routine}: at least {motion.duration:.3f} s, {len(motion)} samples")
    show(motion)
    timed = rapid.motion(robot, module, max_acceleration=10.0)
    print(f"with accelerations of at most 10 rad/s^2: {timed.duration:.3f} s")
    print(rapid.dump(motion.to_module("PickAndPlaceJoints"))[:400])


if __name__ == "__main__":
    main()
