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

template <std::size_t K>
std::vector<std::array<double, K>> rows(const double *flat, std::size_t count) {
    std::vector<std::array<double, K>> rows(count);
    for (std::size_t i = 0; i < K * count; i++) rows[i / K][i % K] = flat[i];
    return rows;
}

void an_arm_has_the_answers_of_the_rust_crate(const irbkin::Robot &robot, const Arm &arm) {
    const std::size_t dof = robot.dof();
    LAW(robot.name() == arm.name && dof == arm.dof && robot.slot_count() == arm.slot_count);
    const irbkin::Joints q(arm.q, dof), seed(arm.seed, dof);
    const auto q7 = dof == 7 ? std::optional<double>(arm.q[6]) : std::nullopt;
    const auto pose = robot.fk(q);
    LAW(same(pose, arm.pose, 16));
    const auto columns = robot.jacobian(q, IRBKIN_FRAME_TOOL);
    for (std::size_t i = 0; i < 6 * dof; i++) LAW(columns[i % dof][i / dof] == arm.jacobian[1][i]);
    const auto all = robot.ik(pose, q7);
    std::size_t count = 0;
    for (const auto solution : all) {
        LAW(same(solution.q, arm.solutions + dof * solution.slot, dof));
        LAW(solution.status == arm.status[solution.slot] && all.slot(solution.slot).has_value());
        LAW(solution.is_within_limits() == ((solution.status & IRBKIN_STATUS_WITHIN_LIMITS) != 0));
        count++;
    }
    LAW(count == arm.found && count == all.size() && !all.empty());
    LAW(!all.slot(all.slot_count()).has_value());
    LAW(robot.explain(pose, q7) == arm.explained);
    const auto nearest = robot.ik_nearest(pose, seed);
    LAW(nearest.has_value() && nearest->size() == dof);
    const auto limits = robot.limits();
    for (std::size_t i = 0; i < 2 * dof; i++) LAW(limits[i / 2][i % 2] == arm.limits[i]);
}

void rows_and_paths_have_the_answers_of_the_rust_crate(const irbkin::Robot &robot) {
    const std::size_t count = 64;
    std::vector<irbkin::Joints> joints;
    for (std::size_t i = 0; i < count; i++) joints.emplace_back(MANY_JOINTS + 6 * i, 6);
    auto poses = robot.fk_batch(joints);
    LAW(same(poses[count - 1], MANY_POSES + 16 * (count - 1), 16));
    const auto answers = robot.ik_batch(poses);
    for (const auto solution : answers[8]) {
        LAW(same(solution.q, MANY_SOLUTIONS + 48 * 8 + 6 * solution.slot, 6));
    }
    LAW(answers[8].size() > 0 && robot.fk_batch({}).empty() && robot.ik_batch({}).empty());

    irbkin::Pose at;
    std::memcpy(at.data(), WALL, sizeof WALL);
    const irbkin::Cell cell({{"wall", {0.4, 2.0, 0.5}, at}}, 0.01);
    for (std::size_t i = 0; i < count; i++) {
        LAW(robot.collides(joints[i], cell) == MANY_COLLIDE[i]);
        LAW(robot.collides(joints[i], irbkin::Cell()) == MANY_FOLD[i]);
    }

    const std::size_t length = sizeof LINE_BREAKS;
    std::vector<irbkin::Pose> line = rows<16>(LINE_POSES, length),
                              far = rows<16>(FAR_POSES, length);
    const irbkin::Joints start(SEED, 6);
    auto followed = robot.follow(line, start);
    LAW(followed.reason.empty() &&
        same(*followed.q[length - 1], LINE_FOLLOWED + 6 * (length - 1), 6));
    followed = robot.follow(far, start);
    LAW(followed.reason == FAR_BREAK && !followed.q[length - 1] && followed.is_break[length - 1]);
    IrbkinPlanOptions options = {};
    options.rotation_steps = 9, options.rotation_lower = -0.5, options.rotation_upper = 0.5;
    auto plan = robot.plan(far, options);
    LAW(plan.reason == FAR_NO_PLAN && !plan.q[length - 1] && plan.slot[length - 1] == -1);
    options.cell = cell.get();
    plan = robot.plan(line, options);
    LAW(plan.reason.empty() && plan.report.certified && plan.tool_angle[7] == LINE_ANGLES[7]);
    LAW(same(*plan.q[length - 1], LINE_PLANNED + 6 * (length - 1), 6));
    LAW(robot.plan(line).report.breaks == 0);
}

