// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/field/expand.hpp"

#include <algorithm>

#include "core/base/threads.hpp"

namespace clatter::recover {

void expand(const RowMatrix& T, const Eigen::MatrixXd& reduced, int64_t block,
            const ExpansionSink& sink) {
  Eigen::MatrixXd u;
  for (int64_t first = 0; first < reduced.cols(); first += block) {
    const int64_t count = std::min(block, reduced.cols() - first);
    u.resize(T.rows(), count);
    parallel_pieces(T.rows(), [&](int64_t begin, int64_t end) {
      u.middleRows(begin, end - begin).noalias() =
          T.middleRows(begin, end - begin) * reduced.middleCols(first, count);
    });
    sink(first, u);
  }
}

int64_t expansion_block(int64_t rows) {
  constexpr int64_t kDoubles = int64_t{8} << 20;
  return std::clamp<int64_t>(kDoubles / std::max<int64_t>(rows, 1), 1, 64);
}

}  // namespace clatter::recover
