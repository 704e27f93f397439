// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/elimination.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/error.hpp"

namespace clatter::assembly {
namespace {

constexpr int32_t kFree = -1, kKept = -2, kFixed = -3, kDropped = -4;
constexpr double kDependent = 1e-8;  // last diagonal of R, rows scaled to largest entry one

}  // namespace

Eliminator::Eliminator(int64_t n_dofs, const std::vector<int32_t>& fixed,
                       const std::vector<int32_t>& kept)
    : n_dofs_(n_dofs) {
  allocate(static_cast<int>(n_dofs), kFree);
  for (const int32_t dof : kept) state_[dof] = kKept;
  for (const int32_t dof : fixed) state_[dof] = kFixed;
}

int32_t Eliminator::allocate(int count, int32_t state) {
  const auto first = static_cast<int32_t>(state_.size());
  const size_t size = state_.size() + static_cast<size_t>(count);
  state_.resize(size, state);
  users_.resize(size);
  sum_.resize(size, 0.0);
  return first;
}

int32_t Eliminator::add_coordinates(int count) { return allocate(count, kKept); }

bool Eliminator::is_coordinate(int32_t id) const {
  const int32_t state = state_[id];
  return state == kFree || state == kKept;
}

bool Eliminator::is_held(int32_t id) const { return state_[id] == kFixed; }

void Eliminator::drop(int32_t id) { state_[id] = kDropped; }

bool Eliminator::is_dropped(int32_t id) const { return state_[id] == kDropped; }

Eliminator::SparseRow Eliminator::gather() {
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  SparseRow row;
  for (const int32_t id : touched_) {
    double& value = sum_[id];
    if (value != 0.0) row.emplace_back(id, value);
    value = 0.0;
  }
  touched_.clear();
  return row;
}

Eliminator::SparseRow Eliminator::expand(const Functional& functional) {
  const auto add = [this](int32_t id, double value) {
    sum_[id] += value;
    touched_.push_back(id);
  };
  for (size_t k = 0; k < functional.dofs.size(); ++k) {
    const int32_t state = state_[functional.dofs[k]];
    if (state < 0) {
      add(functional.dofs[k], functional.values[k]);
      continue;
    }
    for (const auto& [id, value] : pivot_rows_[state]) add(id, functional.values[k] * value);
  }
  return gather();
}

Functional Eliminator::express(const Functional& functional) {
  Functional out;
  for (const auto& [id, value] : expand(functional)) {
    out.dofs.push_back(id);
    out.values.push_back(value);
  }
  return out;
}

std::vector<bool> Eliminator::moves_any(const std::vector<std::pair<int64_t, int64_t>>& ids) const {
  std::vector<bool> moves(state_.size(), false);
  for (const auto& [first, last] : ids)
    for (int64_t dof = first; dof < last; ++dof) {
      const int32_t state = state_[dof];
      moves[dof] = true;
      if (state < 0) continue;
      for (const auto& entry : pivot_rows_[state]) moves[entry.first] = true;
    }
  return moves;
}

/// Columns of C that become pivots, one per row; none when the rows are not independent.
std::vector<int32_t> Eliminator::choose_pivots(const Eigen::MatrixXd& C,
                                               const std::vector<int32_t>& ids) const {
  std::vector<int32_t> candidates;
  for (size_t c = 0; c < ids.size(); ++c)
    if (state_[ids[c]] == kFree) candidates.push_back(static_cast<int32_t>(c));
  const Eigen::Index m = C.rows();
  std::vector<int32_t> chosen;
  if (static_cast<Eigen::Index>(candidates.size()) < m) return chosen;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(C(Eigen::all, candidates));
  const Eigen::VectorXd diagonal = qr.matrixQR().diagonal().cwiseAbs();
  if (diagonal(m - 1) > kDependent)
    for (Eigen::Index k = 0; k < m; ++k)
      chosen.push_back(candidates[qr.colsPermutation().indices()(k)]);
  return chosen;
}

void Eliminator::refuse(const std::string& where, size_t count) {
  throw InputError(
      fmt::format("{}: found rows that supports, sensors or other couplings already determine, "
                  "expected {} independent coordinates",
                  where, count));
}

void Eliminator::check_fill(const std::string& where) const {
  if (fill_ > std::numeric_limits<int32_t>::max())
    throw InputError(fmt::format(
        "{}: found couplings that would add up to {} entries to the stiffness matrix, expected "
        "fewer than 2^31; couple smaller surfaces or ranges",
        where, fill_));
}

/// `id` becomes the next pivot.
void Eliminator::add_pivot(int32_t id, SparseRow row) {
  const auto number = static_cast<int32_t>(pivot_rows_.size());
  state_[id] = number;
  for (const auto& entry : row) users_[entry.first].push_back(number);
  pivot_rows_.push_back(std::move(row));
}

/// Replaces newly eliminated ids in the rows of earlier pivots.
void Eliminator::substitute(const std::vector<int32_t>& fresh) {
  std::vector<int32_t> rows;
  for (const int32_t id : fresh) {
    std::vector<int32_t>& users = users_[id];
    rows.insert(rows.end(), users.begin(), users.end());
    users.clear();
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  for (const int32_t p : rows) {
    Functional row;
    for (const auto& [id, value] : pivot_rows_[p]) {
      row.dofs.push_back(id);
      row.values.push_back(value);
    }
    SparseRow replaced = expand(row);
    for (const auto& entry : replaced) users_[entry.first].push_back(p);
    pivot_rows_[p] = std::move(replaced);
  }
}

void Eliminator::depend(int32_t dof, const Functional& on) {
  SparseRow row = expand(on);
  const auto width = static_cast<int64_t>(row.size());
  fill_ += width * (width + 1) / 2;
  add_pivot(dof, std::move(row));
  substitute({dof});
}

/// Adds rows: pivots are replaced by the ids of the coordinates. False when the rows are not
/// independent.
bool Eliminator::eliminate(const std::vector<Functional>& functionals,
                           const std::vector<int32_t>& q_ids) {
  std::vector<SparseRow> rows;
  std::vector<int32_t> ids;
  for (const Functional& functional : functionals) {
    rows.push_back(expand(functional));
    for (const auto& entry : rows.back()) ids.push_back(entry.first);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());

  // Rows are scaled by their largest entry so that displacements and rotations are comparable in
  // the pivot search; before expansion, so that cancelled entries are recognised as rounding.
  const auto m = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(m, static_cast<Eigen::Index>(ids.size()));
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(m);
  for (Eigen::Index r = 0; r < m; ++r) {
    for (const auto& [id, value] : rows[r])
      C(r, std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()) = value;
    double largest = 0.0;
    for (const double value : functionals[r].values) largest = std::max(largest, std::abs(value));
    if (largest > 0.0) scale(r) = 1.0 / largest;
  }
  C = scale.asDiagonal() * C;
  const std::vector<int32_t> chosen = choose_pivots(C, ids);
  if (chosen.empty()) return false;
  const Eigen::PartialPivLU<Eigen::MatrixXd> pivot_block(C(Eigen::all, chosen));
  const Eigen::MatrixXd by_rest = -pivot_block.solve(C);
  const Eigen::MatrixXd by_q = pivot_block.solve(Eigen::MatrixXd(scale.asDiagonal()));

  std::vector<int32_t> fresh;
  std::vector<bool> is_pivot(ids.size(), false);
  for (const int32_t c : chosen) {
    fresh.push_back(ids[c]);
    is_pivot[c] = true;
  }
  for (Eigen::Index k = 0; k < m; ++k) {
    SparseRow row;
    for (size_t c = 0; c < ids.size(); ++c) {
      const double value = by_rest(k, static_cast<Eigen::Index>(c));
      if (!is_pivot[c] && value != 0.0) row.emplace_back(ids[c], value);
    }
    for (Eigen::Index g = 0; g < m; ++g)
      if (by_q(k, g) != 0.0) row.emplace_back(q_ids[g], by_q(k, g));
    std::sort(row.begin(), row.end());
    add_pivot(fresh[k], std::move(row));
  }
  substitute(fresh);
  const auto width = static_cast<int64_t>(ids.size());
  fill_ += width * (width + 1) / 2;
  return true;
}

void Eliminator::add_mean(const Functional& mean, const std::string& where) {
  const SparseRow row = expand(mean);
  const bool moves = std::any_of(row.begin(), row.end(),
                                 [this](const auto& entry) { return is_coordinate(entry.first); });
  const int32_t id = allocate(1, kFree);
  if (!moves) {  // a group whose DoFs are all held: it depends on the supports
    add_pivot(id, row);
    return;
  }
  if (!eliminate({mean}, {id})) refuse(where, 1);
}

/// The coupling's rows in terms of ids, after its means have become coordinates.
std::vector<Functional> Eliminator::add_means(const Coupling& coupling, const std::string& where) {
  const auto first_mean = static_cast<int32_t>(state_.size());
  for (const Functional& mean : coupling.means) add_mean(mean, where);
  std::vector<Functional> rows = coupling.rows;
  for (Functional& row : rows)
    for (int32_t& id : row.dofs)
      if (!coupling.means.empty()) id += first_mean;
  return rows;
}

int32_t Eliminator::add(const Coupling& coupling, const std::string& where) {
  const std::vector<Functional> rows = add_means(coupling, where);
  const int32_t first = allocate(static_cast<int>(rows.size()), kKept);
  std::vector<int32_t> ids(rows.size());
  std::iota(ids.begin(), ids.end(), first);
  if (coupling.disjoint) {
    for (size_t r = 0; r < rows.size(); ++r)
      if (!eliminate({rows[r]}, {ids[r]})) refuse(where + ": " + coupling.set.labels[r], 1);
  } else if (!eliminate(rows, ids)) {
    refuse(where, rows.size());
  }
  check_fill(where);
  return first;
}

bool Eliminator::add_onto(const Coupling& coupling, const std::vector<int32_t>& ids,
                          const std::string& where) {
  const bool done = eliminate(add_means(coupling, where), ids);
  check_fill(where);
  return done;
}

int32_t Eliminator::hold(const std::vector<Functional>& rows, const std::string& where) {
  return replace(rows, kFixed, where);
}

int32_t Eliminator::turn(const std::vector<Functional>& rows, const std::string& where) {
  return replace(rows, kKept, where);
}

int32_t Eliminator::replace(const std::vector<Functional>& rows, int32_t state,
                            const std::string& where) {
  const int32_t first = allocate(static_cast<int>(rows.size()), state);
  std::vector<int32_t> ids(rows.size());
  std::iota(ids.begin(), ids.end(), first);
  for (const Functional& row : rows)
    for (const int32_t id : row.dofs)
      if (state_[id] == kKept) state_[id] = kFree;
  if (!eliminate(rows, ids)) refuse(where, rows.size());
  return first;
}

Elimination Eliminator::finish() const {
  Elimination out;
  out.reduced_of.assign(state_.size(), -1);
  out.support_of.assign(state_.size(), -1);
  int32_t next = 0, held = 0;
  for (size_t id = 0; id < state_.size(); ++id) {
    if (state_[id] == kFree || state_[id] == kKept) out.reduced_of[id] = next++;
    if (state_[id] == kFixed) out.support_of[id] = held++;
  }
  // A row of T is a column of its transpose: rows are appended without sorting or searching.
  const auto dofs = static_cast<Eigen::Index>(n_dofs_);
  SparseMatrix t(next, dofs), t_s(held, dofs), pivots(next, dofs), pivots_s(held, dofs);
  Eigen::Index pivot = 0;
  for (Eigen::Index column = 0; column < dofs; ++column) {
    const auto dof = static_cast<size_t>(column);
    t.startVec(column);
    t_s.startVec(column);
    if (out.reduced_of[dof] >= 0) t.insertBack(out.reduced_of[dof], column) = 1.0;
    if (out.support_of[dof] >= 0) t_s.insertBack(out.support_of[dof], column) = 1.0;
    if (state_[dof] < 0) continue;
    out.pivots.push_back(static_cast<int32_t>(dof));
    pivots.startVec(pivot);
    pivots_s.startVec(pivot);
    for (const auto& [id, value] : pivot_rows_[state_[dof]]) {
      const int32_t reduced = out.reduced_of[id];
      const int32_t support = out.support_of[id];
      if (reduced >= 0) {
        t.insertBack(reduced, column) = value;
        pivots.insertBack(reduced, pivot) = value;
      } else if (support >= 0) {
        t_s.insertBack(support, column) = value;
        pivots_s.insertBack(support, pivot) = value;
      }
      if (reduced >= 0 && id < n_dofs_) out.growth = std::max(out.growth, std::abs(value));
    }
    ++pivot;
  }
  for (SparseMatrix* matrix : {&t, &t_s, &pivots, &pivots_s}) matrix->finalize();
  out.T = t.transpose();
  out.T_s = t_s.transpose();
  out.pivot_rows = SparseMatrix(pivots.leftCols(pivot)).transpose();
  out.pivot_rows_s = SparseMatrix(pivots_s.leftCols(pivot)).transpose();
  return out;
}

}  // namespace clatter::assembly
