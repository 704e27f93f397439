// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/sparse_stage.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace clatter::dynamics {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Clusters of more rows have their forces as unknowns: below, their product with T is as sparse.
constexpr int kWide = 8;

/// The rows of P that share a mode with others, directly or through others, together.
std::vector<std::vector<int>> coupled_rows(const MatrixXd& P) {
  const auto n = static_cast<size_t>(P.rows());
  std::vector<size_t> label(n);
  std::iota(label.begin(), label.end(), size_t{0});
  for (Index mode = 0; mode < P.cols(); ++mode) {
    size_t first = n;
    for (size_t i = 0; i < n; ++i) {
      if (P(static_cast<Index>(i), mode) == 0.0) continue;
      if (first == n) first = i;
      const size_t from = std::max(label[i], label[first]), to = std::min(label[i], label[first]);
      std::replace(label.begin(), label.end(), from, to);
    }
  }
  std::map<size_t, std::vector<int>> rows;
  for (size_t i = 0; i < n; ++i) rows[label[i]].push_back(static_cast<int>(i));
  std::vector<std::vector<int>> clusters;
  for (auto& entry : rows) clusters.push_back(std::move(entry.second));
  return clusters;
}

}  // namespace

SparseStage::SparseStage(const System& system) : system_(&system) {
  find_clusters();
  find_parts();
  find_pattern();
}

void SparseStage::find_clusters() {
  const auto n_y = static_cast<size_t>(system_->interface_size());
  cluster_.resize(n_y);
  position_.resize(n_y);
  for (int b = 0; b < static_cast<int>(system_->bodies().size()); ++b) {
    for (std::vector<int>& rows : coupled_rows(system_->P(b))) {
      Cluster cluster;
      cluster.body = b;
      cluster.first = unknowns_;
      for (const int row : rows) {
        const auto y = static_cast<size_t>(system_->rows(b)[static_cast<size_t>(row)]);
        cluster_[y] = static_cast<int>(clusters_.size());
        position_[y] = unknowns_++;
      }
      cluster.rows = std::move(rows);
      clusters_.push_back(std::move(cluster));
    }
  }
  for (Cluster& cluster : clusters_) {
    if (static_cast<int>(cluster.rows.size()) <= kWide) continue;
    cluster.forces = unknowns_;
    unknowns_ += static_cast<int>(cluster.rows.size());
  }
}

void SparseStage::find_parts() {
  for (int e = 0; e < system_->elements(); ++e) {
    const auto& groups = system_->groups(e);
    for (size_t g = 0; g < groups.size(); ++g) {
      std::map<int, Part> by_cluster;
      std::vector<int> columns;
      for (size_t i = 0; i < groups[g].size(); ++i) {
        const auto y = static_cast<size_t>(groups[g][i]);
        columns.push_back(position_[y]);
        Part& part = by_cluster[cluster_[y]];
        part.rows.push_back(static_cast<int>(i));
        part.cluster_rows.push_back(position_[y] -
                                    clusters_[static_cast<size_t>(cluster_[y])].first);
      }
      for (auto& [cluster, part] : by_cluster) {
        part.element = e;
        part.group = static_cast<int>(g);
        part.cluster = cluster;
        part.columns = columns;
        parts_.push_back(std::move(part));
      }
    }
  }
}

void SparseStage::find_pattern() {
  const auto n = static_cast<size_t>(unknowns_);
  std::vector<std::vector<int>> rows_of(n);  // per column
  const auto add = [&](int column, int first, size_t count) {
    for (size_t i = 0; i < count; ++i)
      rows_of[static_cast<size_t>(column)].push_back(first + static_cast<int>(i));
  };
  for (int j = 0; j < unknowns_; ++j) add(j, j, 1);
  for (const Cluster& cluster : clusters_)
    for (size_t k = 0; cluster.forces >= 0 && k < cluster.rows.size(); ++k)
      add(cluster.forces + static_cast<int>(k), cluster.first, cluster.rows.size());
  for (const Part& part : parts_) {
    const Cluster& cluster = clusters_[static_cast<size_t>(part.cluster)];
    for (const int column : part.columns) {
      if (cluster.forces < 0) add(column, cluster.first, cluster.rows.size());
      for (size_t i = 0; cluster.forces >= 0 && i < part.rows.size(); ++i)
        add(column, cluster.forces + part.cluster_rows[i], 1);
    }
  }
  starts_ = {0};
  for (std::vector<int>& column : rows_of) {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    rows_.insert(rows_.end(), column.begin(), column.end());
    starts_.push_back(static_cast<int>(rows_.size()));
  }
  const auto place = [&](int column, int row) {
    const auto begin = rows_.begin() + starts_[static_cast<size_t>(column)],
               end = rows_.begin() + starts_[static_cast<size_t>(column) + 1];
    return static_cast<int>(std::lower_bound(begin, end, row) - rows_.begin());
  };
  for (int j = 0; j < unknowns_; ++j) diagonal_.push_back(place(j, j));
  for (Cluster& cluster : clusters_)
    for (size_t k = 0; cluster.forces >= 0 && k < cluster.rows.size(); ++k)
      cluster.S_places.push_back(place(cluster.forces + static_cast<int>(k), cluster.first));
  for (Part& part : parts_) {
    const Cluster& cluster = clusters_[static_cast<size_t>(part.cluster)];
    for (const int column : part.columns) {
      if (cluster.forces < 0) part.places.push_back(place(column, cluster.first));
      for (size_t i = 0; cluster.forces >= 0 && i < part.rows.size(); ++i)
        part.places.push_back(place(column, cluster.forces + part.cluster_rows[i]));
    }
  }
  values_.resize(rows_.size());
  right_.resize(n);
}

