// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/pin_guide.hpp"

#include <cmath>
#include <utility>

namespace clatter::dynamics {
namespace {

constexpr int kTilt = 4;  // ry of the block among the element's coordinates
constexpr int kYaw = 5;   // rz of the block

}  // namespace

GuidePath path_of_pin(double offset, std::function<Motion<double>(double)> stroke) {
  return {[offset, stroke = std::move(stroke)](double time) {
            const Motion<double> z = stroke(time);
            return Motion<Eigen::Vector2d>{
                {offset, z.position}, {0.0, z.velocity}, {0.0, z.acceleration}};
          },
          nullptr};
}

PinGuide::PinGuide(std::string name, const GuideLaw& law, GuidePath path,
                   const std::array<int, 3>& guided, const std::optional<std::array<int, 3>>& block)
    : ForceElement({guided.begin(), guided.end()}),
      name_(std::move(name)),
      path_(std::move(path)),
      stiffness_(law.axial_stiffness, law.tilt_stiffness, law.tilt_stiffness),
      damping_(law.axial_damping, law.tilt_damping, law.tilt_damping),
      G_(Rows::Identity(3, 3)),
      on_block_(block.has_value()) {
  if (!block) return;
  coordinates_.insert(coordinates_.end(), block->begin(), block->end());
  G_.conservativeResize(Eigen::NoChange, 6);
  G_.rightCols<3>() = -Eigen::Matrix3d::Identity();
}

PinGuide::PinGuide(std::string name, const GuideLaw& law, const SliderCrank& crank,
                   const std::array<int, 3>& pin, const std::optional<std::array<int, 3>>& block)
    : PinGuide(
          std::move(name), law,
          path_of_pin(crank.pin_offset(), [crank](double time) { return crank.piston_pin(time); }),
          pin, block) {}

PinGuide::Motion3 PinGuide::motion(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  Eigen::Vector3d prescribed = Eigen::Vector3d::Zero();
  if (on_block_) prescribed.x() = rate_.x() * y(kYaw) - rate_.y() * y(kTilt);
  if (path_.turn) {
    const Eigen::Vector2d tilt = G_.block<2, 2>(1, 1) * y.segment<2>(1);
    prescribed.tail<2>() = spin_ * Eigen::Vector2d(-tilt.y(), tilt.x());
  }
  return {G_ * y, G_ * v + prescribed, prescribed};
}

void PinGuide::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                        bool with_tangent, Response& response) {
  const Motion<Eigen::Vector2d> point = path_.point(stage.time);
  rate_ = point.velocity;
  if (on_block_) {
    G_(0, kTilt) = -point.position.y();
    G_(0, kYaw) = point.position.x();
  }
  if (path_.turn) {
    const Motion<double> turn = path_.turn(stage.time);
    const double c = std::cos(turn.position), s = std::sin(turn.position);
    G_.block<2, 2>(1, 1) = Eigen::Matrix2d{{c, -s}, {s, c}};
    spin_ = turn.velocity;
  }
  const Motion3 at = motion(y, v);
  const Eigen::Vector3d force = -stiffness_.cwiseProduct(at.d) - damping_.cwiseProduct(at.rate);
  response.force.noalias() = G_.transpose() * force;
  if (!with_tangent) return;
  const Rows scaled = (-stiffness_ - damping_ / stage.kappa).asDiagonal() * G_;
  response.tangent.noalias() = G_.transpose().lazyProduct(scaled);
  if (on_block_) {
    response.tangent.col(kTilt) += G_.row(0).transpose() * (damping_.x() * rate_.y());
    response.tangent.col(kYaw) -= G_.row(0).transpose() * (damping_.x() * rate_.x());
  }
  if (path_.turn) {
    const Eigen::Matrix2d R = G_.block<2, 2>(1, 1),
                          turned{{-R(1, 0), -R(1, 1)}, {R(0, 0), R(0, 1)}};
    for (int k = 0; k < 2; ++k)
      response.tangent.col(1 + k) -=
          G_.middleRows<2>(1).transpose() * (damping_.y() * spin_ * turned.col(k));
  }
}

Power PinGuide::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  const Motion3 at = motion(y, v);
  const Eigen::Vector3d resistance = stiffness_.cwiseProduct(at.d) + damping_.cwiseProduct(at.rate);
  return {0.5 * at.d.dot(stiffness_.cwiseProduct(at.d)),
          at.rate.dot(damping_.cwiseProduct(at.rate)), resistance.dot(at.prescribed)};
}

}  // namespace clatter::dynamics
