#!/usr/bin/env bash
# InterpolatePy 3.3.2: a jerk-limited profile steps back by half a millimeter at full speed.
#
# Guess: the position of `DoubleSTrajectory` is the integral of its velocity, and the end is at rest
# where it is asked to be; what cannot be had within the limits raises an error.
# Seen: the duration is rounded to whole milliseconds, the phases are not. The last phases are timed
# from the rounded end, so that the position jumps where the cruise ends, by the speed times what
# was rounded: from 0 to 1 m, v 1 m/s, a 2 m/s2, j 10 m/s3, initial speed -0.5 m/s, the profile
# lasts 2.0625 s, the answer is 2.063 s, and at 1.3625 s the position goes back by 0.5 mm between
# two instants 2 ns apart. The velocity there is +1 m/s on both sides, the acceleration 0.01 of its
# limit. The README's kind of numbers (rest to rest, round times) rarely shows it.
# And: 0.3 m before the goal at full speed, where braking needs 0.35 m, no error is raised. The
# profile cruises through the goal, and ends 0.3 m behind it at full speed.
# Why it matters: setpoints of a servo cycle are differences of positions. Half a millisecond in a
# cycle of 4 ms is an eighth of the speed, there and back, which no check of velocity() or
# acceleration() shows; the controller sees an acceleration of 15 times the limit, or stops.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check \
    interpolatepy==3.3.2 numpy==2.4.6 scipy==1.17.1
cd "$work"
"$work/venv/bin/python" - <<'PYTHON'
import numpy as np
from interpolatepy import HAS_CPP, DoubleSTrajectory, StateParams, TrajectoryBounds

LIMITS = {"v_bound": 1.0, "a_bound": 2.0, "j_bound": 10.0}


def profile(distance, v_0):
    state = StateParams(q_0=0.0, q_1=distance, v_0=v_0, v_1=0.0)
    return DoubleSTrajectory(state, TrajectoryBounds(**LIMITS))


print("compiled backend:", HAS_CPP)
jump = profile(1.0, -0.5)
phases = jump.get_phase_durations()
lasts = sum(phases[name] for name in ("acceleration", "constant_velocity", "deceleration"))
print(f"phases {lasts:.6f} s, duration {jump.get_duration():.6f} s")
assert abs(lasts - 2.0625) < 1e-12 and jump.get_duration() == 2.063

edge = phases["acceleration"] + phases["constant_velocity"]
before, after = (jump.evaluate_full(edge + side) for side in (-1e-9, 1e-9))
step = after[0] - before[0]
print(f"at {edge:.4f} s: position {step:+.6f} m in 2 ns, velocity {before[1]:.6f}, {after[1]:.6f}")
assert -0.00051 < step < -0.00049
assert abs(before[1] - 1) < 1e-5 and abs(after[1] - 1) < 1e-5 and abs(after[2]) < 0.01

cycle = 0.004
times = np.arange(0, jump.get_duration(), cycle)
position = np.array([jump.evaluate(float(t)) for t in times])
stated = max(abs(jump.evaluate_acceleration(float(t))) for t in times)
sent = np.abs(np.diff(position, 2)).max() / cycle**2
print(f"acceleration: stated up to {stated:.3f}, of the setpoints each 4 ms {sent:.1f} m/s2")
assert stated < 2.002 and sent > 28

even = profile(1.0, 0.0)
position = np.array([even.evaluate(float(t)) for t in np.arange(0, 1.7, cycle)])
sent = np.abs(np.diff(position, 2)).max() / cycle**2
print(f"from rest, {even.get_duration():.4f} s: setpoints {sent:.3f} m/s2")
assert even.get_duration() == 1.7 and sent < 2.001

late = profile(0.3, 1.0)
end = late.evaluate_full(late.get_duration())
print(f"goal 0.3 m at 1 m/s: after {late.get_duration():.3f} s at {end[0]:.3f} m, {end[1]:.3f} m/s")
assert abs(end[0] - 0.6) < 1e-9 and abs(end[1] - 1) < 1e-9
braked = profile(0.5, 1.0)
end = braked.evaluate_full(braked.get_duration())
assert abs(end[0] - 0.5) < 1e-9 and abs(end[1]) < 1e-9
PYTHON
