#!/usr/bin/env bash
# Installs ROS 1 from Debian and builds the workspace into target/ros1 with catkin.
# tests/ros/install_ros1.sh: exit code 77 where ROS 1 cannot be installed, with the reason.
set -euo pipefail
cd "$(dirname "$0")/../.."
workspace=$PWD/target/ros1

skip() {
    echo "$1" >&2
    exit 77
}

packages=(
    build-essential catkin ros-message-generation ros-message-runtime
    lib{std,geometry}-msgs-dev ros-{std,geometry}-msgs python3-{std,geometry}-msgs
    python3-{rospy,rosmaster,roslaunch,rosservice,genpy,rospkg,numpy}
)
if ! dpkg -s "${packages[@]}" >/dev/null 2>&1; then
    command -v apt-get >/dev/null || skip "ROS 1 comes from Debian's packages, and there is no apt-get"
    [ "$(id -u)" = 0 ] || skip "ROS 1: apt-get needs root to install ${packages[*]}"
    tests/retry.sh apt-get update -qq || skip "ROS 1: apt-get update failed"
    DEBIAN_FRONTEND=noninteractive tests/retry.sh apt-get install -y -qq --no-install-recommends "${packages[@]}" >/dev/null ||
        skip "ROS 1: these packages cannot be installed: ${packages[*]}"
fi

# A user's workspace has these two packages in src, too.
rm -rf "$workspace"
mkdir -p "$workspace/src"
ln -s "$PWD/ros/irbkin_interfaces" "$PWD/ros/irbkin_ros1" "$workspace/src/"
cd "$workspace"
ROS_VERSION=1 catkin_make_isolated --install -DPYTHON_EXECUTABLE=/usr/bin/python3 >build.log 2>&1 || {
    cat build.log
    exit 1
}
