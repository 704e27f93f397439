// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A massless elastic piece of shaft between two discs.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/bearing/shaft_axes.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/shaft/shaft_section.hpp"

namespace clatter::dynamics {

/// Where a beam is: between stations i and j of two discs.
struct BeamEnds {
  double length = 0.0;              // from station i to station j [m]
  double arm_i = 0.0, arm_j = 0.0;  // from each disc's centre of mass to its station [m]
};

/// Timoshenko's beam without mass: bending in two planes, torsion, stretch.
///
/// The stiffness is that of an isotropic section, constant in axes that do not turn. With the
/// slopes s = t x w of the discs the deformation D is, in both planes,
///
///   D = (u_j + a_j s_j - u_i - (a_i + l) s_i,  s_j - s_i)
///
/// and rigid motions give none, to rounding. The damping is that of the material, which turns with
/// the shaft: forces are -K (D + T (D' - W w x D)), T the loss time and W the mean spin of the ends
/// (rotating damping, Genta 2005, chapter 4). What it takes from a bent shaft comes from the
/// rotation: a moment T (D' - W w x D)^T K (w x D) acts on the angles.
class ShaftBeam : public ForceElement {
 public:
  /// @param coordinates y indices of x, y, z, rx, ry, rz of disc i, then of disc j.
  /// @param loss_time T, damping over stiffness [s].
  ShaftBeam(std::string name, std::vector<int> coordinates, const ShaftAxes& axes,
            const BeamEnds& ends, const ShaftFlexibility& flexibility, double loss_time);
  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;

 private:
  using Vector12 = Eigen::Matrix<double, 12, 1>;
  /// Deformation of both planes, its rate as seen from the turning shaft; twist and stretch.
  struct Deformation {
    Eigen::Vector4d bent, across, rate;  // D, w x D, D' - W w x D
    double spin = 0.0;                   // W [rad/s]
    Eigen::Vector2d along, along_rate;   // twist and stretch
  };
  Deformation deform(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;

  std::string name_;
  int turn_;                            // index of the large angle of disc i
  Eigen::Matrix<double, 4, 12> B_;      // D by the coordinates: deflection, slope in both planes
  Eigen::Matrix4d K_, quarter_turn_;    // w x D = quarter_turn D
  Eigen::Matrix<double, 2, 12> along_;  // twist, stretch by the coordinates
  Eigen::Vector2d k_along_;             // [N m/rad], [N/m]
  double loss_time_;
};

}  // namespace clatter::dynamics
