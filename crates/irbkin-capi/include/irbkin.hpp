// irbkin for C++17: robots that free themselves, answers as values, errors as exceptions.
//
// Header only, over irbkin.h, whose units and rules hold; its other functions take `get()`. Solves
// do not use the heap; batches and errors do. docs/guide/c.md has examples.
#ifndef IRBKIN_HPP
#define IRBKIN_HPP

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "irbkin.h"

namespace irbkin {

/// A refused call: its code, and a message that names the argument, its value and the bound.
class Error : public std::runtime_error {
public:
    explicit Error(IrbkinCode code) : std::runtime_error(irbkin_last_error()), code_(code) {}

    IrbkinCode code() const noexcept { return code_; }

private:
    IrbkinCode code_;
};

/// Throw the error of a call that failed.
inline void check(IrbkinCode code) {
    if (code != IRBKIN_CODE_OK) throw Error(code);
}

/// A 4x4 homogeneous matrix by rows [m].
using Pose = std::array<double, 16>;
static_assert(sizeof(Pose) == 16 * sizeof(double), "rows of poses have no gaps");

/// The angles of six or of seven joints [rad].
class Joints {
public:
    Joints() = default;

    Joints(std::initializer_list<double> angles) : Joints(angles.begin(), angles.size()) {}

    Joints(const double *angles, std::size_t size) : size_(size) {
        if (size > angles_.size()) throw std::length_error("a robot has at most 7 joints");
        for (std::size_t i = 0; i < size; i++) angles_[i] = angles[i];
    }

    std::size_t size() const noexcept { return size_; }
    double *data() noexcept { return angles_.data(); }
    const double *data() const noexcept { return angles_.data(); }
    const double *begin() const noexcept { return data(); }
    const double *end() const noexcept { return data() + size_; }
    double &operator[](std::size_t joint) { return angles_[joint]; }
    double operator[](std::size_t joint) const { return angles_[joint]; }

private:
    std::array<double, IRBKIN_MOST_JOINTS> angles_{};
    std::size_t size_ = 0;
};

/// A joint vector that reaches a pose.
struct Solution {
    Joints q;
    std::size_t slot = 0;
    /// Flags IRBKIN_STATUS_...
    std::uint8_t status = 0;

    bool is_within_limits() const noexcept { return status & IRBKIN_STATUS_WITHIN_LIMITS; }
};

/// All solutions of a pose, inside the limits or not, in the order of their slots.
class Solutions {
public:
    std::size_t size() const noexcept { return size_; }
    bool empty() const noexcept { return size_ == 0; }
    const Solution *begin() const noexcept { return all_.data(); }
    const Solution *end() const noexcept { return begin() + size_; }

private:
    friend class Robot;

    /// Of rows of `dof` angles, and the flags of each slot.
    Solutions(const double *q, std::size_t dof, const std::uint8_t *status, std::size_t slots) {
        for (std::size_t slot = 0; slot < slots; slot++) {
            if (!(status[slot] & IRBKIN_STATUS_FOUND)) continue;
            all_[size_] = Solution{Joints(q + dof * slot, dof), slot, status[slot]};
            size_++;
        }
    }

    std::array<Solution, IRBKIN_MOST_SLOTS> all_{};
    std::size_t size_ = 0;
};

/// A robot arm. It does not change: with a tool, a base or limits it is another one.
class Robot {
public:
    /// Take a robot that a function of irbkin.h made, such as `irbkin_robot_with_tool`.
    explicit Robot(IrbkinRobot *robot)
        : handle_(robot), dof_(irbkin_robot_dof(robot)), slots_(irbkin_robot_slot_count(robot)) {}

    static Robot named(const std::string &name) {
        IrbkinRobot *robot = nullptr;
        check(irbkin_robot_named(name.c_str(), &robot));
        return Robot(robot);
    }

