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

}  // namespace

StageMatrix::StageMatrix(const System& system) : system_(&system) {
  order();
  for (int e = 0; e < system.elements(); ++e)
    for (Part& part : parts_of(e, {})) all_.push_back(std::move(part));
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

std::vector<StageMatrix::Part> StageMatrix::parts_of(int element,
                                                     const std::vector<int>& touched) const {
  const std::vector<int>& at = system_->element(element).coordinates();
  const size_t count = touched.empty() ? at.size() : touched.size();
  std::map<int, Part> by_body;
  std::vector<int> columns;
  for (size_t i = 0; i < count; ++i) {
    const int y = at[touched.empty() ? i : static_cast<size_t>(touched[i])];
    const int body = system_->owner(y), position = position_[static_cast<size_t>(y)];
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
  for (const Part& part : all_)
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
  for (Part& part : all_)
    for (const int column : part.columns)
      part.starts.push_back(begin[static_cast<size_t>(column)].at(part.body));
  sparse_.emplace(std::move(starts), std::move(rows));
}

/// Parts and dense rows of what the elements touch at the moment.
void StageMatrix::list_touched() {
  bool same = !touched_.empty();
  for (int e = 0; same && e < system_->elements(); ++e)
    same = system_->tangent_rows(e) == touched_[static_cast<size_t>(e)];
  if (same) return;
  touched_.resize(static_cast<size_t>(system_->elements()));
  parts_.clear();
  kappa_ = 0.0;
  for (int e = 0; e < system_->elements(); ++e) {
    touched_[static_cast<size_t>(e)] = system_->tangent_rows(e);
    for (Part& part : parts_of(e, system_->tangent_rows(e))) parts_.push_back(std::move(part));
  }
  std::vector<char> is_touched(position_.size(), 0);
  for (const Part& part : parts_)
    for (const int column : part.columns) is_touched[static_cast<size_t>(column)] = 1;
  dense_row_.assign(position_.size(), -1);
  body_rows_.assign(system_->bodies().size(), {});
  int next = 0;
  for (size_t b = 0; b < body_rows_.size(); ++b) {
    const int first = first_[b],
              count = static_cast<int>(system_->rows(static_cast<int>(b)).size());
    for (int i = 0; i < count; ++i) {
      if (is_touched[static_cast<size_t>(first + i)] == 0) continue;
      dense_row_[static_cast<size_t>(first + i)] = next++;
      body_rows_[b].push_back(i);
    }
  }
  for (Part& part : parts_) {
    const auto& rows = body_rows_[static_cast<size_t>(part.body)];
    for (const int row : part.body_rows)
      part.S_rows.push_back(
          static_cast<int>(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin()));
  }
  dense_.resize(next, next);
  touched_y_.resize(static_cast<size_t>(next));
  for (size_t y = 0; y < position_.size(); ++y) {
    const int row = dense_row_[static_cast<size_t>(position_[y])];
    if (row >= 0) touched_y_[static_cast<size_t>(row)] = static_cast<int>(y);
  }
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

/// S T of one part in the touched rows of its body.
Eigen::Map<const MatrixXd> StageMatrix::product(const Part& part) {
  const MatrixXd& S = S_[static_cast<size_t>(part.body)];
  const MatrixXd& T = system_->response(part.element).tangent;
  const auto view = [](std::vector<double>& memory, Index rows, Index columns) {
    memory.resize(static_cast<size_t>(rows * columns));
    return Eigen::Map<MatrixXd>(memory.data(), rows, columns);
  };
  const auto k = static_cast<Index>(part.rows.size()), n = S.rows();
  auto S_part = view(S_part_, n, k), T_part = view(T_part_, k, T.cols()),
       ST = view(product_, n, T.cols());
  for (Index j = 0; j < k; ++j) {
    S_part.col(j) = S.col(part.S_rows[static_cast<size_t>(j)]);
    T_part.row(j) = T.row(part.rows[static_cast<size_t>(j)]);
  }
  ST.noalias() = S_part * T_part;
  return {product_.data(), n, T.cols()};
}

bool StageMatrix::form(const StageOperator& op) {
  if (position_.empty()) return true;
  return sparse_ ? form_sparse(op) : form_dense(op);
}

bool StageMatrix::form_dense(const StageOperator& op) {
  list_touched();
  form_S(op);
  dense_.setIdentity();
  for (const Part& part : parts_) {
    const auto& rows = body_rows_[static_cast<size_t>(part.body)];
    const auto ST = product(part);
    const int first =
        dense_row_[static_cast<size_t>(first_[static_cast<size_t>(part.body)] + rows.front())];
    for (Index j = 0; j < ST.cols(); ++j) {
      const int column = dense_row_[static_cast<size_t>(part.columns[static_cast<size_t>(j)])];
      dense_.col(column).segment(first, ST.rows()) -= ST.col(j);
    }
  }
  lu_.compute(dense_);
  return dense_.allFinite();
}

bool StageMatrix::form_sparse(const StageOperator& op) {
  form_S(op);
  std::fill(values_.begin(), values_.end(), 0.0);
  for (const int at : diagonal_) values_[static_cast<size_t>(at)] = 1.0;
  for (const Part& part : all_) {
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

void StageMatrix::apply_S(const VectorXd& f, VectorXd& result) const {
  gather(f, touched_y_, right_);
  result.resize(right_.size());
  Index first = 0;
  for (const MatrixXd& S : S_) {
    result.segment(first, S.rows()).noalias() = S * right_.segment(first, S.rows());
    first += S.rows();
  }
}

void StageMatrix::solve_touched(VectorXd& x) const {
  solved_.noalias() = lu_.solve(x);
  x.swap(solved_);
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
  if (dense_.rows() == x.size()) return;
  // Rows that nothing touches: x_i = right_i + (S T x)_i, T x being zero in them.
  forces_.setZero(x.size());
  system_->add_tangent_forces(x, forces_);
  op.apply_S(forces_, moved_);
  for (size_t y = 0; y < position_.size(); ++y)
    if (dense_row_[static_cast<size_t>(position_[y])] < 0)
      x(static_cast<Index>(y)) += moved_(static_cast<Index>(y));
}

}  // namespace clatter::dynamics
