// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Pulses of tables over an angle between the stages of a step.
#include <Eigen/Core>
#include <vector>

#include "dynamics/element/table_force.hpp"
#include "dynamics/integrate/accuracy.hpp"
#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/integrate/system.hpp"
#include "dynamics/integrate/tableau.hpp"

namespace clatter::dynamics {

/// As MissedImpulse, of the elements whose force is a table over an angle that the motion decides
/// (hard case S16): the rows that the step passes are those between the angles at its ends.
class MissedTable {
 public:
  /// Keeps references.
  MissedTable(const System& system, const ErrorWeights& weights, const Tableau& tableau);

  /// The difference between the impulse of the tables and that of the stages, of a step from
  /// `begin`, as the error of a velocity over its limit. Takes no memory.
  double error(const StageState& begin, const std::vector<StageState>& stages);

 private:
  /// An element with a table, and its coordinates at one instant.
  struct TableElement {
    const TableForce* table;
    const std::vector<int>* coordinates;
    Eigen::VectorXd y, v;  // n_e
  };
  static TurningAngle angle(TableElement& one, const StageState& state);

  const System& system_;
  const ErrorWeights& weights_;
  const Tableau& tableau_;
  std::vector<TableElement> tables_;
  const Eigen::VectorXd no_displacement_;  // N
  Eigen::VectorXd impulse_;                // n_y
  Eigen::VectorXd velocity_;               // N
};

}  // namespace clatter::dynamics
