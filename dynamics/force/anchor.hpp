// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The point of a body at which a joint acts, in the plane of the crank, as a deviation from the
// ideal motion.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

/// Data of a point for a joint: displacement d [m] from its ideal position, rate d' [m/s],
/// and derivatives by the n_a coordinates of the anchor.
struct AnchorState {
  Eigen::Vector2d d, rate;
  Eigen::Vector2d prescribed;  // part of the rate that is not G v: prescribed motion [m/s]
  Eigen::Matrix<double, 2, Eigen::Dynamic> G;  // dd/dy = dd'/dv
  Eigen::Matrix<double, 2, Eigen::Dynamic> B;  // dd'/dy
};

class Anchor {
 public:
  virtual ~Anchor() = default;
  const std::vector<int>& coordinates() const { return coordinates_; }
  virtual AnchorState state(double time, const Eigen::VectorXd& y,
                            const Eigen::VectorXd& v) const = 0;
  /// d(G^T F)/dy for a force F on the point, n_a x n_a; empty when G is constant.
  virtual Eigen::MatrixXd curvature(double time, const Eigen::VectorXd& y,
                                    const Eigen::Vector2d& force) const = 0;

 protected:
  explicit Anchor(std::vector<int> coordinates) : coordinates_(std::move(coordinates)) {}
  std::vector<int> coordinates_;
};

/// Weights of coordinates in the displacement (lateral, stroke) of a point.
struct PointWeights {
  std::vector<int> coordinates;  // y indices, n_a
  Eigen::Matrix<double, 2, Eigen::Dynamic> G = Eigen::Matrix<double, 2, Eigen::Dynamic>(2, 0);

  void add(int coordinate, double lateral, double stroke);
};

/// A point whose (y, z) displacement is d = G y: a node, a mean of nodes; without coordinates it is
/// fixed in the engine.
class LinearAnchor : public Anchor {
 public:
  explicit LinearAnchor(PointWeights point);
  AnchorState state(double, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  Eigen::MatrixXd curvature(double, const Eigen::VectorXd&, const Eigen::Vector2d&) const override {
    return {};
  }

 private:
  Eigen::Matrix<double, 2, Eigen::Dynamic> G_;
};

/// An end of the rod at `arm` from its centre of mass: d = (dy, dz) + arm (u(phi + dphi) - u(phi)),
/// phi the ideal angle, u the rod's direction. The rotation of the ideal rod is prescribed motion.
class RodAnchor : public Anchor {
 public:
  /// `coordinates`: y indices of the rod's (dy, dz, dphi).
  RodAnchor(std::vector<int> coordinates, const SliderCrank& crank, double arm);
  AnchorState state(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  Eigen::MatrixXd curvature(double time, const Eigen::VectorXd& y,
                            const Eigen::Vector2d& force) const override;

 private:
  SliderCrank crank_;
  double arm_;
};

}  // namespace clatter::dynamics
