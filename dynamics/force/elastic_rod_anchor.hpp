// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The end of an elastic rod at which a joint acts.
#include "dynamics/force/anchor.hpp"

namespace clatter::dynamics {

/// A node of an elastic rod at `arm` from its centre of mass and displaced by u, both in the rod's
/// own axes: d = (dy, dz) + R(phi + dphi) (arm + u) - R(phi) arm, phi the ideal angle.
class ElasticRodAnchor : public Anchor {
 public:
  /// @param coordinates y indices of the rod's (dy, dz, dphi) and of the node's displacements along
  /// y and z. @param arm (y, z) [m].
  ElasticRodAnchor(std::vector<int> coordinates, const SliderCrank& crank,
                   const Eigen::Vector2d& arm);
  void find(double time, const Values& y, const Values& v, AnchorState& state) const override;
  void add_curvature(double time, const Values& y, const Eigen::Vector2d& force,
                     Eigen::Ref<Eigen::MatrixXd> tangent) const override;

 private:
  SliderCrank crank_;
  Eigen::Vector2d arm_;
};

}  // namespace clatter::dynamics
