// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced coordinates of a piece of a run.
#include <algorithm>
#include <optional>
#include <string>

#include "recover/options/piece.hpp"
#include "recover/run/run_input.hpp"

namespace clatter::recover {

/// "q" [m], "v" [m/s] or "a" [m/s2] of values `offset` to `offset` + `count` of a piece, count x r:
/// samples of the run, or over the angle values between them (resample.hpp). A negative offset is
/// before the piece. Nothing when the run does not cover them.
std::optional<RowMatrix> piece_samples(const RunBody& body, const Piece& piece,
                                       const std::string& quantity, int64_t offset, int64_t count);

/// All values of a piece, which the run covers.
RowMatrix piece_samples(const RunBody& body, const Piece& piece, const std::string& quantity);

/// Rows of a block of so many coordinates: 16 MiB, at least 64. A multiple of four: products with a
/// block then round as those with all rows.
inline int64_t block_rows(int64_t coordinates) {
  constexpr int64_t kNumbers = int64_t{1} << 21;
  return std::max<int64_t>(64, kNumbers / std::max<int64_t>(coordinates, 1) / 4 * 4);
}

/// The same block by block: use(first value of the block, its values).
template <class Use>
void for_each_block(const RunBody& body, const Piece& piece, const std::string& quantity,
                    int64_t coordinates, const Use& use) {
  const int64_t rows = block_rows(coordinates);
  for (int64_t first = 0; first < piece.count; first += rows)
    use(first,
        piece_samples(body, piece, quantity, first, std::min(rows, piece.count - first)).value());
}

}  // namespace clatter::recover
