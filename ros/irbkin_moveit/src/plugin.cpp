// irbkin as a kinematics plugin of MoveIt 2: all solutions, the nearest to the seed first.
//
// UNTESTED: written after MoveIt's public header, compiled against declarations of it alone.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#if __has_include(<moveit/kinematics_base/kinematics_base.hpp>)
#include <moveit/kinematics_base/kinematics_base.hpp>
#include <moveit/robot_model/robot_model.hpp>
#else
#include <moveit/kinematics_base/kinematics_base.h>
#include <moveit/robot_model/robot_model.h>
#endif
#include <irbkin.hpp>
#include <pluginlib/class_list_macros.hpp>
#include <tf2_eigen/tf2_eigen.hpp>

namespace irbkin_moveit {

using moveit_msgs::msg::MoveItErrorCodes;
using PoseMsg = geometry_msgs::msg::Pose;
using Angles = std::vector<double>;
using kinematics::KinematicsQueryOptions;

constexpr double TURN = 2.0 * M_PI;

irbkin::Pose rows(const PoseMsg &message) {
    Eigen::Isometry3d pose;
    tf2::fromMsg(message, pose);
    irbkin::Pose rows;
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(rows.data()) = pose.matrix();
    return rows;
}

PoseMsg message(const irbkin::Pose &rows) {
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(rows.data());
    return tf2::toMsg(Eigen::Isometry3d(Eigen::Matrix4d(matrix)));
}

class Plugin : public kinematics::KinematicsBase {
public:
    bool initialize(const rclcpp::Node::SharedPtr &node, const moveit::core::RobotModel &model,
                    const std::string &group, const std::string &base,
                    const std::vector<std::string> &tips, double discretization) override {
        node_ = node;
        storeValues(model, group, base, tips, discretization);
        std::string text;
        if (tips.size() != 1) return refused("the group must have one tip");
        if (!node->get_parameter("robot_description", text)) {
            return refused("the parameter robot_description is missing");
        }
        try {
            robot_ = std::make_unique<irbkin::Robot>(irbkin::Robot::from_urdf(text, base, tips[0]));
        } catch (const std::exception &error) {
            return refused(error.what());
        }
        names_ = model.getJointModelGroup(group)->getActiveJointModelNames();
        if (names_.size() != robot_->dof()) return refused("the group must be the whole chain");
        limits_ = robot_->limits();
        links_ = tips;
        return true;
    }

    bool getPositionIK(const PoseMsg &pose, const Angles &seed, Angles &solution,
                       MoveItErrorCodes &code, const KinematicsQueryOptions & = {}) const override {
        return search(pose, seed, {}, {}, solution, code);
    }

    bool getPositionIK(const std::vector<PoseMsg> &poses, const Angles &seed,
                       std::vector<Angles> &solutions, kinematics::KinematicsResult &result,
                       const KinematicsQueryOptions &) const override {
        solutions = poses.size() == 1 ? sorted(poses[0], seed) : std::vector<Angles>{};
        result.solution_percentage = solutions.empty() ? 0.0 : 1.0;
        result.kinematic_error = solutions.empty() ? kinematics::KinematicErrors::NO_SOLUTION
                                                   : kinematics::KinematicErrors::OK;
        return !solutions.empty();
    }

    bool searchPositionIK(const PoseMsg &pose, const Angles &seed, double, Angles &solution,
                          MoveItErrorCodes &code,
                          const KinematicsQueryOptions & = {}) const override {
        return search(pose, seed, {}, {}, solution, code);
    }

    bool searchPositionIK(const PoseMsg &pose, const Angles &seed, double, const Angles &consistency,
                          Angles &solution, MoveItErrorCodes &code,
                          const KinematicsQueryOptions & = {}) const override {
        return search(pose, seed, consistency, {}, solution, code);
    }

    bool searchPositionIK(const PoseMsg &pose, const Angles &seed, double, Angles &solution,
                          const IKCallbackFn &callback, MoveItErrorCodes &code,
                          const KinematicsQueryOptions & = {}) const override {
        return search(pose, seed, {}, callback, solution, code);
    }

