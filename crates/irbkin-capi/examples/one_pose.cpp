// All solutions of a pose of an IRB 2600, and the one that is nearest to where the arm is:
// c++ -std=c++17 one_pose.cpp $(pkg-config --cflags --libs irbkin)
#include <irbkin.hpp>

#include <cstdio>

namespace {

/// Print joint angles [deg].
void print(const irbkin::Joints &q) {
    for (double angle : q) std::printf(" %8.3f", angle * 57.29577951308232);
    std::printf("\n");
}

}  // namespace

int main() {
    try {
        const auto robot = irbkin::Robot::named("IRB 2600-12/1.65");

        // z of the tool points down.
        const irbkin::Pose pose = {1, 0, 0, 0.85, 0, -1, 0, 0.32, 0, 0, -1, 0.64, 0, 0, 0, 1};
        const auto solutions = robot.ik(pose);
        std::printf("%s: %zu solutions\n", robot.name().c_str(), solutions.size());
        for (const auto &solution : solutions) {
            std::printf("slot %zu, %s the limits:", solution.slot,
                        solution.is_within_limits() ? " inside" : "outside");
            print(solution.q);
        }

        if (const auto q = robot.ik_nearest(pose, {0.3, 0.2, 0.1, 0.0, 0.9, 0.0})) {
            std::printf("nearest:                ");
            print(*q);
        }
    } catch (const irbkin::Error &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
