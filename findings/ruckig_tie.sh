#!/usr/bin/env bash
# ruckig 0.19.4: at round numbers, the time-optimal trajectory takes 2.4 times the shortest time.
#
# Guess: a trajectory from one state to another is time-optimal, as the README guarantees: none
# within the limits is shorter by more than rounding, and near inputs have near durations.
# Seen: from 0.28 m/s to rest 0.336 m away, with 1.4 m/s2 and 7 m/s3, it takes 2.4 s. Five phases of
# 0.2 s with jerk +7, -7, -7, 0, +7 do it in 1 s; rational arithmetic shows that they end exactly
# there, within the limits. One part in 1e14 more or less of the distance, and ruckig finds the 1 s.
# It happens where v = a^2/j and the distance is 6 a^3/j^2, so that the fast profile touches the
# acceleration limit in one point: at 2030 of 5596 choices of decimals for a and j, and always with
# the factor 2.4.
# Why it matters: a new goal while the arm moves is what the library is for, and round numbers are
# what people type. The slow answer is within all limits and ends where it should, so that no check
# of the trajectory shows it. All other axes wait for this one.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check ruckig==0.19.4
cd "$work"
"$work/venv/bin/python" - <<'PYTHON'
from fractions import Fraction

import ruckig


def duration(v0, distance, a, j, others=()):
    """Seconds from v0 to rest; others are rest-to-rest distances of further axes."""
    n = 1 + len(others)
    start = ruckig.InputParameter(n)
    start.current_velocity = [v0] + [0] * (n - 1)
    start.target_position = [distance, *others]
    start.max_velocity = [4 * v0] + [1] * (n - 1)
    start.max_acceleration, start.max_jerk = [a] * n, [j] * n
    answer = ruckig.Trajectory(n)
    assert ruckig.Ruckig(n).calculate(start, answer) == ruckig.Result.Working
    return answer.duration


def five_phases(a, j):
    """Initial speed, distance and duration of the plain profile, exactly."""
    step = a / j
    v0 = a * a / j
    position, velocity, acceleration = Fraction(0), v0, Fraction(0)
    for jerk in (j, -j, -j, 0, j):
        position += step * (velocity + step * (acceleration / 2 + step * jerk / 6))
        velocity += step * (acceleration + step * jerk / 2)
        acceleration += step * jerk
        assert abs(acceleration) <= a and 0 <= velocity <= 2 * v0
    assert velocity == acceleration == 0
    return v0, position, 5 * step


v0, distance, fastest = five_phases(Fraction(14, 10), Fraction(7))
assert (v0, distance, fastest) == (Fraction("0.28"), Fraction("0.336"), 1)
found = duration(0.28, 0.336, 1.4, 7.0)
print(f"0.336 m from 0.28 m/s: {found:.6f} s, five phases {float(fastest):.6f} s")
assert abs(found - 2.4) < 1e-9

for relative in (-1e-6, -1e-10, -1e-14, 1e-14, 1e-10, 1e-6):
    near = duration(0.28, 0.336 * (1 + relative), 1.4, 7.0)
    print(f"    distance {relative:+.0e} of it longer: {near:.6f} s")
    assert abs(near - 1) < 1e-5

arm = duration(0.28, 0.336, 1.4, 7.0, others=(0.1, 0.05, 0.02, 0.01, 0.01))
alone = duration(0.28, 0.3361, 1.4, 7.0, others=(0.1, 0.05, 0.02, 0.01, 0.01))
print(f"six axes: {arm:.4f} s, with 0.3361 m {alone:.4f} s")
assert abs(arm - 2.4) < 1e-9 and alone < 1.01

slow, factors, examples = 0, set(), []
jerks = [*range(1, 61), 75, 80, 90, 100, 120, 150, 200, 250, 300, 400, 500]
cases = [(Fraction(tenths, 10), Fraction(j)) for tenths in range(1, 101) for j in jerks]
cases = [(a, j) for a, j in cases if Fraction(1, 100) <= a * a / j <= 3]
for a, j in cases:
    v0, distance, fastest = five_phases(a, j)
    ratio = duration(float(v0), float(distance), float(a), float(j)) / float(fastest)
    assert ratio > 1 - 1e-9
    if ratio > 1.001:
        slow += 1
        factors.add(round(ratio, 6))
        if all(1000 * x == int(1000 * x) for x in (v0, distance)):
            examples.append(tuple(map(float, (v0, distance, a, j))))
print(f"{slow} of {len(cases)} are slow, by {sorted(factors)}")
print(f"{len(examples)} of them in whole millimeters, among them:")
for v0, distance, a, j in examples[::20]:
    print(f"    {v0} m/s, {distance} m, {a} m/s2, {j} m/s3")
assert factors == {2.4} and 1500 < slow < 2500 and len(examples) > 50
PYTHON