void errors_are_exceptions(const irbkin::Robot &robot) {
    LAW(throws(IRBKIN_CODE_UNKNOWN_ROBOT, "IRB 9999", [] { irbkin::Robot::named("IRB 9999"); }));
    LAW(throws(IRBKIN_CODE_INVALID_ARGUMENT, "q has 5 elements",
               [&] { robot.fk({0, 0, 0, 0, 0}); }));
    LAW(throws(IRBKIN_CODE_INVALID_JOINTS, "q[2] is NaN", [&] { robot.fk({0, 0, NAN, 0, 0, 0}); }));
    LAW(throws(IRBKIN_CODE_INVALID_POSE, "pose", [&] { robot.ik(irbkin::Pose{}); }));
    LAW(throws(IRBKIN_CODE_INVALID_BODY, "boxes[0]", [] {
        irbkin::Cell({{"flat", {0.1, 0.1, 0.0}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
    }));
    auto pose = robot.fk({0, 0, 0, 0, 0.5, 0});
    pose[3] = 500.0;
    LAW(!robot.ik_nearest(pose, {0, 0, 0, 0, 0.5, 0}) && robot.ik(pose).empty());
    LAW(robot.explain(pose).find("beyond reach") != std::string::npos);
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
    irbkin::Pose tool, base;
    std::memcpy(tool.data(), TOOL, sizeof TOOL);
    std::memcpy(base.data(), BASE, sizeof BASE);
    const auto irb = irbkin::Robot::named("IRB 2600-12/1.65");
    an_arm_has_the_answers_of_the_rust_crate(irb, ARMS[0]);
    an_arm_has_the_answers_of_the_rust_crate(irbkin::Robot::named("Panda"), ARMS[1]);
    an_arm_has_the_answers_of_the_rust_crate(irbkin::Robot::from_urdf(urdf.str(), {}, "tool0"),
                                             ARMS[2]);
    an_arm_has_the_answers_of_the_rust_crate(irbkin::Robot::from_mdh(rows<4>(MDH, 6)), ARMS[3]);
    an_arm_has_the_answers_of_the_rust_crate(irbkin::Robot::from_sdh(rows<4>(SDH, 6)), ARMS[4]);
    an_arm_has_the_answers_of_the_rust_crate(irbkin::Robot::from_opw(OPW), ARMS[5]);
    const auto changed = irb.with_tool(tool).with_base(base).with_limits(rows<2>(LIMITS, 6));
    an_arm_has_the_answers_of_the_rust_crate(changed, ARMS[6]);
    LAW(!irbkin::Robot::from_opw(OPW).with_approximate_body().collides({0, 0, 0, 0, 0, 0},
                                                                       irbkin::Cell()));
    LAW(irb.configuration(irbkin::Joints(ARMS[0].q, 6))[3] == CONFDATA[3]);
    std::array<std::int32_t, 4> confdata;
    std::memcpy(confdata.data(), CONFDATA, sizeof CONFDATA);
    LAW(same(irb.ik_configured(irb.fk(irbkin::Joints(ARMS[0].q, 6)), confdata), CONFIGURED, 6));
    rows_and_paths_have_the_answers_of_the_rust_crate(irb);
    errors_are_exceptions(irb);
    std::printf("irbkin %s in C++: %d comparisons hold\n", irbkin_version(), laws);
}
