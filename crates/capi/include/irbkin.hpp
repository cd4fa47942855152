// irbkin for C++17: robots that free themselves, answers as values, errors as exceptions.
//
// Header only, over irbkin.h, whose units and rules hold. Solves do not use the heap; batches,
// paths and errors do. docs/guide/c.md has examples.
#ifndef IRBKIN_HPP
#define IRBKIN_HPP

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
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

/// The angles of six or of seven joints [rad].
class Joints {
public:
    Joints() = default;

    Joints(std::initializer_list<double> angles) : Joints(angles.begin(), angles.size()) {}

    Joints(const double *angles, std::size_t size) : size_(size) {
        if (size > angles_.size()) throw std::length_error("a robot has at most 7 joints");
        for (std::size_t i = 0; i < size; i++) angles_[i] = angles[i];
    }

    /// As many angles as a robot has joints, to be written.
    static Joints of_size(std::size_t size) {
        Joints joints;
        joints.size_ = size < joints.angles_.size() ? size : joints.angles_.size();
        return joints;
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
    std::size_t slot;
    /// Flags IRBKIN_STATUS_...
    std::uint8_t status;

    bool is_within_limits() const noexcept { return status & IRBKIN_STATUS_WITHIN_LIMITS; }
};

/// All solutions of a pose, each in its slot.
class Solutions {
public:
    /// Number of solutions, inside the limits or not.
    std::size_t size() const noexcept { return found_; }
    bool empty() const noexcept { return found_ == 0; }
    std::size_t slot_count() const noexcept { return slots_; }
    /// The flags of a slot, IRBKIN_STATUS_...
    std::uint8_t status(std::size_t slot) const { return status_.at(slot); }

    /// The solution in a slot; none if it is empty.
    std::optional<Solution> slot(std::size_t slot) const {
        if (slot >= slots_ || !(status_[slot] & IRBKIN_STATUS_FOUND)) return std::nullopt;
        return Solution{Joints(q_.data() + dof_ * slot, dof_), slot, status_[slot]};
    }

    /// Goes from solution to solution, in the order of their slots.
    class Iterator {
    public:
        Iterator(const Solutions &all, std::size_t slot) : all_(&all), slot_(slot) { skip(); }

        Solution operator*() const { return *all_->slot(slot_); }
        Iterator &operator++() {
            slot_++;
            skip();
            return *this;
        }
        bool operator!=(const Iterator &other) const noexcept { return slot_ != other.slot_; }

    private:
        void skip() {
            while (slot_ < all_->slots_ && !(all_->status_[slot_] & IRBKIN_STATUS_FOUND)) slot_++;
        }

        const Solutions *all_;
        std::size_t slot_;
    };

    Iterator begin() const { return {*this, 0}; }
    Iterator end() const { return {*this, slots_}; }

private:
    friend class Robot;

    std::array<double, IRBKIN_MOST_SLOTS * IRBKIN_MOST_JOINTS> q_{};
    std::array<std::uint8_t, IRBKIN_MOST_SLOTS> status_{};
    std::size_t dof_ = 0, slots_ = 0, found_ = 0;
};

/// An obstacle that is a box, around the origin of its pose.
struct Box {
    std::string name;
    std::array<double, 3> size;
    Pose pose;
};

/// Obstacles from which an arm is to stay at least a margin [m].
class Cell {
public:
    explicit Cell(const std::vector<Box> &boxes = {}, double margin = 0.0) {
        std::vector<IrbkinBox> plain(boxes.size());
        for (std::size_t i = 0; i < boxes.size(); i++) {
            plain[i].name = boxes[i].name.c_str();
            for (std::size_t j = 0; j < 3; j++) plain[i].size[j] = boxes[i].size[j];
            for (std::size_t j = 0; j < 16; j++) plain[i].pose[j] = boxes[i].pose[j];
        }
        IrbkinCell *made = nullptr;
        check(irbkin_cell_of_boxes(plain.data(), plain.size(), margin, &made));
        handle_.reset(made);
    }

