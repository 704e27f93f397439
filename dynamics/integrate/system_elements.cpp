// SPDX-License-Identifier: GPL-3.0-or-later
// The elements of a system: their forces and tangents, and what they are told of a step.
#include "core/base/stopwatch.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

using Eigen::VectorXd;

void System::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v, bool with_tangent,
                      VectorXd& f) {
  f.setZero(interface_size());
  const Stopwatch clock;
  double before = 0.0;  // one reading of the clock an element
  for (size_t e = 0; e < elements_.size(); ++e) {
    const auto& at = elements_[e]->coordinates();
    gather(y, at, y_of_[e]);
    gather(v, at, v_of_[e]);
    elements_[e]->evaluate(stage, y_of_[e], v_of_[e], with_tangent, responses_[e]);
    if (with_tangent) tangent_rows_[e] = responses_[e].touched;
    for (size_t i = 0; i < at.size(); ++i)
      f(at[i]) += responses_[e].force(static_cast<Eigen::Index>(i));
    const double now = clock.seconds();
    costs_[e].seconds += now - before;
    before = now;
    ++costs_[e].evaluations;
  }
}

int System::tangent_row(int element, Eigen::Index row) const {
  const auto e = static_cast<size_t>(element), i = static_cast<size_t>(row);
  const auto& at = elements_[e]->coordinates();
  const auto& touched = tangent_rows_[e];
  return at[touched.empty() ? i : static_cast<size_t>(touched[i])];
}

/// Those of an element with groups, in all its coordinates.
void System::add_block_forces(size_t element, const VectorXd& dy) const {
  const std::vector<std::vector<int>>& groups = elements_[element]->groups();
  const std::vector<TangentBlock>& blocks = responses_[element].blocks;
  VectorXd &moved = moved_[element], &change = change_[element];
  gather(dy, elements_[element]->coordinates(), moved);
  change.setZero(moved.size());
  for (size_t g = 0; g < groups.size(); ++g) {
    if (!blocks[g].active) continue;
    const std::vector<int>& at = groups[g];
    const double* value = blocks[g].values.data();  // column by column
    for (const int j : at) {
      const double by = moved(j);
      for (const int i : at) change(i) += *value++ * by;
    }
  }
}

const VectorXd& System::tangent_forces(int element, const VectorXd& dy) const {
  const auto e = static_cast<size_t>(element);
  if (has_groups(element)) {
    add_block_forces(e, dy);
    return change_[e];
  }
  const Eigen::Index count = responses_[e].tangent.rows();
  moved_[e].resize(count);
  for (Eigen::Index i = 0; i < count; ++i) moved_[e](i) = dy(tangent_row(element, i));
  change_[e].noalias() = responses_[e].tangent * moved_[e];
  return change_[e];
}

void System::add_tangent_forces(const VectorXd& dy, VectorXd& f) const {
  for (int e = 0; e < elements(); ++e) {
    const VectorXd& forces = tangent_forces(e, dy);
    for (Eigen::Index i = 0; i < forces.size(); ++i) f(tangent_row(e, i)) += forces(i);
  }
}

void System::keep_forces() { passed_.resize(elements()); }

void System::pass_on(const VectorXd& dy, VectorXd& f) {
  add_tangent_forces(dy, f);
  for (size_t e = 0; e < passed_.size(); ++e) {
    passed_[e] = responses_[e].force;
    const std::vector<int>& rows = tangent_rows_[e];
    for (Eigen::Index i = 0; i < change_[e].size(); ++i)
      passed_[e](rows.empty() ? i : rows[i]) += change_[e](i);
  }
}

void System::begin_step(double time) {
  for (auto& element : elements_) element->begin_step(time);
}

void System::finish_stage(const Stage& stage) {
  for (auto& element : elements_) element->finish_stage(stage);
}

void System::accept_step(double time) {
  for (auto& element : elements_) element->accept_step(time);
}

}  // namespace clatter::dynamics
