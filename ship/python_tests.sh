# The tests that run on a Python of another platform, to be sourced: they start no process and need
# no other package.
# shellcheck shell=bash disable=SC2034
tests=(tests/python/test_{poses,known_solutions,recorded_poses,forward,universal_robots}.py
    tests/python/test_{inverse,arrays,free_joints,singularity,reasons,configuration}.py)
