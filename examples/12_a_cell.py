"""A table, a fixture and a torch: which solutions are free, a plan and a motion that go round."""

import irbkin
import numpy as np
from irbkin import rapid
from irbkin.body import Shape

MODULE = """MODULE Seam
  PERS tooldata tTorch:=[TRUE,[[50,0,350],[1,0,0,0]],[3,[0,0,100],[1,0,0,0],0,0,0]];
  CONST robtarget pA:=[[900,-250,420],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pB:=[[900,250,420],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ{via} pA,v1000,fine,tTorch;
    {move} pB,v200,fine,tTorch;
  ENDPROC
ENDMODULE
"""
VIA = "MoveJ Offs(p{0},0,0,350),v1000,z50,tTorch;"
BEFORE = MODULE.replace("{via}", "").replace("{move}", "MoveL")
AFTER = MODULE.replace("{via}", "").replace(
    "{move}", f"{VIA.format('A')}\n    {VIA.format('B')}\n    MoveL"
)


def main() -> None:
    robot = irbkin.Robot("IRB 2600-12/1.65").with_tool(irbkin.pose([0.05, 0, 0.35]))
    torch = Shape.capsule([0, 0, 0.03], [0.05, 0, 0.32], 0.025)
    robot = robot.with_attached(torch)
    cell = irbkin.Cell(
        {
            "table": Shape.box([0.8, 1.4, 0.05], irbkin.pose([1.0, 0, 0.3])),
            "fixture": Shape.cylinder(0.05, 0.3, irbkin.pose([0.9, 0, 0.475])),
        },
        margin=0.005,
    )
    T = irbkin.pose([0.9, 0.25, 0.42], euler_zyx=[0, np.pi, 0])
    solutions = robot.ik(T)
    free = solutions.filter(cell)
    print(f"{len(free)} of {len(solutions)} solutions are free")
    for reason in free.explain().split("; ")[1:]:
        print(f"  {reason}")

    ends = [irbkin.pose([0.9, y, 0.42], euler_zyx=[0, np.pi, 0]) for y in (-0.25, 0.25)]
    line = robot.plan(irbkin.paths.line(*ends, steps=51), rotation=24)
    contact = cell.check_path(robot, line.q)
    assert contact is not None
    print(f"a straight line: {' touches '.join(contact.pair)}, {contact.depth * 1e3:.0f} mm deep")

    motion = robot.go(ends[0], ends[1], cell)
    print(f"go: {motion.duration:.2f} s, proven free: {cell.check_path(robot, motion) is None}")

    for name, text in (("before", BEFORE), ("after", AFTER)):
        found = rapid.check(robot, rapid.parse(text), cell=cell, codes=["K901"])
        print(f"the module {name}:", *(it.message for it in found) if found else ["free"])


if __name__ == "__main__":
    main()
