// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/stage_matrix.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace clatter::dynamics {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Below this size dense arithmetic is the faster one whatever the pattern; above it a sparse
/// factor pays when at most this share of J can differ from 0.
constexpr int kSmall = 48;
constexpr double kFew = 0.25;
/// Rows and columns of S^1/2 T S^1/2 whose entries sum to less change nothing.
constexpr double kNegligible = 1e-14;

}  // namespace

StageMatrix::StageMatrix(const System& system) : system_(&system) {
  order();
  for (int e = 0; e < system.elements(); ++e)
    for (Part& part : parts_of(e)) parts_.push_back(std::move(part));
  find_pattern();
}

void StageMatrix::order() {
  position_.resize(static_cast<size_t>(system_->interface_size()));
  int next = 0;
  for (int b = 0; b < static_cast<int>(system_->bodies().size()); ++b) {
    first_.push_back(next);
    for (const int y : system_->rows(b)) position_[static_cast<size_t>(y)] = next++;
  }
}

std::vector<StageMatrix::Part> StageMatrix::parts_of(int element) const {
  const std::vector<int>& at = system_->element(element).coordinates();
  std::map<int, Part> by_body;
  std::vector<int> columns;
  for (size_t i = 0; i < at.size(); ++i) {
    const int body = system_->owner(at[i]), position = position_[static_cast<size_t>(at[i])];
    columns.push_back(position);
    by_body[body].rows.push_back(static_cast<int>(i));
    by_body[body].body_rows.push_back(position - first_[static_cast<size_t>(body)]);
  }
  std::vector<Part> parts;
  for (auto& [body, part] : by_body) {
    part.element = element;
    part.body = body;
    part.columns = columns;
    parts.push_back(std::move(part));
  }
  return parts;
}

void StageMatrix::find_pattern() {
  const int n = system_->interface_size();
  const int bodies = static_cast<int>(system_->bodies().size());
  const auto rows_of = [&](int body) { return static_cast<int>(system_->rows(body).size()); };
  std::vector<std::set<int>> blocks(static_cast<size_t>(n));  // column: bodies whose rows it has
  for (int b = 0; b < bodies; ++b)
    for (int i = 0; i < rows_of(b); ++i)
      blocks[static_cast<size_t>(first_[static_cast<size_t>(b)] + i)].insert(b);
  for (const Part& part : parts_)
    for (const int column : part.columns) blocks[static_cast<size_t>(column)].insert(part.body);
  for (const auto& block : blocks)
    for (const int b : block) nonzeros_ += rows_of(b);
  if (n <= kSmall || nonzeros_ > kFew * static_cast<double>(n) * n) return;

  std::vector<int> starts{0}, rows;
  std::vector<std::map<int, int>> begin(static_cast<size_t>(n));
  for (int j = 0; j < n; ++j) {
    for (const int b : blocks[static_cast<size_t>(j)]) {
      const int first = first_[static_cast<size_t>(b)];
      begin[static_cast<size_t>(j)][b] = static_cast<int>(rows.size());
      for (int i = first; i < first + rows_of(b); ++i) {
        if (i == j) diagonal_.push_back(static_cast<int>(rows.size()));
        rows.push_back(i);
      }
    }
    starts.push_back(static_cast<int>(rows.size()));
  }
  values_.resize(rows.size());
  for (Part& part : parts_)
    for (const int column : part.columns)
      part.starts.push_back(begin[static_cast<size_t>(column)].at(part.body));
  sparse_.emplace(std::move(starts), std::move(rows));
}

