// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// An open chain of equal links in a plane.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dynamics/body/port.hpp"
#include "dynamics/chain/link_joints.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics::testing {

struct OpenChain {
  System system;
  ChainMake make;
  JointLaw law;
  std::vector<int> y;  // u, v, angle of all links
  int joints = 0;      // the element

  /// Links of 2.4 g and 4.4e-8 kg m2 between pins, one more than links. @param stiffness of the
  /// joints [N/m].
  OpenChain(const std::vector<Eigen::Vector2d>& pins, double pitch, double stiffness);

  int links() const { return make.links(); }
  std::unique_ptr<Port> rear_end() const { return end(0, -1.0); }
  std::unique_ptr<Port> front_end() const { return end(links() - 1, 1.0); }
  /// Holds an end or another port at `b` by a joint of the same stiffness; the element.
  int pin(const std::string& name, std::unique_ptr<Port> a, std::unique_ptr<Port> b);
  /// Pulls the last link or a body at its centre of mass with a constant force [N].
  void pull(int body, const Eigen::Vector2d& force);
  /// The state of rest, found to `residual` [N], which cannot be less than the rounding of
  /// positions times stiffness. Also evaluates the elements there.
  Eigen::VectorXd rest(double residual);
  /// Force of a joint between links at the state evaluated last [N].
  double tension(int joint) const;

 private:
  std::unique_ptr<Port> end(int link, double side) const;
};

}  // namespace clatter::dynamics::testing