void SparseStage::form_S(const StageOperator& op) {
  if (kappa_ == op.kappa()) return;
  kappa_ = op.kappa();
  for (Cluster& cluster : clusters_) op.form_S(cluster.body, cluster.rows, cluster.S);
}

void SparseStage::add_part(const Part& part, const MatrixXd& T) {
  const Cluster& cluster = clusters_[static_cast<size_t>(part.cluster)];
  const MatrixXd& S = cluster.S;
  const int* place = part.places.data();
  const auto rows = part.rows.size();
  for (Index j = 0; j < T.cols(); ++j) {
    if (cluster.forces >= 0) {
      for (size_t i = 0; i < rows; ++i, ++place)
        values_[static_cast<size_t>(*place)] -=
            S(part.cluster_rows[i], part.cluster_rows[i]) * T(part.rows[i], j);
      continue;
    }
    double* column = values_.data() + *place++;
    for (size_t i = 0; i < rows; ++i) {
      const double t = T(part.rows[i], j);
      if (t == 0.0) continue;
      const double* column_of_S = S.col(part.cluster_rows[i]).data();
      for (Index r = 0; r < S.rows(); ++r) column[r] -= t * column_of_S[r];
    }
  }
}

/// -S D^-1 of the wide clusters.
void SparseStage::add_S() {
  for (const Cluster& cluster : clusters_) {
    for (size_t k = 0; k < cluster.S_places.size(); ++k) {
      const auto column = cluster.S.col(static_cast<Index>(k));
      const double size = column(static_cast<Index>(k));
      double* values = values_.data() + cluster.S_places[k];
      for (Index r = 0; size > 0.0 && r < column.size(); ++r) values[r] = -column(r) / size;
    }
  }
}

const MatrixXd& SparseStage::entire_tangent(int element) {
  const MatrixXd& T = system_->response(element).tangent;
  const std::vector<int>& touched = system_->tangent_rows(element);
  if (touched.empty()) return T;
  const auto n = static_cast<Index>(system_->groups(element).front().size());
  entire_.setZero(n, n);
  for (size_t j = 0; j < touched.size(); ++j)
    for (size_t i = 0; i < touched.size(); ++i)
      entire_(touched[i], touched[j]) = T(static_cast<Index>(i), static_cast<Index>(j));
  return entire_;
}

bool SparseStage::form(const StageOperator& op) {
  form_S(op);
  std::fill(values_.begin(), values_.end(), 0.0);
  for (const int at : diagonal_) values_[static_cast<size_t>(at)] = 1.0;
  add_S();
  for (const Part& part : parts_) {
    if (!system_->has_groups(part.element)) {
      add_part(part, entire_tangent(part.element));
      continue;
    }
    const TangentBlock& block =
        system_->response(part.element).blocks[static_cast<size_t>(part.group)];
    if (block.active) add_part(part, block.values);
  }
  if (!lu_) lu_.emplace(starts_, rows_);
  return lu_->factor(values_);
}

void SparseStage::solve(VectorXd& x) const {
  std::fill(right_.begin(), right_.end(), 0.0);
  for (size_t y = 0; y < position_.size(); ++y)
    right_[static_cast<size_t>(position_[y])] = x(static_cast<Index>(y));
  lu_->solve(right_.data());
  for (size_t y = 0; y < position_.size(); ++y)
    x(static_cast<Index>(y)) = right_[static_cast<size_t>(position_[y])];
}

}  // namespace clatter::dynamics
