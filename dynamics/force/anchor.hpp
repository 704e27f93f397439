// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The point of a body at which a joint acts, in the plane of the crank, as a deviation from the
// ideal motion.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

/// Two rows, by coordinates of an anchor.
using PlanarRows = Eigen::Matrix<double, 2, Eigen::Dynamic>;

/// Data of a point for a joint: displacement d [m] from its ideal position, rate d' [m/s],
/// and derivatives by the n_a coordinates of the anchor.
struct AnchorState {
  Eigen::Vector2d d, rate;
  Eigen::Vector2d prescribed;  // part of the rate that is not G v: prescribed motion [m/s]
  PlanarRows G;                // dd/dy = dd'/dv
  PlanarRows B;                // dd'/dy
};

class Anchor {
 public:
  virtual ~Anchor() = default;
  const std::vector<int>& coordinates() const { return coordinates_; }
  using Values = Eigen::Ref<const Eigen::VectorXd>;  // n_a, of its coordinates
  /// Writes the data at (y, v); takes no memory when `state` was written before.
  virtual void find(double time, const Values& y, const Values& v, AnchorState& state) const = 0;
  /// tangent += d(G^T F)/dy for a force F on the point, n_a x n_a; nothing when G is constant.
  virtual void add_curvature(double /*time*/, const Values& /*y*/, const Eigen::Vector2d& /*force*/,
                             Eigen::Ref<Eigen::MatrixXd> /*tangent*/) const {}

 protected:
  explicit Anchor(std::vector<int> coordinates) : coordinates_(std::move(coordinates)) {}
  std::vector<int> coordinates_;
};

/// Weights of coordinates in the displacement (lateral, stroke) of a point.
struct PointWeights {
  std::vector<int> coordinates;  // y indices, n_a
  PlanarRows G = PlanarRows(2, 0);

  void add(int coordinate, double lateral, double stroke);
};

/// A point whose (y, z) displacement is d = G y: a node, a mean of nodes; without coordinates it is
/// fixed in the engine.
class LinearAnchor : public Anchor {
 public:
  explicit LinearAnchor(PointWeights point);
  void find(double, const Values& y, const Values& v, AnchorState& state) const override;

 private:
  PlanarRows G_;
};

/// An end of the rod at `arm` from its centre of mass: d = (dy, dz) + arm (u(phi + dphi) - u(phi)),
/// phi the ideal angle, u the rod's direction. The rotation of the ideal rod is prescribed motion.
class RodAnchor : public Anchor {
 public:
  /// `coordinates`: y indices of the rod's (dy, dz, dphi).
  RodAnchor(std::vector<int> coordinates, const SliderCrank& crank, double arm);
  void find(double time, const Values& y, const Values& v, AnchorState& state) const override;
  void add_curvature(double time, const Values& y, const Eigen::Vector2d& force,
                     Eigen::Ref<Eigen::MatrixXd> tangent) const override;

 private:
  SliderCrank crank_;
  double arm_;
};

}  // namespace clatter::dynamics
