// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/stage_matrix.hpp"

#include <algorithm>
#include <utility>

namespace clatter::dynamics {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Below this size dense arithmetic is the faster one whatever the pattern; above it a sparse
/// factor pays when at most this share of S and T can differ from 0, and when most unknowns are of
/// bodies that are eliminated one by one.
constexpr int kSmall = 48;
constexpr double kFew = 0.25, kMostStaying = 0.5;
/// Rows and columns of S^1/2 T S^1/2 whose entries sum to less change nothing.
constexpr double kNegligible = 1e-14;

}  // namespace

StageMatrix::StageMatrix(const System& system) : system_(&system) {
  SparseStage sparse(system);
  const auto n = static_cast<double>(system.interface_size());
  nonzeros_ = sparse.nonzeros();
  if (n > kSmall && nonzeros_ <= kFew * n * n && sparse.staying() <= kMostStaying * n)
    sparse_ = std::move(sparse);
}

/// Rows that the elements touch at the moment, body by body.
void StageMatrix::list_touched() {
  bool same = !touched_.empty();
  for (int e = 0; same && e < system_->elements(); ++e)
    same = system_->tangent_rows(e) == touched_[e];
  if (same) return;
  kappa_ = 0.0;
  touched_.resize(system_->elements());
  row_.assign(system_->interface_size(), -1);
  for (int e = 0; e < system_->elements(); ++e) {
    const std::vector<int>& at = system_->element(e).coordinates();
    touched_[e] = system_->tangent_rows(e);
    for (const int i : system_->tangent_rows(e)) row_[at[i]] = 0;
    if (system_->tangent_rows(e).empty())
      for (const int y : at) row_[y] = 0;
  }
  touched_y_.clear();
  body_rows_.assign(system_->bodies().size(), {});
  for (size_t b = 0; b < body_rows_.size(); ++b) {
    const std::vector<int>& rows = system_->rows(static_cast<int>(b));
    for (size_t i = 0; i < rows.size(); ++i) {
      int& row = row_[rows[i]];
      if (row < 0) continue;
      row = static_cast<int>(touched_y_.size());
      touched_y_.push_back(rows[i]);
      body_rows_[b].push_back(static_cast<int>(i));
    }
  }
  const auto k = static_cast<Index>(touched_y_.size());
  T_.resize(k, k);
  size_.resize(k);
}

/// S of all bodies in the rows that are touched.
void StageMatrix::form_S(const StageOperator& op) {
  if (kappa_ == op.kappa()) return;
  kappa_ = op.kappa();
  S_.resize(system_->bodies().size());
  for (size_t b = 0; b < S_.size(); ++b) op.form_S(static_cast<int>(b), body_rows_[b], S_[b]);
}

/// T_ of the elements' last tangents.
void StageMatrix::add_tangents() {
  T_.setZero();
  for (int e = 0; e < system_->elements(); ++e) {
    if (system_->has_groups(e)) {
      add_blocks(e);
      continue;
    }
    const std::vector<int>& at = system_->element(e).coordinates();
    const std::vector<int>& touched = touched_[e];
    const MatrixXd& T = system_->response(e).tangent;
    const auto row = [&](Index i) {
      const auto place = static_cast<size_t>(i);
      return row_[at[touched.empty() ? place : static_cast<size_t>(touched[place])]];
    };
    for (Index j = 0; j < T.cols(); ++j) {
      double* column = T_.col(row(j)).data();
      for (Index i = 0; i < T.rows(); ++i) column[row(i)] += T(i, j);
    }
  }
}

/// The same of an element with groups.
void StageMatrix::add_blocks(int element) {
  const auto& groups = system_->groups(element);
  const std::vector<TangentBlock>& blocks = system_->response(element).blocks;
  for (size_t g = 0; g < groups.size(); ++g) {
    if (!blocks[g].active) continue;
    const std::vector<int>& at = groups[g];
    for (size_t j = 0; j < at.size(); ++j)
      for (size_t i = 0; i < at.size(); ++i)
        T_(row_[at[i]], row_[at[j]]) +=
            blocks[g].values(static_cast<Index>(i), static_cast<Index>(j));
  }
}

