// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/sparse_stage.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace clatter::dynamics {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// The elements' groups that contain each y, as numbers.
std::vector<std::vector<int>> groups_at(const System& system) {
  std::vector<std::vector<int>> found(static_cast<size_t>(system.interface_size()));
  int number = 0;
  for (int e = 0; e < system.elements(); ++e) {
    for (const std::vector<int>& group : system.groups(e)) {
      for (const int y : group) found[y].push_back(number);
      ++number;
    }
  }
  return found;
}

}  // namespace

SparseStage::SparseStage(const System& system) : system_(&system) {
  find_unknowns();
  find_couplings();
  count_nonzeros();
}

/// Bodies with rows, and their nodes: the entire body, or rows of a wide one.
void SparseStage::find_unknowns() {
  const auto n_y = static_cast<size_t>(system_->interface_size());
  unknown_.resize(n_y);
  node_.resize(n_y);
  right_.resize(n_y);
  const std::vector<std::vector<int>> groups = groups_at(*system_);
  int unknowns = 0;
  size_t entries = 0;
  for (int b = 0; b < static_cast<int>(system_->bodies().size()); ++b) {
    const std::vector<int>& at = system_->rows(b);
    if (at.empty()) continue;
    const auto size = static_cast<int>(at.size());
    std::map<std::vector<int>, std::vector<int>> parts;  // rows by what touches them
    for (int row = 0; row < size; ++row) {
      const auto y = static_cast<size_t>(at[row]);
      parts[size > BodyElimination::kMostUnknowns ? groups[y] : std::vector<int>()].push_back(row);
    }
    graph_.bodies.push_back({unknowns, size, entries});
    entries += static_cast<size_t>(size) * static_cast<size_t>(size);
    body_.push_back(b);
    rows_.emplace_back();
    for (const auto& [touching, rows] : parts) {
      graph_.nodes.push_back({unknowns, static_cast<int>(rows.size())});
      for (const int row : rows) {
        const auto y = static_cast<size_t>(at[row]);
        node_[y] = static_cast<int>(graph_.nodes.size()) - 1;
        unknown_[y] = unknowns++;
      }
      rows_.back().insert(rows_.back().end(), rows.begin(), rows.end());
    }
  }
  graph_.S.resize(entries);
}

void SparseStage::find_couplings() {
  for (int e = 0; e < system_->elements(); ++e) {
    const auto& groups = system_->groups(e);
    for (size_t g = 0; g < groups.size(); ++g) {
      StageGraph::Coupling coupling;
      for (const int i : groups[g]) {
        const auto y = static_cast<size_t>(i);
        coupling.node.push_back(node_[y]);
        coupling.row.push_back(unknown_[y] - graph_.nodes[node_[y]].first);
      }
      coupling.nodes = coupling.node;
      std::sort(coupling.nodes.begin(), coupling.nodes.end());
      coupling.nodes.erase(std::unique(coupling.nodes.begin(), coupling.nodes.end()),
                           coupling.nodes.end());
      graph_.couplings.push_back(std::move(coupling));
      sources_.push_back({e, static_cast<int>(g)});
    }
  }
}

void SparseStage::count_nonzeros() {
  std::vector<std::vector<int>> columns(unknown_.size());
  const auto couple = [&](const std::vector<int>& all) {
    for (const int j : all) {
      std::vector<int>& column = columns[j];
      column.insert(column.end(), all.begin(), all.end());
    }
  };
  for (int e = 0; e < system_->elements(); ++e)
    for (const std::vector<int>& group : system_->groups(e)) couple(group);
  for (const int b : body_)
    if (!system_->has_single_rows(b)) couple(system_->rows(b));
  for (std::vector<int>& column : columns) {
    std::sort(column.begin(), column.end());
    nonzeros_ += static_cast<int>(std::unique(column.begin(), column.end()) - column.begin());
  }
}

/// The tangents of the last evaluation; true when other ones are active than in the last form().
bool SparseStage::renew_couplings() {
  bool renewed = !started_;
  started_ = true;
  for (size_t i = 0; i < sources_.size(); ++i) {
    const auto [element, group] = sources_[i];
    StageGraph::Coupling& coupling = graph_.couplings[i];
    const Response& response = system_->response(element);
    bool active = true;
    if (system_->has_groups(element)) {
      const TangentBlock& block = response.blocks[group];
      active = block.active;
      coupling.tangent = &block.values;
    } else {
      const std::vector<int>& touched = system_->tangent_rows(element);
      coupling.tangent = &response.tangent;
      coupling.touched = touched.empty() ? nullptr : &touched;
    }
    renewed = renewed || active != coupling.active;
    coupling.active = active;
  }
  return renewed;
}

void SparseStage::copy_S(const StageOperator& op) {
  if (kappa_ == op.kappa()) return;
  kappa_ = op.kappa();
  for (size_t b = 0; b < body_.size(); ++b) {
    const auto S = op.S(body_[b]);
    double* to = graph_.S.data() + graph_.bodies[b].S;
    for (const int j : rows_[b])
      for (const int i : rows_[b]) *to++ = S(i, j);
  }
}

int SparseStage::staying() const {
  int sum = 0;
  for (const StageGraph::Body& body : graph_.bodies)
    if (body.size > BodyElimination::kMostUnknowns) sum += body.size;
  return sum;
}

bool SparseStage::form(const StageOperator& op) {
  copy_S(op);
  const bool renewed = renew_couplings();
  if (!by_bodies_) {
    std::vector<char> wide;
    for (const StageGraph::Body& body : graph_.bodies)
      wide.push_back(body.size > BodyElimination::kMostUnknowns ? 1 : 0);
    by_bodies_.emplace(graph_, wide);
  }
  is_dense_ = !by_bodies_->factor(graph_, renewed);
  if (!is_dense_) return true;
  if (!at_once_) at_once_.emplace(graph_, std::vector<char>(graph_.bodies.size(), 1));
  return at_once_->factor(graph_, true);
}

void SparseStage::solve(VectorXd& x) const {
  for (size_t y = 0; y < unknown_.size(); ++y) right_[unknown_[y]] = x(static_cast<Index>(y));
  (is_dense_ ? at_once_ : by_bodies_)->solve(graph_, right_.data());
  for (size_t y = 0; y < unknown_.size(); ++y) x(static_cast<Index>(y)) = right_[unknown_[y]];
}

}  // namespace clatter::dynamics
