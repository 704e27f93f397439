// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The piston along its pin and about y and z, where a planar rod leaves it free.
#include <array>
#include <functional>
#include <optional>

#include "dynamics/element/crank_angle.hpp"
#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

/// Stiffnesses and dampings of the guide.
struct GuideLaw {
  double axial_stiffness = 1e6, axial_damping = 1e2;  // along the pin [N/m], [N s/m]
  double tilt_stiffness = 1e4, tilt_damping = 1.0;    // about y and z [N m/rad], [N m s/rad]
};

/// The motion of a guided body in the plane of the crank, over the time of the crank's clock.
struct GuidePath {
  std::function<Motion<Eigen::Vector2d>(double)> point;  // (y, z) where it is guided [m]
  std::function<Motion<double>(double)> turn;  // of its own axes about x [rad]; empty: none
};

/// The path of a piston's pin by the clock.
GuidePath path_of_pin(const SliderCrank& crank);

/// Linear springs and dampers between the pin and the engine block, at the height of the pin:
///
///   d = (x - x_b - z_B ry_b + y_pin rz_b,  ry - ry_b,  rz - rz_b),   f = G^T (-k d - c d')
///
/// x_b, ry_b, rz_b are of the block's rigid frame about the engine's origin. The pin slides along a
/// tilted block, so d' contains -z_B' ry_b; the power of the stroke on it is the input. An elastic
/// rod is guided in the same way at its centre of mass, which also moves along y; its rotations ry
/// and rz are in its own axes, which turn. With a free crank the heights are those of its angle.
class PinGuide : public ForceElement {
 public:
  /// `guided`: y indices of the body's x, ry, rz. `block`: of those of the block's frame; absent:
  /// the guide is at rest.
  PinGuide(std::string name, const GuideLaw& law, GuidePath path, const std::array<int, 3>& guided,
           const std::optional<std::array<int, 3>>& block, CrankAngle crank = {});
  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;

 private:
  /// d, d' and the part of d' that is not G v at the last evaluated height.
  struct Motion3 {
    Eigen::Vector3d d, rate, prescribed;  // [m], [rad] and per second
  };
  Motion3 motion(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;
  /// Adds the derivative by a free crank's angle to its column of the tangent: `point` and `turn`
  /// are those of the path; `force` on d.
  void add_crank_column(const Motion<Eigen::Vector2d>& point, const Motion<double>& turn,
                        const Eigen::Vector3d& force, const Eigen::VectorXd& y,
                        const Eigen::VectorXd& v, Eigen::MatrixXd& tangent) const;

  std::string name_;
  GuidePath path_;
  CrankAngle crank_;
  Eigen::Vector3d stiffness_, damping_;
  /// Three rows, by the body's coordinates, with a block by its own, and 0 by a free crank's.
  using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 7>;
  Rows G_;                                          // dd/dy at the last evaluated position
  Eigen::Vector2d rate_ = Eigen::Vector2d::Zero();  // of the guided point there [m/s]
  double spin_ = 0.0;                               // of the body's axes there [rad/s]
  bool on_block_;
};

}  // namespace clatter::dynamics