/// Rows and columns of T_ that matter, measured as S^1/2 T S^1/2 is, which has no units.
void StageMatrix::pick_significant() {
  const auto k = T_.rows();
  Index first = 0;
  for (const MatrixXd& S : S_) {
    size_.segment(first, S.rows()) = S.diagonal().cwiseMax(0.0).cwiseSqrt();
    first += S.rows();
  }
  columns_.clear();
  rows_.clear();
  moved_.setZero(k);  // sums of rows
  for (Index j = 0; j < k; ++j) {
    const auto scaled = T_.col(j).cwiseAbs().cwiseProduct(size_) * size_(j);
    if (!(scaled.sum() <= kNegligible)) columns_.push_back(static_cast<int>(j));
    moved_ += scaled;
  }
  for (Index i = 0; i < k; ++i)
    if (!(moved_(i) <= kNegligible)) rows_.push_back(static_cast<int>(i));
}

bool StageMatrix::form(const StageOperator& op) {
  if (system_->interface_size() == 0) return true;
  return sparse_ ? sparse_->form(op) : form_dense(op);
}

bool StageMatrix::form_dense(const StageOperator& op) {
  list_touched();
  form_S(op);
  add_tangents();
  pick_significant();
  auto J = lu_.matrix(static_cast<Index>(columns_.size()));
  J.setIdentity();
  const auto view = [](std::vector<double>& memory, Index n, Index m) {
    memory.resize(std::max(memory.size(), static_cast<size_t>(n * m)));
    return Eigen::Map<MatrixXd>(memory.data(), n, m);
  };
  int first = 0;
  auto row = rows_.begin();
  auto column = columns_.begin();
  for (const MatrixXd& S : S_) {
    const int end = first + static_cast<int>(S.rows());
    const auto rows_end = std::lower_bound(row, rows_.end(), end);
    const auto columns_end = std::lower_bound(column, columns_.end(), end);
    auto S_part = view(S_part_, columns_end - column, rows_end - row),
         T_part = view(T_part_, rows_end - row, J.cols());
    for (Index r = 0; r < S_part.cols(); ++r)
      for (Index c = 0; c < S_part.rows(); ++c) S_part(c, r) = S(column[c] - first, row[r] - first);
    for (Index c = 0; c < J.cols(); ++c)
      for (Index r = 0; r < T_part.rows(); ++r) T_part(r, c) = T_(row[r], columns_[c]);
    J.middleRows(column - columns_.begin(), S_part.rows()).noalias() -= S_part * T_part;
    first = end;
    row = rows_end;
    column = columns_end;
  }
  return lu_.factor();
}

bool StageMatrix::covers(const StageOperator& op) const {
  if (sparse_ || kappa_ != op.kappa() || touched_.empty()) return false;
  for (int e = 0; e < system_->elements(); ++e)
    if (system_->response(e).touched != touched_[e]) return false;
  return true;
}

void StageMatrix::add_S(const VectorXd& f, VectorXd& result) const {
  Index first = 0;
  for (const MatrixXd& S : S_) {
    result.segment(first, S.rows()).noalias() += S * f.segment(first, S.rows());
    first += S.rows();
  }
}

void StageMatrix::apply_S(const VectorXd& f, VectorXd& result) const {
  gather(f, touched_y_, right_);
  result.setZero(right_.size());
  add_S(right_, result);
}

void StageMatrix::solve_touched(VectorXd& x) const {
  solved_.resize(columns_.size());
  for (size_t c = 0; c < columns_.size(); ++c) solved_[c] = x(columns_[c]);
  lu_.solve(solved_.data());
  if (columns_.size() < touched_y_.size()) {
    forces_.setZero(x.size());
    for (size_t c = 0; c < columns_.size(); ++c) forces_ += T_.col(columns_[c]) * solved_[c];
    add_S(forces_, x);
  }
  for (size_t c = 0; c < columns_.size(); ++c) x(columns_[c]) = solved_[c];
}

void StageMatrix::solve(const StageOperator& op, VectorXd& x) const {
  if (x.size() == 0) return;
  if (sparse_) {
    sparse_->solve(x);
    return;
  }
  gather(x, touched_y_, right_);
  solve_touched(right_);
  for (size_t i = 0; i < touched_y_.size(); ++i) x(touched_y_[i]) = right_(static_cast<Index>(i));
  if (touched() == x.size()) return;
  // Rows that nothing touches: x_i = right_i + (S T x)_i, T x being zero in them.
  forces_.setZero(x.size());
  system_->add_tangent_forces(x, forces_);
  op.apply_S(forces_, moved_);
  for (size_t y = 0; y < row_.size(); ++y)
    if (row_[y] < 0) x(static_cast<Index>(y)) += moved_(static_cast<Index>(y));
}

}  // namespace clatter::dynamics
