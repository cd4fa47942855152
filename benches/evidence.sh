#!/usr/bin/env bash
# A suite of long tests or counts, for `make evidence SUITE=`; without one it lists them. The
# numbers in parentheses are variables of make.
set -euo pipefail
cd "$(dirname "$0")/.."

venv=${VENV:-.venv}
rust() { cargo test -p irbkin -p irbkin-motion -p irbkin-tests --lib --tests --quiet --release -- "$@" --nocapture; }
serial() { rust "$@" --test-threads=1; }
tests() { "$venv/bin/python" -m pytest --quiet "$@"; }
package() { make --no-print-directory "$venv/.irbkin-${PROFILE:-develop}" "$venv/.group-check"; }
peers() { make --no-print-directory .venv-peers/.irbkin; }
released() { make --no-print-directory "$venv/.irbkin-release"; }

# A command on each instruction set of this processor; the widest is the default.
on_each_set() {
    local set
    for set in $(cargo run --quiet --example instruction_sets); do
        IRBKIN_INSTRUCTION_SET=$set "$@"
    done
}

million() { ## A million poses of each arm on each instruction set: missed, incorrect
    export IRBKIN_POSES=1000000
    on_each_set serial recall::
}

general() { ## POSES (20,000) poses of 20 arms without a closed form: found, lost
    package
    export IRBKIN_POSES=${POSES:-20000}
    serial recall::general recall::offset_wrist
    serial structure::general
    IRBKIN_POSES=200 tests tests/python/extras/test_general_oracles.py -m "extra or evidence"
}

certificates() { ## POSES (10,000,000) poses drawn to be hard: certified, missed
    IRBKIN_POSES=${POSES:-10000000} rust certificates::
}

offset-wrists() { ## JOINT_VECTORS (1000) of each set, arms with an offset wrist
    JOINT_VECTORS=${JOINT_VECTORS:-1000} rust offset_wrist::tests::each_arm
}

tails() { ## POSES (2000) poses at each singularity: p50 to the most, with a peer
    POSES=${POSES:-2000} cargo run --quiet --release --manifest-path benches/tails/Cargo.toml \
        --target-dir target/tails
}

worst-case() { ## POSES (60) hard poses of each set: p50 to the most, other packages; writes a page
    peers
    POSES=${POSES:-60} .venv-peers/bin/python -m benches.peers.worst_case --write
}

hardsets() { ## Poses and paths at and near every singularity
    IRBKIN_POSES=2000 on_each_set serial hard_sets:: follow::
    IRBKIN_POSES=200 on_each_set serial reach_and_paths::
    IRBKIN_POSES=1000 serial structure::spherical_shoulder
    IRBKIN_POSES=20 serial redundancy:: nearest::
}

plans() { ## 100,000 random lines planned, each step halved
    package
    IRBKIN_PLANS=50000 tests -s -k hides_a_jump tests/python/test_plan.py
}

stream() { ## CYCLES (10,000,000) cycles of guards: set points out of bounds, not free
    IRBKIN_POSES=$((${CYCLES:-10000000} / 14)) rust stream::
}

configurations() { ## confdata at 100,000 poses of every ABB arm
    IRBKIN_POSES=100000 serial configuration::
}

egm() { ## MESSAGES (100,000) of EGM beside protobuf, ten times as many broken, hours of losses
    package
    IRBKIN_MESSAGES=${MESSAGES:-100000} tests -s -m "extra or evidence" \
        tests/python/extras/test_egm_peers.py tests/python/test_egm_controller.py
}

ulp() { ## Arc tangent, sine and cosine against correctly rounded ones
    IRBKIN_POINTS=10000000 serial lanes::functions
}

no-std() { ## Laws and unit tests without the standard library
    local without=(--no-default-features --features libm)
    cargo test -p irbkin -p irbkin-motion --lib "${without[@]}" -- --include-ignored
    cargo test -p irbkin-tests "${without[@]}" -- laws:: coupled:: configuration:: allocation:: \
        rapid:: rapid_calc::
}

times() { ## Times of single poses and batches, of `calls`, and of a pose in C
    released
    cargo bench --bench one_pose --bench batch
    calls
    make --no-print-directory bench-capi
}

calls() { ## Times of Python's calls, motions, plans, a RAPID module; QUICK=1 few of each
    local bench
    for bench in python_calls motion motion_limits plan cells free_motion stream reach_map \
        rapid_module rapid_check command lsp; do
        "$venv/bin/python" "benches/$bench.py"
    done
}

follow() { ## Programs of RAPID below FOLDER: what share is checked, why the rest is not
    package
    "$venv/bin/python" benches/follow.py
}

stages() { ## Time of a pose by stages, with perf; SETS="avx2 avx512"
    # shellcheck disable=SC2086 # A list of words.
    python3 benches/stages.py ${SETS:-}
}

instructions() { ## Instructions of a call, with valgrind; WRITE=1 records them
    python3 benches/instructions.py ${WRITE:+--write}
}

ros-starts() { ## COUNT (200) nodes of each ROS ended with SIGTERM: none may hang
    package
    tests/ros/test.sh --starts "${COUNT:-200}"
}

readers() { ## to_urdf of every arm in eleven programs that read URDFs: wrong, farthest
    local reader
    package
    # One at a time: one without a wheel for this Python does not exclude the others.
    sed -nE '/^readers = /s/[][",]//g; s/^readers = //p' pyproject.toml | tr ' ' '\n' |
        while read -r reader; do
            "$venv/bin/pip" install --quiet --disable-pip-version-check "$reader" ||
                echo "$reader cannot be installed: left out"
        done
    tests -m evidence tests/python/extras/test_readers.py
}

if [ "$(type -t -- "${1:-}")" = function ] && grep -q "^$1() { ## " "$0"; then
    "$1"
else
    echo "Suites of \`make evidence SUITE=\`:"
    sed -nE 's/^([a-z-]+)\(\) \{ ## /\1\t/p' "$0" | expand -t 16
    [ $# -eq 0 ]
fi
