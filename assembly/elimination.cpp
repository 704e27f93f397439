#include "assembly/elimination.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace clatter::assembly {
namespace {

constexpr int32_t kFree = -1, kKept = -2, kFixed = -3;
constexpr double kDependent = 1e-8;  // last diagonal of R, rows scaled to largest entry one

}  // namespace

Eliminator::Eliminator(int64_t n_dofs, const std::vector<int32_t>& fixed,
                       const std::vector<int32_t>& kept)
    : n_dofs_(n_dofs), state_(static_cast<size_t>(n_dofs), kFree) {
  for (const int32_t dof : kept) state_[static_cast<size_t>(dof)] = kKept;
  for (const int32_t dof : fixed) state_[static_cast<size_t>(dof)] = kFixed;
  sum_.assign(static_cast<size_t>(n_dofs), 0.0);
}

Eliminator::SparseRow Eliminator::gather() {
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  SparseRow row;
  for (const int32_t id : touched_) {
    double& value = sum_[static_cast<size_t>(id)];
    if (value != 0.0) row.emplace_back(id, value);
    value = 0.0;
  }
  touched_.clear();
  return row;
}

/// A functional of displacements in terms of what is still in the model.
Eliminator::SparseRow Eliminator::expand(const Functional& functional) {
  const auto add = [this](int32_t id, double value) {
    sum_[static_cast<size_t>(id)] += value;
    touched_.push_back(id);
  };
  for (size_t k = 0; k < functional.dofs.size(); ++k) {
    const int32_t state = state_[static_cast<size_t>(functional.dofs[k])];
    if (state == kFixed) continue;
    if (state == kFree || state == kKept) {
      add(functional.dofs[k], functional.values[k]);
      continue;
    }
    for (const auto& [id, value] : pivot_rows_[static_cast<size_t>(state)])
      add(id, functional.values[k] * value);
  }
  return gather();
}

std::vector<int32_t> Eliminator::choose_pivots(const Eigen::MatrixXd& C,
                                               const std::vector<int32_t>& ids,
                                               const std::string& where) const {
  std::vector<int32_t> candidates;
  for (size_t c = 0; c < ids.size(); ++c)
    if (state_[static_cast<size_t>(ids[c])] == kFree) candidates.push_back(static_cast<int32_t>(c));
  const Eigen::Index m = C.rows();
  std::vector<int32_t> chosen;
  if (static_cast<Eigen::Index>(candidates.size()) >= m) {
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(C(Eigen::all, candidates));
    const Eigen::VectorXd diagonal = qr.matrixQR().diagonal().cwiseAbs();
    if (diagonal(m - 1) > kDependent)
      for (Eigen::Index k = 0; k < m; ++k)
        chosen.push_back(candidates[static_cast<size_t>(qr.colsPermutation().indices()(k))]);
  }
  if (chosen.empty())
    throw InputError(
        fmt::format("{}: found rows that supports, sensors or other couplings already determine, "
                    "expected {} independent coordinates",
                    where, m));
  return chosen;
}

/// Replaces pivots that have just been chosen in the rows of earlier ones.
void Eliminator::substitute(const std::vector<int32_t>& fresh) {
  const size_t old = pivot_rows_.size() - fresh.size();
  for (size_t p = 0; p < old; ++p) {
    const auto is_fresh = [&](const auto& entry) {
      return std::find(fresh.begin(), fresh.end(), entry.first) != fresh.end();
    };
    if (std::none_of(pivot_rows_[p].begin(), pivot_rows_[p].end(), is_fresh)) continue;
    Functional row;
    for (const auto& [id, value] : pivot_rows_[p]) {
      row.dofs.push_back(id);
      row.values.push_back(value);
    }
    pivot_rows_[p] = expand(row);
  }
}

