// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/field/expand.hpp"

#include <algorithm>

#include "core/base/threads.hpp"

namespace clatter::recover {

void expand(const rom::SkinRows& T, const Eigen::MatrixXd& reduced, const ExpansionBlock& block,
            const ExpansionSink& sink) {
  if (reduced.cols() == 0) return;
  RowMatrix buffer;
  Eigen::MatrixXd u;
  for (int64_t row = 0; row < T.rows(); row += block.rows) {
    const int64_t height = std::min<int64_t>(block.rows, T.rows() - row);
    const auto rows = T.read(row, height, buffer);
    for (int64_t column = 0; column < reduced.cols(); column += block.columns) {
      const int64_t width = std::min<int64_t>(block.columns, reduced.cols() - column);
      u.resize(height, width);
      parallel_pieces(height, [&](int64_t begin, int64_t end) {
        u.middleRows(begin, end - begin).noalias() =
            rows.middleRows(begin, end - begin) * reduced.middleCols(column, width);
      });
      sink(row, column, u);
    }
  }
}

ExpansionBlock expansion_block(const rom::SkinRows& T, int64_t multiple) {
  constexpr int64_t kRowsOfT = int64_t{32} << 20, kExpanded = int64_t{8} << 20;  // doubles
  ExpansionBlock block{std::max<int64_t>(T.rows(), 1), 0};
  if (!T.in_memory())
    block.rows =
        std::max<int64_t>(kRowsOfT / std::max<int64_t>(T.cols(), 1) / multiple, 1) * multiple;
  block.columns = std::clamp<int64_t>(kExpanded / std::min<int64_t>(block.rows, T.rows()), 1, 256);
  return block;
}

}  // namespace clatter::recover
