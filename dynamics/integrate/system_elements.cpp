// SPDX-License-Identifier: GPL-3.0-or-later
// The elements of a system: their forces and tangents, and what they are told of a step.
#include "core/base/stopwatch.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

using Eigen::VectorXd;

std::vector<ElementCost> System::costs() const {
  std::vector<ElementCost> all;
  for (const ElementPart& part : elements_) all.push_back(part.cost);
  return all;
}

void System::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v, bool with_tangent,
                      VectorXd& f) {
  f.setZero(interface_size());
  const Stopwatch clock;
  double before = 0.0;  // one reading of the clock an element
  for (ElementPart& part : elements_) {
    const auto& at = part.element->coordinates();
    gather(y, at, part.y);
    gather(v, at, part.v);
    part.element->evaluate(stage, part.y, part.v, with_tangent, part.response);
    if (with_tangent) part.tangent_rows = part.response.touched;
    for (size_t i = 0; i < at.size(); ++i)
      f(at[i]) += part.response.force(static_cast<Eigen::Index>(i));
    const double now = clock.seconds();
    part.cost.seconds += now - before;
    before = now;
    ++part.cost.evaluations;
  }
}

int System::tangent_row(int element, Eigen::Index row) const {
  const ElementPart& part = elements_[element];
  const auto& touched = part.tangent_rows;
  return part.element->coordinates()[touched.empty() ? row : touched[row]];
}

/// Those of an element with groups, in all its coordinates.
void System::add_block_forces(const ElementPart& part, const VectorXd& dy) const {
  const std::vector<std::vector<int>>& groups = part.element->groups();
  const std::vector<TangentBlock>& blocks = part.response.blocks;
  gather(dy, part.element->coordinates(), part.moved);
  part.change.setZero(part.moved.size());
  for (size_t g = 0; g < groups.size(); ++g) {
    if (!blocks[g].active) continue;
    const std::vector<int>& at = groups[g];
    const double* value = blocks[g].values.data();  // column by column
    for (const int j : at) {
      const double by = part.moved(j);
      for (const int i : at) part.change(i) += *value++ * by;
    }
  }
}

const VectorXd& System::tangent_forces(int element, const VectorXd& dy) const {
  const ElementPart& part = elements_[element];
  if (has_groups(element)) {
    add_block_forces(part, dy);
    return part.change;
  }
  const Eigen::Index count = part.response.tangent.rows();
  part.moved.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) part.moved(i) = dy(tangent_row(element, i));
  part.change.noalias() = part.response.tangent * part.moved;
  return part.change;
}

void System::add_tangent_forces(const VectorXd& dy, VectorXd& f) const {
  for (int e = 0; e < elements(); ++e) {
    const VectorXd& forces = tangent_forces(e, dy);
    for (Eigen::Index i = 0; i < forces.size(); ++i) f(tangent_row(e, i)) += forces(i);
  }
}

void System::pass_on(const VectorXd& dy, VectorXd& f) {
  add_tangent_forces(dy, f);
  if (!keeps_forces_) return;
  for (ElementPart& part : elements_) {
    part.passed = part.response.force;
    const std::vector<int>& rows = part.tangent_rows;
    for (Eigen::Index i = 0; i < part.change.size(); ++i)
      part.passed(rows.empty() ? i : rows[i]) += part.change(i);
  }
}

void System::begin_step(double time) {
  for (ElementPart& part : elements_) part.element->begin_step(time);
}

void System::finish_stage(const Stage& stage) {
  for (ElementPart& part : elements_) part.element->finish_stage(stage);
}

void System::accept_step(double time) {
  for (ElementPart& part : elements_) part.element->accept_step(time);
}

}  // namespace clatter::dynamics