/// Takes rows in as the next generalised coordinates, which get the given state.
void Eliminator::eliminate(const std::vector<Functional>& functionals, int32_t state,
                           const std::string& where) {
  std::vector<SparseRow> rows;
  std::vector<int32_t> ids;
  for (const Functional& functional : functionals) {
    rows.push_back(expand(functional));
    for (const auto& entry : rows.back()) ids.push_back(entry.first);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());

  // Rows are scaled so that displacements and rotations compare in the pivot search: by their
  // largest entry before expansion, so that what cancels in it is seen to be rounding.
  const auto m = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(m, static_cast<Eigen::Index>(ids.size()));
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(m);
  for (Eigen::Index r = 0; r < m; ++r) {
    for (const auto& [id, value] : rows[static_cast<size_t>(r)])
      C(r, std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()) = value;
    double largest = 0.0;
    for (const double value : functionals[static_cast<size_t>(r)].values)
      largest = std::max(largest, std::abs(value));
    if (largest > 0.0) scale(r) = 1.0 / largest;
  }
  C = scale.asDiagonal() * C;
  const std::vector<int32_t> chosen = choose_pivots(C, ids, where);
  const Eigen::PartialPivLU<Eigen::MatrixXd> pivot_block(C(Eigen::all, chosen));
  const Eigen::MatrixXd by_rest = -pivot_block.solve(C);
  const Eigen::MatrixXd by_q = pivot_block.solve(Eigen::MatrixXd(scale.asDiagonal()));

  std::vector<int32_t> fresh;
  std::vector<bool> is_pivot(ids.size(), false);
  for (const int32_t c : chosen) {
    fresh.push_back(ids[static_cast<size_t>(c)]);
    is_pivot[static_cast<size_t>(c)] = true;
  }
  for (Eigen::Index k = 0; k < m; ++k) {
    SparseRow row;
    for (size_t c = 0; c < ids.size(); ++c) {
      const double value = by_rest(k, static_cast<Eigen::Index>(c));
      if (!is_pivot[c] && value != 0.0) row.emplace_back(ids[c], value);
    }
    for (Eigen::Index g = 0; g < m; ++g)
      if (by_q(k, g) != 0.0)
        row.emplace_back(static_cast<int32_t>(n_dofs_ + generalised_ + g), by_q(k, g));
    state_[static_cast<size_t>(fresh[static_cast<size_t>(k)])] =
        static_cast<int32_t>(pivot_rows_.size());
    pivot_dofs_.push_back(fresh[static_cast<size_t>(k)]);
    pivot_rows_.push_back(std::move(row));
  }
  generalised_ += static_cast<int>(m);
  sum_.resize(static_cast<size_t>(n_dofs_ + generalised_), 0.0);
  state_.resize(sum_.size(), state);
  substitute(fresh);
  const auto width = static_cast<int64_t>(ids.size());
  fill_ += width * (width + 1) / 2;
}

void Eliminator::add_mean(const Functional& mean, const std::string& where) {
  if (expand(mean).empty()) {  // a group that supports hold altogether
    ++generalised_;
    sum_.push_back(0.0);
    state_.push_back(kFixed);
    return;
  }
  eliminate({mean}, kFree, where);
}

int Eliminator::add(const Coupling& coupling, const std::string& where) {
  const auto first_mean = static_cast<int32_t>(n_dofs_ + generalised_);
  for (const Functional& mean : coupling.means) add_mean(mean, where);
  std::vector<Functional> rows = coupling.rows;
  for (Functional& row : rows)
    for (int32_t& id : row.dofs)
      if (!coupling.means.empty()) id += first_mean;
  const int first = generalised_;
  if (coupling.disjoint) {
    for (size_t r = 0; r < rows.size(); ++r)
      eliminate({rows[r]}, kKept, where + ": " + coupling.set.labels[r]);
  } else {
    eliminate(rows, kKept, where);
  }
  if (fill_ > std::numeric_limits<int32_t>::max())
    throw InputError(fmt::format(
        "{}: found couplings that would add up to {} entries to the stiffness matrix, expected "
        "fewer than 2^31; couple smaller surfaces or ranges",
        where, fill_));
  return first;
}

Elimination Eliminator::finish() const {
  Elimination out;
  out.reduced_of.assign(state_.size(), -1);
  int32_t next = 0;
  for (size_t id = 0; id < state_.size(); ++id)
    if (state_[id] == kFree || state_[id] == kKept) out.reduced_of[id] = next++;
  // A row of T is a column of its transpose: rows are appended, nothing is sorted or searched.
  const auto nodal = static_cast<Eigen::Index>(n_dofs_);
  SparseMatrix transposed(next, nodal), pivots(next, nodal);
  Eigen::Index pivot = 0;
  for (Eigen::Index column = 0; column < nodal; ++column) {
    const auto dof = static_cast<size_t>(column);
    transposed.startVec(column);
    if (out.reduced_of[dof] >= 0) transposed.insertBack(out.reduced_of[dof], column) = 1.0;
    if (state_[dof] < 0) continue;
    out.pivots.push_back(static_cast<int32_t>(dof));
    pivots.startVec(pivot);
    for (const auto& [id, value] : pivot_rows_[static_cast<size_t>(state_[dof])]) {
      const int32_t reduced = out.reduced_of[static_cast<size_t>(id)];
      transposed.insertBack(reduced, column) = value;
      pivots.insertBack(reduced, pivot) = value;
      if (id < n_dofs_) out.growth = std::max(out.growth, std::abs(value));
    }
    ++pivot;
  }
  transposed.finalize();
  pivots.finalize();
  out.T = transposed.transpose();
  out.pivot_rows = SparseMatrix(pivots.leftCols(pivot)).transpose();
  return out;
}

}  // namespace clatter::assembly
