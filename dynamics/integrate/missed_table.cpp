// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/missed_table.hpp"

#include "dynamics/integrate/rows_in_step.hpp"
#include "dynamics/integrate/table_pass.hpp"

namespace clatter::dynamics {

MissedTable::MissedTable(const System& system, const ErrorWeights& weights, const Tableau& tableau)
    : system_(system),
      weights_(weights),
      tableau_(tableau),
      no_displacement_(Eigen::VectorXd::Zero(system.modes())),
      impulse_(system.interface_size()),
      velocity_(system.modes()) {
  for (int e = 0; e < system.elements(); ++e) {
    const auto* table = dynamic_cast<const TableForce*>(&system.element(e));
    if (table != nullptr && table->has_table())
      tables_.push_back({table, &system.element(e).coordinates(), {}, {}});
  }
}

double MissedTable::error(const StageState& begin, const std::vector<StageState>& stages) {
  const StageState& end = stages[tableau_.stages - 1];
  bool any = false;
  for (TableElement& one : tables_) {
    const TableForce& table = *one.table;
    const TurningAngle first = angle(one, begin);
    const TablePass pass(table, {begin.time, first}, {end.time, angle(one, end)});
    const RowsInStep rows(pass, 0.0, pass.length());
    if (!rows.hide_something()) continue;
    double sum = tableau_.b[0] * table.by_table(begin.time, first);
    for (size_t i = 0; i < stages.size(); ++i)
      sum += tableau_.b[i + 1] * table.by_table(stages[i].time, angle(one, stages[i]));
    if (!any) impulse_.setZero();
    any = true;
    const double missed = rows.integral() - pass.length() * sum;
    impulse_((*one.coordinates)[0]) += missed;
    if (table.has_reaction()) impulse_((*one.coordinates)[1]) -= missed;
  }
  if (!any) return 0.0;
  velocity_.setZero();
  system_.add_interface_force(impulse_, velocity_);
  return modal_error(system_, weights_, no_displacement_, velocity_);
}

TurningAngle MissedTable::angle(TableElement& one, const StageState& state) {
  gather(state.y, *one.coordinates, one.y);
  gather(state.v_y, *one.coordinates, one.v);
  return one.table->table_angle(state.time, one.y, one.v);
}

}  // namespace clatter::dynamics