    /// `base` and `tip` are links; empty where the text has only one choice.
    static Robot from_urdf(const std::string &text, const std::string &base = {},
                           const std::string &tip = {}) {
        IrbkinRobot *robot = nullptr;
        check(irbkin_robot_from_urdf(text.c_str(), base.empty() ? nullptr : base.c_str(),
                                     tip.empty() ? nullptr : tip.c_str(), &robot));
        return Robot(robot);
    }

    std::size_t dof() const noexcept { return dof_; }
    std::size_t slot_count() const noexcept { return slots_; }
    std::string name() const { return irbkin_robot_name(get()); }
    const IrbkinRobot *get() const noexcept { return handle_.get(); }

    Pose fk(const Joints &q) const {
        Pose pose{};
        check(irbkin_fk(get(), q.data(), q.size(), pose.data()));
        return pose;
    }

    /// All solutions; `q7` is the angle of joint 7 of seven joints [rad].
    Solutions ik(const Pose &pose, std::optional<double> q7 = std::nullopt) const {
        std::array<double, IRBKIN_MOST_SLOTS * IRBKIN_MOST_JOINTS> q{};
        std::array<std::uint8_t, IRBKIN_MOST_SLOTS> status{};
        std::size_t found = 0;
        check(irbkin_ik(get(), pose.data(), q7 ? &*q7 : nullptr, q.data(), slots_ * dof_,
                        status.data(), slots_, &found));
        return Solutions(q.data(), dof_, status.data(), slots_);
    }

    /// The solution inside the limits that is nearest to a seed, if one is inside.
    std::optional<Joints> ik_nearest(const Pose &pose, const Joints &seed) const {
        Joints q = seed;
        const auto code =
            irbkin_ik_nearest(get(), pose.data(), seed.data(), nullptr, q.data(), seed.size());
        if (code == IRBKIN_CODE_UNREACHABLE) return std::nullopt;
        check(code);
        return q;
    }

    std::vector<Pose> fk_batch(const std::vector<Joints> &q, std::size_t threads = 1) const {
        std::vector<double> flat;
        for (const auto &row : q) {
            if (row.size() != dof_) throw std::length_error("q must have an angle for each joint");
            flat.insert(flat.end(), row.begin(), row.end());
        }
        std::vector<Pose> poses(q.size());
        double *numbers = poses.empty() ? nullptr : poses.front().data();
        check(irbkin_fk_batch(get(), flat.data(), flat.size(), numbers, 16 * poses.size(),
                              threads));
        return poses;
    }

    /// All solutions of many poses; `angles` has the angle of joint 7 of seven at each [rad].
    std::vector<Solutions> ik_batch(const std::vector<Pose> &poses,
                                    const std::vector<double> &angles = {},
                                    std::size_t threads = 1) const {
        if (!angles.empty() && angles.size() != poses.size()) {
            throw std::length_error("angles must be empty or as many as poses");
        }
        std::vector<double> q(poses.size() * slots_ * dof_);
        std::vector<std::uint8_t> status(poses.size() * slots_);
        const double *numbers = poses.empty() ? nullptr : poses.front().data();
        check(irbkin_ik_batch(get(), numbers, poses.size(),
                              angles.empty() ? nullptr : angles.data(), q.data(), q.size(),
                              status.data(), status.size(), threads));
        std::vector<Solutions> answers;
        for (std::size_t row = 0; row < poses.size(); row++) {
            const double *angles_of_row = q.data() + row * slots_ * dof_;
            const std::uint8_t *status_of_row = status.data() + row * slots_;
            answers.push_back(Solutions(angles_of_row, dof_, status_of_row, slots_));
        }
        return answers;
    }

private:
    struct Free {
        void operator()(IrbkinRobot *robot) const noexcept { irbkin_robot_free(robot); }
    };

    std::unique_ptr<IrbkinRobot, Free> handle_;
    std::size_t dof_, slots_;
};

}  // namespace irbkin

#endif  // IRBKIN_HPP