    const IrbkinCell *get() const noexcept { return handle_.get(); }

private:
    struct Free {
        void operator()(IrbkinCell *cell) const noexcept { irbkin_cell_free(cell); }
    };
    std::unique_ptr<IrbkinCell, Free> handle_;
};

/// A joint path that was followed.
struct Followed {
    /// Joint angles at each pose; none where it is not reached.
    std::vector<std::optional<Joints>> q;
    /// Whether a pose is not reached, or by a jump only.
    std::vector<bool> is_break;
    /// The first break and its reason; empty without one.
    std::string reason;
};

/// A joint path that was planned.
struct Plan {
    /// Joint angles at each pose; none where a plan with breaks has none.
    std::vector<std::optional<Joints>> q;
    /// The angle that the tool is turned by at each pose [rad].
    std::vector<double> tool_angle;
    /// The slot of the branch at each pose; -1 where a plan with breaks has none.
    std::vector<std::int32_t> slot;
    IrbkinPlanReport report;
    /// Why no path is without breaks; empty of a whole plan.
    std::string reason;
};

/// A robot arm. It does not change; a copy is made by `with_...`.
class Robot {
public:
    static Robot named(const std::string &name) {
        return made([&](IrbkinRobot **robot) { return irbkin_robot_named(name.c_str(), robot); });
    }

    /// `base` and `tip` are links; empty where the text has only one choice.
    static Robot from_urdf(const std::string &text, const std::string &base = {},
                           const std::string &tip = {}) {
        const auto link = [](const std::string &name) {
            return name.empty() ? nullptr : name.c_str();
        };
        return made([&](IrbkinRobot **robot) {
            return irbkin_robot_from_urdf(text.c_str(), link(base), link(tip), robot);
        });
    }

    /// Rows of alpha [rad], a [m], d [m] and the theta offset [rad] (modified, Craig).
    static Robot from_mdh(const std::vector<std::array<double, 4>> &rows) {
        const auto flat = flattened(rows);
        return made([&](IrbkinRobot **robot) {
            return irbkin_robot_from_mdh(flat.data(), flat.size(), robot);
        });
    }

    /// As `from_mdh`, of a standard table.
    static Robot from_sdh(const std::vector<std::array<double, 4>> &rows) {
        const auto flat = flattened(rows);
        return made([&](IrbkinRobot **robot) {
            return irbkin_robot_from_sdh(flat.data(), flat.size(), robot);
        });
    }

    static Robot from_opw(const IrbkinOpwParameters &parameters) {
        return made([&](IrbkinRobot **robot) { return irbkin_robot_from_opw(&parameters, robot); });
    }

    Robot with_tool(const Pose &tool) const {
        return made(
            [&](IrbkinRobot **robot) { return irbkin_robot_with_tool(get(), tool.data(), robot); });
    }

    Robot with_base(const Pose &base) const {
        return made(
            [&](IrbkinRobot **robot) { return irbkin_robot_with_base(get(), base.data(), robot); });
    }

    /// (lower, upper) limit of each joint [rad].
    Robot with_limits(const std::vector<std::array<double, 2>> &limits) const {
        const auto flat = flattened(limits);
        return made([&](IrbkinRobot **robot) {
            return irbkin_robot_with_limits(get(), flat.data(), flat.size(), robot);
        });
    }

    Robot with_approximate_body() const {
        return made(
            [&](IrbkinRobot **robot) { return irbkin_robot_with_approximate_body(get(), robot); });
    }

    std::size_t dof() const noexcept { return dof_; }
    std::size_t slot_count() const noexcept { return slots_; }
    std::string name() const { return irbkin_robot_name(get()); }
    const IrbkinRobot *get() const noexcept { return handle_.get(); }

    std::vector<std::array<double, 2>> limits() const {
        std::array<double, 2 * IRBKIN_MOST_JOINTS> flat{};
        check(irbkin_robot_limits(get(), flat.data(), 2 * dof_));
        std::vector<std::array<double, 2>> limits;
        for (std::size_t i = 0; i < dof_; i++) limits.push_back({flat[2 * i], flat[2 * i + 1]});
        return limits;
    }

