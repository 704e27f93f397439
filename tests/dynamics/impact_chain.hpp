// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A closed chain of masses on a line that push each other through stiff unilateral contacts.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/element/element.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics::testing {

/// A contact between two masses on a line: with the overlap x = y_a - y_b - gap > 0 the force
/// k x (1 + c x') pushes them apart (linear; damped as by Hunt and Crossley 1975).
class LinkContact : public ForceElement {
 public:
  /// @param stiffness k [N/m]. @param damping c [s/m], below 1 over the speeds of the approach.
  LinkContact(int a, int b, double gap, double stiffness, double damping)
      : ForceElement({a, b}), gap_(gap), k_(stiffness), c_(damping) {}
  std::string name() const override { return "link contact"; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;

 private:
  double gap_, k_, c_;
};

/// Properties of an ImpactChain.
struct ImpactChainOptions {
  int links = 100;
  double mass = 0.01;        // [kg]
  double stiffness = 1e9;    // [N/m]
  double damping = 0.0;      // [s/m]
  double gap = 1e-4;         // between neighbours at the start [m]
  double speed = 1.0;        // [m/s]
  bool alternating = false;  // speeds +speed, -speed, ..; else uniform in +-speed, mean zero
};

/// Masses on a circle of which only the displacements along it count: the last one pushes the
/// first. No force is external, so the momentum is constant, and without damping the energy.
struct ImpactChain {
  System system;
  std::vector<int> links;  // y of each
  explicit ImpactChain(const ImpactChainOptions& options);
};

}  // namespace clatter::dynamics::testing
