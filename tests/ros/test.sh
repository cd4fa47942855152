#!/usr/bin/env bash
# Installs ROS 1 and ROS 2, each in a folder of its own, and checks the nodes: tests/ros/test.sh
# [--starts COUNT]. VENV has irbkin. With --starts, nodes are started and ended COUNT times.
set -euo pipefail
cd "$(dirname "$0")/../.."
starts=
if [ "${1:-}" = --starts ]; then
    starts=$2
fi

for ros in ros1 ros2; do
    code=0
    tests/step.sh "Install $ros, build the workspace" "tests/ros/install_$ros.sh" "$VENV/bin/python" || code=$?
    if [ "$code" = 77 ]; then
        echo "SKIPPED: the node of $ros was not checked (the reason is above)"
        continue
    fi
    [ "$code" = 0 ] || exit "$code"
    if [ -n "$starts" ]; then
        tests/ros/run.sh "$ros" starts.py "$ros" "$starts"
    else
        tests/ros/run.sh "$ros" "check_$ros.py"
    fi
done