    Pose fk(const Joints &q) const {
        Pose pose{};
        check(irbkin_fk(get(), q.data(), q.size(), pose.data()));
        return pose;
    }

    /// The columns of the Jacobian: column `i` has three linear rows [m/rad] and three angular [1]
    /// of joint `i + 1`, the first `dof()` columns.
    std::array<std::array<double, 6>, IRBKIN_MOST_JOINTS> jacobian(
        const Joints &q, IrbkinFrame frame = IRBKIN_FRAME_BASE) const {
        std::array<double, 6 * IRBKIN_MOST_JOINTS> flat{};
        check(irbkin_jacobian(get(), q.data(), q.size(), frame, flat.data(), 6 * dof_));
        std::array<std::array<double, 6>, IRBKIN_MOST_JOINTS> columns{};
        for (std::size_t i = 0; i < 6 * dof_; i++) columns[i % dof_][i / dof_] = flat[i];
        return columns;
    }

    /// All solutions; `q7` is the angle of joint 7 of seven joints [rad].
    Solutions ik(const Pose &pose, std::optional<double> q7 = std::nullopt) const {
        Solutions all;
        all.dof_ = dof_;
        all.slots_ = slots_;
        check(irbkin_ik(get(), pose.data(), q7 ? &*q7 : nullptr, all.q_.data(), slots_ * dof_,
                        all.status_.data(), slots_, &all.found_));
        return all;
    }

    /// How many solutions a pose has, or why it has none.
    std::string explain(const Pose &pose, std::optional<double> q7 = std::nullopt) const {
        std::array<char, 512> text{};
        check(irbkin_explain(get(), pose.data(), q7 ? &*q7 : nullptr, text.data(), text.size()));
        return text.data();
    }

    /// The solution inside the limits that is nearest to a seed, if one is inside.
    std::optional<Joints> ik_nearest(const Pose &pose, const Joints &seed) const {
        Joints q = Joints::of_size(dof_);
        const auto code =
            irbkin_ik_nearest(get(), pose.data(), seed.data(), nullptr, q.data(), seed.size());
        if (code == IRBKIN_CODE_UNREACHABLE) return std::nullopt;
        check(code);
        return q;
    }

    /// ABB's confdata cf1, cf4, cf6, cfx.
    std::array<std::int32_t, 4> configuration(const Joints &q) const {
        std::array<std::int32_t, 4> confdata{};
        check(irbkin_configuration(get(), q.data(), q.size(), confdata.data()));
        return confdata;
    }

    /// The solution with ABB's confdata.
    Joints ik_configured(const Pose &pose, const std::array<std::int32_t, 4> &confdata) const {
        Joints q = Joints::of_size(dof_);
        check(irbkin_ik_configured(get(), pose.data(), confdata.data(), nullptr, nullptr, q.data(),
                                   q.size()));
        return q;
    }