/// Rows that the elements touch at the moment, body by body.
void StageMatrix::list_touched() {
  bool same = !touched_.empty();
  for (int e = 0; same && e < system_->elements(); ++e)
    same = system_->tangent_rows(e) == touched_[static_cast<size_t>(e)];
  if (same) return;
  kappa_ = 0.0;
  touched_.resize(static_cast<size_t>(system_->elements()));
  row_.assign(position_.size(), -1);
  for (int e = 0; e < system_->elements(); ++e) {
    const std::vector<int>& at = system_->element(e).coordinates();
    touched_[static_cast<size_t>(e)] = system_->tangent_rows(e);
    for (const int i : system_->tangent_rows(e))
      row_[static_cast<size_t>(at[static_cast<size_t>(i)])] = 0;
    if (system_->tangent_rows(e).empty())
      for (const int y : at) row_[static_cast<size_t>(y)] = 0;
  }
  touched_y_.clear();
  body_rows_.assign(system_->bodies().size(), {});
  for (size_t b = 0; b < body_rows_.size(); ++b) {
    const std::vector<int>& rows = system_->rows(static_cast<int>(b));
    for (size_t i = 0; i < rows.size(); ++i) {
      int& row = row_[static_cast<size_t>(rows[i])];
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
  for (size_t b = 0; b < S_.size(); ++b) {
    const int body = static_cast<int>(b);
    if (sparse_)
      S_[b] = op.S(body);
    else
      op.form_S(body, body_rows_[b], S_[b]);
  }
}

/// T_ of the elements' last tangents.
void StageMatrix::add_tangents() {
  T_.setZero();
  for (int e = 0; e < system_->elements(); ++e) {
    const std::vector<int>& at = system_->element(e).coordinates();
    const std::vector<int>& touched = touched_[static_cast<size_t>(e)];
    const MatrixXd& T = system_->response(e).tangent;
    const auto row = [&](Index i) {
      const auto place = static_cast<size_t>(i);
      return row_[static_cast<size_t>(
          at[touched.empty() ? place : static_cast<size_t>(touched[place])])];
    };
    for (Index j = 0; j < T.cols(); ++j) {
      double* column = T_.col(row(j)).data();
      for (Index i = 0; i < T.rows(); ++i) column[row(i)] += T(i, j);
    }
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
  if (position_.empty()) return true;
  return sparse_ ? form_sparse(op) : form_dense(op);
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
      for (Index r = 0; r < T_part.rows(); ++r)
        T_part(r, c) = T_(row[r], columns_[static_cast<size_t>(c)]);
    J.middleRows(column - columns_.begin(), S_part.rows()).noalias() -= S_part * T_part;
    first = end;
    row = rows_end;
    column = columns_end;
  }
  return lu_.factor();
}

bool StageMatrix::form_sparse(const StageOperator& op) {
  form_S(op);
  std::fill(values_.begin(), values_.end(), 0.0);
  for (const int at : diagonal_) values_[static_cast<size_t>(at)] = 1.0;
  for (const Part& part : parts_) {
    const MatrixXd& S = S_[static_cast<size_t>(part.body)];
    const MatrixXd& T = system_->response(part.element).tangent;
    for (size_t k = 0; k < part.rows.size(); ++k) {
      const auto column_of_S = S.col(part.body_rows[k]);
      for (Index j = 0; j < T.cols(); ++j) {
        const double t = T(part.rows[k], j);
        if (t == 0.0) continue;
        double* column = values_.data() + part.starts[static_cast<size_t>(j)];
        for (Index i = 0; i < S.rows(); ++i) column[i] -= t * column_of_S(i);
      }
    }
  }
  return sparse_->factor(values_);
}

bool StageMatrix::covers(const StageOperator& op) const {
  if (sparse_ || kappa_ != op.kappa() || touched_.empty()) return false;
  for (int e = 0; e < system_->elements(); ++e)
    if (system_->response(e).touched != touched_[static_cast<size_t>(e)]) return false;
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
  solved_.resize(static_cast<Index>(columns_.size()));
  for (size_t c = 0; c < columns_.size(); ++c) solved_(static_cast<Index>(c)) = x(columns_[c]);
  lu_.solve(solved_);
  if (columns_.size() < touched_y_.size()) {
    forces_.setZero(x.size());
    for (size_t c = 0; c < columns_.size(); ++c)
      forces_ += T_.col(columns_[c]) * solved_(static_cast<Index>(c));
    add_S(forces_, x);
  }
  for (size_t c = 0; c < columns_.size(); ++c) x(columns_[c]) = solved_(static_cast<Index>(c));
}

void StageMatrix::solve(const StageOperator& op, VectorXd& x) const {
  if (position_.empty()) return;
  if (sparse_) {
    right_.resize(x.size());
    for (size_t y = 0; y < position_.size(); ++y) right_(position_[y]) = x(static_cast<Index>(y));
    sparse_->solve(right_.data());
    for (size_t y = 0; y < position_.size(); ++y) x(static_cast<Index>(y)) = right_(position_[y]);
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
  for (size_t y = 0; y < position_.size(); ++y)
    if (row_[y] < 0) x(static_cast<Index>(y)) += moved_(static_cast<Index>(y));
}

}  // namespace clatter::dynamics
