// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/pin_guide.hpp"

#include <cmath>
#include <utility>

namespace clatter::dynamics {
namespace {

constexpr int kTilt = 4;  // ry of the block among the element's coordinates
constexpr int kYaw = 5;   // rz of the block

Eigen::Vector2d quarter_turn(const Eigen::Vector2d& of) { return {-of.y(), of.x()}; }

}  // namespace

GuidePath path_of_pin(const SliderCrank& crank) {
  return {[crank](double time) {
            const Motion<double> z = crank.piston_pin(time);
            return Motion<Eigen::Vector2d>{
                {crank.pin_offset(), z.position}, {0.0, z.velocity}, {0.0, z.acceleration}};
          },
          nullptr};
}

PinGuide::PinGuide(std::string name, const GuideLaw& law, GuidePath path,
                   const std::array<int, 3>& guided, const std::optional<std::array<int, 3>>& block,
                   CrankAngle crank)
    : ForceElement({guided.begin(), guided.end()}),
      name_(std::move(name)),
      path_(std::move(path)),
      crank_(std::move(crank)),
      stiffness_(law.axial_stiffness, law.tilt_stiffness, law.tilt_stiffness),
      damping_(law.axial_damping, law.tilt_damping, law.tilt_damping),
      G_(Rows::Identity(3, 3)),
      on_block_(block.has_value()) {
  if (block) {
    coordinates_.insert(coordinates_.end(), block->begin(), block->end());
    G_.conservativeResize(Eigen::NoChange, 6);
    G_.rightCols<3>() = -Eigen::Matrix3d::Identity();
  }
  if (!crank_.is_free()) return;
  crank_.join(coordinates_);
  G_.conservativeResize(Eigen::NoChange, G_.cols() + 1);
  G_.rightCols<1>().setZero();
}

PinGuide::Motion3 PinGuide::motion(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  Eigen::Vector3d prescribed = Eigen::Vector3d::Zero();
  if (on_block_) prescribed.x() = rate_.x() * y(kYaw) - rate_.y() * y(kTilt);
  if (path_.turn) {
    const Eigen::Vector2d tilt = G_.block<2, 2>(1, 1) * y.segment<2>(1);
    prescribed.tail<2>() = spin_ * quarter_turn(tilt);
  }
  return {G_ * y, G_ * v + prescribed, prescribed};
}

void PinGuide::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                        bool with_tangent, Response& response) {
  const CrankLead lead = crank_.lead(stage, y, v);
  const double time = stage.time + lead.now.position;
  const Motion<Eigen::Vector2d> path = path_.point(time), point = led(path, lead.now);
  Motion<double> turning{0.0, 0.0, 0.0};
  rate_ = point.velocity;
  if (on_block_) {
    G_(0, kTilt) = -point.position.y();
    G_(0, kYaw) = point.position.x();
  }
  if (path_.turn) {
    turning = path_.turn(time);
    const Motion<double> turn = led(turning, lead.now);
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
  if (crank_.is_free())
    add_crank_column(led_by_turn(path, lead), led_by_turn(turning, lead), force, y, v,
                     response.tangent);
}

void PinGuide::add_crank_column(const Motion<Eigen::Vector2d>& point, const Motion<double>& turn,
                                const Eigen::Vector3d& force, const Eigen::VectorXd& y,
                                const Eigen::VectorXd& v, Eigen::MatrixXd& tangent) const {
  Rows G = Rows::Zero(3, G_.cols());
  Eigen::Vector3d prescribed = Eigen::Vector3d::Zero();
  if (on_block_) {
    G(0, kTilt) = -point.position.y();
    G(0, kYaw) = point.position.x();
    prescribed.x() = point.velocity.x() * y(kYaw) - point.velocity.y() * y(kTilt);
  }
  if (path_.turn) {
    const Eigen::Vector2d tilt = G_.block<2, 2>(1, 1) * y.segment<2>(1);
    for (int k = 1; k < 3; ++k)
      G.block<2, 1>(1, k) = turn.position * quarter_turn(G_.block<2, 1>(1, k));
    const Eigen::Vector2d by_angle = G.block<2, 2>(1, 1) * y.segment<2>(1);
    prescribed.tail<2>() = turn.velocity * quarter_turn(tilt) + spin_ * quarter_turn(by_angle);
  }
  const Eigen::Vector3d rate = G * v + prescribed, distance = G * y;
  const Eigen::Vector3d change = -stiffness_.cwiseProduct(distance) - damping_.cwiseProduct(rate);
  tangent.col(G_.cols() - 1) += G.transpose() * force + G_.transpose() * change;
}

Power PinGuide::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  const Motion3 at = motion(y, v);
  const Eigen::Vector3d resistance = stiffness_.cwiseProduct(at.d) + damping_.cwiseProduct(at.rate);
  return {0.5 * at.d.dot(stiffness_.cwiseProduct(at.d)),
          at.rate.dot(damping_.cwiseProduct(at.rate)), resistance.dot(at.prescribed)};
}

}  // namespace clatter::dynamics