    std::vector<Pose> fk_batch(const std::vector<Joints> &q, std::size_t threads = 1) const {
        const auto flat = rows(q);
        std::vector<Pose> poses(q.size());
        check(irbkin_fk_batch(get(), flat.data(), flat.size(), numbers(poses), 16 * poses.size(),
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
        check(irbkin_ik_batch(get(), numbers(poses), poses.size(),
                              angles.empty() ? nullptr : angles.data(), q.data(), q.size(),
                              status.data(), status.size(), threads));
        std::vector<Solutions> answers(poses.size());
        for (std::size_t row = 0; row < poses.size(); row++) {
            Solutions &all = answers[row];
            all.dof_ = dof_;
            all.slots_ = slots_;
            for (std::size_t i = 0; i < slots_ * dof_; i++) all.q_[i] = q[row * slots_ * dof_ + i];
            for (std::size_t i = 0; i < slots_; i++) {
                all.status_[i] = status[row * slots_ + i];
                all.found_ += all.status_[i] & IRBKIN_STATUS_FOUND ? 1 : 0;
            }
        }
        return answers;
    }

    /// One continuous joint path from the solution nearest to a seed. A break is no exception.
    Followed follow(const std::vector<Pose> &poses, const Joints &seed) const {
        std::vector<double> q(poses.size() * dof_);
        const auto is_break = std::make_unique<bool[]>(poses.size());
        const auto code = irbkin_follow(get(), numbers(poses), poses.size(), seed.data(),
                                        seed.size(), q.data(), q.size(), is_break.get());
        const std::string reason = broken(code);
        std::vector<bool> breaks(is_break.get(), is_break.get() + poses.size());
        return {joints(q), std::move(breaks), reason};
    }

    /// The best joint path over all branches, turns and what is free. A break is no exception.
    Plan plan(const std::vector<Pose> &poses, const IrbkinPlanOptions &options = {}) const {
        std::vector<double> q(poses.size() * dof_);
        Plan plan{
            {}, std::vector<double>(poses.size()), std::vector<std::int32_t>(poses.size()), {}, {}};
        const auto code =
            irbkin_plan(get(), numbers(poses), poses.size(), &options, q.data(), q.size(),
                        plan.tool_angle.data(), plan.slot.data(), &plan.report);
        plan.reason = broken(code);
        plan.q = joints(q);
        return plan;
    }

    /// Whether the arm touches itself or comes nearer to an obstacle than the margin.
    bool collides(const Joints &q, const Cell &cell) const {
        if (q.size() != dof_) throw std::length_error("q must have an angle for each joint");
        bool collides = false;
        check(irbkin_collides(get(), cell.get(), q.data(), 1, &collides, 1));
        return collides;
    }

private:
    struct Free {
        void operator()(IrbkinRobot *robot) const noexcept { irbkin_robot_free(robot); }
    };

    explicit Robot(IrbkinRobot *robot)
        : handle_(robot), dof_(irbkin_robot_dof(robot)), slots_(irbkin_robot_slot_count(robot)) {}

    template <class Make>
    static Robot made(const Make &make) {
        IrbkinRobot *robot = nullptr;
        check(make(&robot));
        return Robot(robot);
    }

    template <std::size_t K>
    static std::vector<double> flattened(const std::vector<std::array<double, K>> &rows) {
        std::vector<double> flat;
        for (const auto &row : rows) flat.insert(flat.end(), row.begin(), row.end());
        return flat;
    }

    /// Poses as the numbers that they are.
    static const double *numbers(const std::vector<Pose> &poses) noexcept {
        static_assert(sizeof(Pose) == 16 * sizeof(double), "poses are numbers without gaps");
        return poses.empty() ? nullptr : poses.front().data();
    }
    static double *numbers(std::vector<Pose> &poses) noexcept {
        return poses.empty() ? nullptr : poses.front().data();
    }

    std::vector<double> rows(const std::vector<Joints> &q) const {
        std::vector<double> flat;
        for (const auto &row : q) {
            if (row.size() != dof_) throw std::length_error("q must have an angle for each joint");
            flat.insert(flat.end(), row.begin(), row.end());
        }
        return flat;
    }

    /// Rows of joint angles; none where they are NaN.
    std::vector<std::optional<Joints>> joints(const std::vector<double> &q) const {
        std::vector<std::optional<Joints>> rows(q.size() / dof_);
        for (std::size_t i = 0; i < rows.size(); i++) {
            if (!std::isnan(q[i * dof_])) rows[i] = Joints(q.data() + i * dof_, dof_);
        }
        return rows;
    }

    /// The reason of a broken path; other errors are thrown.
    static std::string broken(IrbkinCode code) {
        if (code == IRBKIN_CODE_BROKEN_PATH) return irbkin_last_error();
        check(code);
        return {};
    }

    std::unique_ptr<IrbkinRobot, Free> handle_;
    std::size_t dof_, slots_;
};

}  // namespace irbkin

#endif  // IRBKIN_HPP
