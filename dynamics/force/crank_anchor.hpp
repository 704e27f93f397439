// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The crank pin of a crankshaft that does not turn exactly as the engine's clock.
#include "dynamics/force/anchor.hpp"

namespace clatter::dynamics {

/// The crank pin as a deviation from its ideal position p(t),
///
///   d = d_c + (R(a) - 1) p,   d' = d_c' + a' R(a) J p + (R(a) - 1) p',   J = R(90 deg)
///
/// with the displacement d_c of the crank's axis in the cylinder's plane and the rotation a about
/// +x from that of the clock, of any size. (R - 1) p' is prescribed motion.
class CrankPinAnchor : public Anchor {
 public:
  /// @param centre the axis, by its coordinates. @param turn y index of a.
  CrankPinAnchor(PointWeights centre, int turn, const SliderCrank& crank);
  void find(double time, const Values& y, const Values& v, AnchorState& state) const override;
  void add_curvature(double time, const Values& y, const Eigen::Vector2d& force,
                     Eigen::Ref<Eigen::MatrixXd> tangent) const override;

 private:
  PlanarRows G_;  // of the centre
  SliderCrank crank_;
};

}  // namespace clatter::dynamics