    bool searchPositionIK(const PoseMsg &pose, const Angles &seed, double, const Angles &consistency,
                          Angles &solution, const IKCallbackFn &callback, MoveItErrorCodes &code,
                          const KinematicsQueryOptions & = {}) const override {
        return search(pose, seed, consistency, callback, solution, code);
    }

    bool getPositionFK(const std::vector<std::string> &links, const Angles &angles,
                       std::vector<PoseMsg> &poses) const override {
        if (links != links_ || angles.size() != names_.size()) return false;
        poses = {message(robot_->fk(irbkin::Joints(angles.data(), angles.size())))};
        return true;
    }

    const std::vector<std::string> &getJointNames() const override { return names_; }
    const std::vector<std::string> &getLinkNames() const override { return links_; }

private:
    bool refused(const std::string &reason) const {
        RCLCPP_ERROR(node_->get_logger(), "irbkin: %s", reason.c_str());
        return false;
    }

    /// The first solution that passes; none is tried twice, so no time limit is needed.
    bool search(const PoseMsg &pose, const Angles &seed, const Angles &consistency,
                const IKCallbackFn &callback, Angles &solution, MoveItErrorCodes &code) const {
        for (const Angles &q : sorted(pose, seed)) {
            bool is_near = true;
            for (std::size_t i = 0; i < consistency.size(); i++) {
                is_near = is_near && std::abs(q[i] - seed[i]) <= consistency[i];
            }
            if (!is_near) continue;
            code.val = MoveItErrorCodes::SUCCESS;
            if (callback) callback(pose, q, code);
            if (code.val != MoveItErrorCodes::SUCCESS) continue;
            solution = q;
            return true;
        }
        code.val = MoveItErrorCodes::NO_IK_SOLUTION;
        return false;
    }

    /// The solutions inside the limits, each in the turns that are nearest to the seed, the nearest
    /// first. Seven axes: the nearest of all, and those with joint 7 as in the seed.
    std::vector<Angles> sorted(const PoseMsg &pose, const Angles &seed) const {
        std::vector<Angles> all;
        if (!robot_ || seed.size() != names_.size()) return all;
        try {
            const irbkin::Pose target = rows(pose);
            const irbkin::Joints from(seed.data(), seed.size());
            if (seed.size() == 7) {
                if (const auto q = robot_->ik_nearest(target, from)) all.emplace_back(q->begin(), q->end());
            }
            const auto q7 = seed.size() == 7 ? std::optional<double>(seed[6]) : std::nullopt;
            for (const auto &it : robot_->ik(target, q7)) {
                Angles q(it.q.begin(), it.q.end());
                if (turned(q, seed)) all.push_back(q);
            }
        } catch (const std::exception &error) {
            refused(error.what());
        }
        const auto distance = [&seed](const Angles &q) {
            double sum = 0.0;
            for (std::size_t i = 0; i < q.size(); i++) sum += std::abs(q[i] - seed[i]);
            return sum;
        };
        std::stable_sort(all.begin(), all.end(), [&](const Angles &a, const Angles &b) {
            return distance(a) < distance(b);
        });
        return all;
    }

    /// Add full turns that bring each joint inside its limits and near to the seed, if any do.
    bool turned(Angles &q, const Angles &seed) const {
        for (std::size_t i = 0; i < q.size(); i++) {
            const double least = std::ceil((limits_[i][0] - q[i]) / TURN - 1e-9);
            const double most = std::floor((limits_[i][1] - q[i]) / TURN + 1e-9);
            if (least > most) return false;
            q[i] += TURN * std::clamp(std::round((seed[i] - q[i]) / TURN), least, most);
        }
        return true;
    }

    std::unique_ptr<irbkin::Robot> robot_;
    std::vector<std::array<double, 2>> limits_;
    std::vector<std::string> names_, links_;
};

}  // namespace irbkin_moveit

PLUGINLIB_EXPORT_CLASS(irbkin_moveit::Plugin, kinematics::KinematicsBase)
