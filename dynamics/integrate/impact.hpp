// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Impacts of all rigid contacts of a system that touch at an instant.
#include <Eigen/Core>
#include <vector>

#include "dynamics/element/rigid_contact.hpp"
#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

class Impact {
 public:
  /// @param element found the impact: it takes part in any case. NumericsError when no body can
  /// take its impulse.
  Impact(System& system, const StageState& state, int element);

  /// Numbers of the elements that close.
  const std::vector<int>& closing() const { return closing_; }
  /// This contact is at rest from now on, as its element knows.
  void hold(int element);
  /// Impulses on the interface coordinates, n_y [N s], [N m s]; tells them to the contacts.
  Eigen::VectorXd solve() const;

 private:
  struct Member {
    int element;
    RigidContact* contact;
    Touch at;
  };

  const System& system_;
  std::vector<Member> members_;
  std::vector<int> closing_;
  Eigen::VectorXd velocity_;  // 3 n
  Eigen::MatrixXd mobility_;  // 3 n x 3 n
};

}  // namespace clatter::dynamics
