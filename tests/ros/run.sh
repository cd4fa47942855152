#!/usr/bin/env bash
# Runs a Python program of this folder where ROS is installed: tests/ros/run.sh ros1|ros2 PROGRAM...
set -eo pipefail
cd "$(dirname "$0")/../.."
ros=$1
program=tests/ros/$2
shift 2
# irbkin is the checkout's own, as `make` built it.
case $ros in
ros1)
    export PATH=/usr/bin:/bin
    . target/ros1/install_isolated/setup.bash
    python=/usr/bin/python3
    ;;
ros2)
    export AMENT_PREFIX_PATH=$PWD/.venv-ros2
    . .venv-ros2/ws/install/setup.bash
    python=.venv-ros2/bin/python
    ;;
esac
export PYTHONPATH=$PWD/python:$PYTHONPATH
exec "$python" "$program" "$@"
