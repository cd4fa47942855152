// Laws of the C++ wrapper: wrapper URDF. Its answers are the Rust crate's, its errors are
// exceptions, its handles are freed once.
#include <irbkin.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

extern "C" {
#include "arm.h"
#include "expected.h"
}

namespace {

int laws = 0;

void law(bool holds, const char *words, int line) {
    laws++;
    if (!holds) {
        std::fprintf(stderr, "wrapper.cpp:%d: %s (%s)\n", line, words, irbkin_last_error());
        std::exit(1);
    }
}
#define LAW(...) law((__VA_ARGS__), #__VA_ARGS__, __LINE__)

template <class Numbers>
bool same(const Numbers &a, const double *b, std::size_t size) {
    return std::equal(b, b + size, a.data());
}

template <class Call>
bool throws(IrbkinCode code, const char *words, const Call &call) {
    try {
        call();
    } catch (const irbkin::Error &error) {
        return error.code() == code && std::strstr(error.what(), words);
    }
    return false;
}

void an_arm_has_the_answers_of_the_rust_crate(const irbkin::Robot &robot, const Arm &arm) {
    const std::size_t dof = robot.dof();
    LAW(robot.name() == arm.name && dof == arm.dof && robot.slot_count() == arm.slot_count);
    const irbkin::Joints q(arm.q, dof), seed(arm.seed, dof);
    const auto q7 = dof == 7 ? std::optional<double>(arm.q[6]) : std::nullopt;
    const auto pose = robot.fk(q);
    LAW(same(pose, arm.pose, 16));
    const auto all = robot.ik(pose, q7);
    std::size_t count = 0;
    for (const auto &solution : all) {
        LAW(same(solution.q, arm.solutions + dof * solution.slot, dof));
        LAW(solution.status == arm.status[solution.slot]);
        LAW(solution.is_within_limits() == ((solution.status & IRBKIN_STATUS_WITHIN_LIMITS) != 0));
        count++;
    }
    LAW(count == arm.found && count == all.size() && !all.empty());
    const auto nearest = robot.ik_nearest(pose, seed);
    LAW(nearest.has_value() && nearest->size() == dof);
}

void rows_have_the_answers_of_the_rust_crate(const irbkin::Robot &robot) {
    const std::size_t count = 64;
    std::vector<irbkin::Joints> joints;
    for (std::size_t i = 0; i < count; i++) joints.emplace_back(MANY_JOINTS + 6 * i, 6);
    auto poses = robot.fk_batch(joints);
    LAW(same(poses[count - 1], MANY_POSES + 16 * (count - 1), 16));
    const auto answers = robot.ik_batch(poses);
    for (const auto &solution : answers[8]) {
        LAW(same(solution.q, MANY_SOLUTIONS + 48 * 8 + 6 * solution.slot, 6));
    }
    LAW(answers[8].size() > 0 && robot.fk_batch({}).empty() && robot.ik_batch({}).empty());
}

void errors_are_exceptions(const irbkin::Robot &robot) {
    LAW(throws(IRBKIN_CODE_UNKNOWN_ROBOT, "IRB 9999", [] { irbkin::Robot::named("IRB 9999"); }));
    LAW(throws(IRBKIN_CODE_INVALID_ARGUMENT, "q has 5 elements",
               [&] { robot.fk({0, 0, 0, 0, 0}); }));
    LAW(throws(IRBKIN_CODE_INVALID_JOINTS, "q[2] is NaN", [&] { robot.fk({0, 0, NAN, 0, 0, 0}); }));
    LAW(throws(IRBKIN_CODE_INVALID_POSE, "pose", [&] { robot.ik(irbkin::Pose{}); }));
    auto pose = robot.fk({0, 0, 0, 0, 0.5, 0});
    pose[3] = 500.0;
    LAW(!robot.ik_nearest(pose, {0, 0, 0, 0, 0.5, 0}) && robot.ik(pose).empty());
    // A robot that is moved from is empty, and NULL is refused.
    auto moved = irbkin::Robot::named("UR5e");
    const auto other = std::move(moved);
    LAW(other.dof() == 6 && moved.get() == nullptr);
    LAW(throws(IRBKIN_CODE_INVALID_ARGUMENT, "robot is NULL",
               [&] { moved.fk({0, 0, 0, 0, 0, 0}); }));
}

}  // namespace

int main(int argc, char **argv) {
    if (argc != 2) return 2;
    std::stringstream urdf;
    urdf << std::ifstream(argv[1]).rdbuf();
    const auto irb = irbkin::Robot::named("IRB 2600-12/1.65");
    an_arm_has_the_answers_of_the_rust_crate(irb, ARMS[0]);
    an_arm_has_the_answers_of_the_rust_crate(irbkin::Robot::named("Panda"), ARMS[1]);
    an_arm_has_the_answers_of_the_rust_crate(irbkin::Robot::from_urdf(urdf.str(), {}, "tool0"),
                                             ARMS[2]);
    IrbkinRobot *made = nullptr;
    irbkin::check(irbkin_robot_from_opw(&OPW, &made));
    an_arm_has_the_answers_of_the_rust_crate(irbkin::Robot(made), ARMS[5]);
    irbkin::check(irbkin_robot_with_tool(irb.get(), TOOL, &made));
    const irbkin::Robot with_tool(made);
    irbkin::check(irbkin_robot_with_base(with_tool.get(), BASE, &made));
    const irbkin::Robot with_base(made);
    irbkin::check(irbkin_robot_with_limits(with_base.get(), LIMITS, 12, &made));
    an_arm_has_the_answers_of_the_rust_crate(irbkin::Robot(made), ARMS[6]);
    rows_have_the_answers_of_the_rust_crate(irb);
    errors_are_exceptions(irb);
    std::printf("irbkin %s in C++: %d comparisons hold\n", irbkin_version(), laws);
}
