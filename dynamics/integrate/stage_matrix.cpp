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
/// factor pays when at most this share of J can differ from 0 (bench/stage_matrix).
constexpr int kSmall = 48;
constexpr double kFew = 0.25;

}  // namespace

StageMatrix::StageMatrix(const System& system) : system_(&system) {
  order();
  list_parts();
  find_pattern();
  ordered_.setZero(system.interface_size());
}

void StageMatrix::order() {
  position_.resize(static_cast<size_t>(system_->interface_size()));
  int next = 0;
  for (int b = 0; b < static_cast<int>(system_->bodies().size()); ++b) {
    first_.push_back(next);
    for (const int y : system_->rows(b)) position_[static_cast<size_t>(y)] = next++;
  }
}

void StageMatrix::list_parts() {
  for (int e = 0; e < system_->elements(); ++e) {
    const std::vector<int>& at = system_->element(e).coordinates();
    std::map<int, Part> by_body;
    for (int i = 0; i < static_cast<int>(at.size()); ++i) {
      const int y = at[static_cast<size_t>(i)], body = system_->owner(y);
      Part& part = by_body[body];
      part.rows.push_back(i);
      part.body_rows.push_back(position_[static_cast<size_t>(y)] -
                               first_[static_cast<size_t>(body)]);
    }
    for (auto& [body, part] : by_body) {
      part.element = e;
      part.body = body;
      for (const int y : at) part.columns.push_back(position_[static_cast<size_t>(y)]);
      parts_.push_back(std::move(part));
    }
  }
}

void StageMatrix::find_pattern() {
  const int n = system_->interface_size();
  const int bodies = static_cast<int>(system_->bodies().size());
  std::vector<std::set<int>> blocks(static_cast<size_t>(n));  // column: bodies whose rows it has
  for (const Part& part : parts_)
    for (const int column : part.columns) blocks[static_cast<size_t>(column)].insert(part.body);
  std::vector<int> owner(static_cast<size_t>(n));
  for (int b = 0; b < bodies; ++b)
    for (size_t i = 0; i < system_->rows(b).size(); ++i)
      owner[static_cast<size_t>(first_[static_cast<size_t>(b)]) + i] = b;
  for (int j = 0; j < n; ++j) {
    blocks[static_cast<size_t>(j)].insert(owner[static_cast<size_t>(j)]);
    for (const int b : blocks[static_cast<size_t>(j)])
      nonzeros_ += static_cast<int>(system_->rows(b).size());
  }
  if (n <= kSmall || nonzeros_ > kFew * static_cast<double>(n) * n) {
    dense_.resize(n, n);
    return;
  }
  std::vector<int> starts{0}, rows;
  std::vector<std::map<int, int>> begin(static_cast<size_t>(n));
  for (int j = 0; j < n; ++j) {
    for (const int b : blocks[static_cast<size_t>(j)]) {
      const int first = first_[static_cast<size_t>(b)];
      begin[static_cast<size_t>(j)][b] = static_cast<int>(rows.size());
      for (int i = 0; i < static_cast<int>(system_->rows(b).size()); ++i) {
        if (first + i == j) diagonal_.push_back(static_cast<int>(rows.size()));
        rows.push_back(first + i);
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

const MatrixXd& StageMatrix::product(const Part& part, const StageOperator& op) {
  const MatrixXd& S = op.S(part.body);
  const MatrixXd& T = system_->tangent(part.element);
  const auto k = static_cast<Index>(part.rows.size());
  S_part_.resize(S.rows(), k);
  T_part_.resize(k, T.cols());
  for (Index i = 0; i < k; ++i) {
    S_part_.col(i) = S.col(part.body_rows[static_cast<size_t>(i)]);
    T_part_.row(i) = T.row(part.rows[static_cast<size_t>(i)]);
  }
  product_.noalias() = S_part_ * T_part_;
  return product_;
}

bool StageMatrix::form(const StageOperator& op) {
  if (system_->interface_size() == 0) return true;
  if (!sparse_) {
    dense_.setIdentity();
    for (const Part& part : parts_) {
      const MatrixXd& ST = product(part, op);
      const int first = first_[static_cast<size_t>(part.body)];
      for (Index j = 0; j < ST.cols(); ++j)
        dense_.col(part.columns[static_cast<size_t>(j)]).segment(first, ST.rows()) -= ST.col(j);
    }
    lu_.compute(dense_);
    return dense_.allFinite();
  }
  std::fill(values_.begin(), values_.end(), 0.0);
  for (const int at : diagonal_) values_[static_cast<size_t>(at)] = 1.0;
  for (const Part& part : parts_) {
    const MatrixXd& ST = product(part, op);
    for (Index j = 0; j < ST.cols(); ++j) {
      double* column = values_.data() + part.starts[static_cast<size_t>(j)];
      for (Index i = 0; i < ST.rows(); ++i) column[i] -= ST(i, j);
    }
  }
  return sparse_->factor(values_);
}

void StageMatrix::solve(VectorXd& x) const {
  for (size_t y = 0; y < position_.size(); ++y)
    ordered_(position_[y]) = x(static_cast<Index>(y));
  if (sparse_) {
    sparse_->solve(ordered_.data());
  } else if (ordered_.size() > 0) {
    solved_.noalias() = lu_.solve(ordered_);
    ordered_.swap(solved_);
  }
  for (size_t y = 0; y < position_.size(); ++y)
    x(static_cast<Index>(y)) = ordered_(position_[y]);
}

}  // namespace clatter::dynamics
