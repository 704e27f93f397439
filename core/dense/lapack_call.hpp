// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the calls of LAPACK have in common. For the sources of this folder only.
#include <lapack.h>

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

namespace clatter::dense {

/// Rows or columns as LAPACK takes them; a dense matrix has fewer than 2^31 of either.
inline int lapack_size(Eigen::Index value) { return static_cast<int>(value); }

/// The leading dimension of a matrix with `rows` rows.
inline int stride(Eigen::Index rows) { return lapack_size(std::max<Eigen::Index>(rows, 1)); }

/// The answer where there is none.
inline Eigen::MatrixXd no_answer(Eigen::Index rows, Eigen::Index cols) {
  return Eigen::MatrixXd::Constant(rows, cols, std::numeric_limits<double>::quiet_NaN());
}

/// Calls `routine(work, lwork)` for the size of the workspace, then for the result.
template <class Routine>
void with_workspace(Routine&& routine) {
  double best = 0.0;
  const int query = -1;
  routine(&best, &query);
  const int room = std::max(1, static_cast<int>(best));
  std::vector<double> work(static_cast<size_t>(room));
  routine(work.data(), &room);
}

/// The same with integers: `routine(work, lwork, iwork, liwork)`.
template <class Routine>
void with_workspaces(Routine&& routine) {
  double best = 0.0;
  int best_integers = 0;
  const int query = -1;
  routine(&best, &query, &best_integers, &query);
  const int room = std::max(1, static_cast<int>(best));
  best_integers = std::max(1, best_integers);
  std::vector<double> work(static_cast<size_t>(room));
  std::vector<int> integers(static_cast<size_t>(best_integers));
  routine(work.data(), &room, integers.data(), &best_integers);
}

}  // namespace clatter::dense
