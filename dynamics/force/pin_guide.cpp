// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/pin_guide.hpp"

#include <utility>

namespace clatter::dynamics {
namespace {

constexpr int kTilt = 4;  // ry of the block among the element's coordinates
constexpr int kYaw = 5;   // rz of the block

}  // namespace

PinGuide::PinGuide(std::string name, const GuideLaw& law, const SliderCrank& crank,
                   const std::array<int, 3>& pin, const std::optional<std::array<int, 3>>& block)
    : ForceElement({pin.begin(), pin.end()}),
      name_(std::move(name)),
      crank_(crank),
      stiffness_(law.axial_stiffness, law.tilt_stiffness, law.tilt_stiffness),
      damping_(law.axial_damping, law.tilt_damping, law.tilt_damping),
      G_(Rows::Identity(3, 3)),
      on_block_(block.has_value()) {
  if (!block) return;
  coordinates_.insert(coordinates_.end(), block->begin(), block->end());
  G_.conservativeResize(Eigen::NoChange, 6);
  G_.rightCols<3>() = -Eigen::Matrix3d::Identity();
  G_(0, kYaw) = crank.pin_offset();
}

PinGuide::Motion3 PinGuide::motion(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  const Eigen::Vector3d prescribed(on_block_ ? -stroke_rate_ * y(kTilt) : 0.0, 0.0, 0.0);
  return {G_ * y, G_ * v + prescribed, prescribed};
}

void PinGuide::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                        bool with_tangent, Response& response) {
  const Motion<double> stroke = crank_.piston_pin(stage.time);
  stroke_rate_ = stroke.velocity;
  if (on_block_) G_(0, kTilt) = -stroke.position;
  const Motion3 at = motion(y, v);
  const Eigen::Vector3d force = -stiffness_.cwiseProduct(at.d) - damping_.cwiseProduct(at.rate);
  response.force.noalias() = G_.transpose() * force;
  if (!with_tangent) return;
  const Rows scaled = (-stiffness_ - damping_ / stage.kappa).asDiagonal() * G_;
  response.tangent.noalias() = G_.transpose().lazyProduct(scaled);
  if (on_block_) {
    response.tangent.col(kTilt) += G_.row(0).transpose() * (damping_.x() * stroke_rate_);
  }
}

Power PinGuide::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  const Motion3 at = motion(y, v);
  const Eigen::Vector3d resistance = stiffness_.cwiseProduct(at.d) + damping_.cwiseProduct(at.rate);
  return {0.5 * at.d.dot(stiffness_.cwiseProduct(at.d)),
          at.rate.dot(damping_.cwiseProduct(at.rate)), resistance.dot(at.prescribed)};
}

}  // namespace clatter::dynamics
