// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/mounted_motion.hpp"

#include <map>

#include "core/dense/exponential.hpp"
#include "core/dense/solve.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "dynamics/element/massless_rod.hpp"
#include "dynamics/element/mount.hpp"

namespace clatter::dynamics {
namespace {

/// Motions whose frequency is below this part of the highest one are not held.
constexpr double kFree = 1e-3;

/// Modal coordinates of the unit motions of the whole, about the origin; empty where a body is
/// neither free as a rigid body nor in a frame that a component knows, and where a rod without
/// mass, which is no body, would stay behind.
std::optional<Eigen::MatrixXd> motions_of_all(const Model& model, double time) {
  const System& system = model.system;
  for (int e = 0; e < system.elements(); ++e)
    if (dynamic_cast<const MasslessRod*>(&system.element(e)) != nullptr) return std::nullopt;
  std::map<int, Eigen::Vector3d> frames;
  for (const MovingFrames* moving : components_of<MovingFrames>(model))
    frames.merge(moving->frames(time));
  Eigen::MatrixXd motions(system.modes(), 6);
  for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
    const ModalBody& body = system.bodies()[b];
    const auto frame = frames.find(b);
    if (frame == frames.end() && (body.rigid_modes != 6 || body.frame)) return std::nullopt;
    Eigen::Matrix<double, 6, 6> motion = Eigen::Matrix<double, 6, 6>::Identity();
    if (frame != frames.end())
      for (int k = 0; k < 3; ++k)
        motion.topRightCorner<3, 3>().col(k) = Eigen::Vector3d::Unit(k).cross(frame->second);
    motions.middleRows(system.mode_offset(b), body.modes()) = body.rigid * motion;
  }
  return motions;
}

}  // namespace

MountedMotion::MountedMotion(const System& system, const Eigen::MatrixXd& motions)
    : system_(system) {
  const Eigen::MatrixXd mass = motions.transpose() * system.inertia().asDiagonal() * motions;
  Eigen::MatrixXd y(system.interface_size(), 6);
  for (int k = 0; k < 6; ++k) y.col(k) = system.interface(Eigen::VectorXd(motions.col(k)));
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(6, 6), damping = stiffness;
  for (int e = 0; e < system.elements(); ++e) {
    const auto* mount = dynamic_cast<const Mount*>(&system.element(e));
    if (mount == nullptr) continue;
    const Eigen::MatrixXd at = y(mount->coordinates(), Eigen::all);
    stiffness += at.transpose() * mount->stiffness().asDiagonal() * at;
    damping += at.transpose() * mount->damping().asDiagonal() * at;
  }
  const dense::Eigenpairs solved = dense::symmetric_eigen(stiffness, mass);
  const Eigen::VectorXd& squares = solved.values;
  const auto held = (squares.array() > kFree * kFree * squares(5)).count();
  const Eigen::MatrixXd shapes = solved.vectors.rightCols(squares(5) > 0.0 ? held : 0);
  modes_ = motions * shapes;
  stiffness_ = shapes.transpose() * stiffness * shapes;
  damping_ = shapes.transpose() * damping * shapes;
  origin_ = shapes.topRows(3);
}

std::optional<MountedMotion> MountedMotion::of(const Model& model, double time) {
  const auto motions = motions_of_all(model, time);
  if (!motions) return std::nullopt;
  MountedMotion motion(model.system, *motions);
  if (motion.modes_.cols() == 0) return std::nullopt;
  return motion;
}

double MountedMotion::predict(const StageState& begin, double cycle, StageState& end) const {
  const Eigen::Index h = modes_.cols();
  const auto slow = [&](const StageState& state) {
    Eigen::VectorXd z(2 * h);
    z << modes_.transpose() * system_.inertia().cwiseProduct(state.eta),
        modes_.transpose() * system_.inertia().cwiseProduct(state.v);
    return z;
  };
  Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(2 * h, 2 * h);
  rate.topRightCorner(h, h).setIdentity();
  rate.bottomLeftCorner(h, h) = -stiffness_;
  rate.bottomRightCorner(h, h) = -damping_;
  const Eigen::MatrixXd map = dense::exponential(cycle * rate);
  const Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(2 * h, 2 * h) - map;
  const Eigen::VectorXd step = map * dense::solve(whole, slow(end) - slow(begin));
  end.eta += modes_ * step.head(h);
  end.v += modes_ * step.tail(h);
  return (origin_ * step.head(h)).norm();
}

}  // namespace clatter::dynamics
