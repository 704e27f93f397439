// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rows of T_skin, in memory or block by block from the file of the reduced model, so that a skin
// that does not fit into memory can be expanded.
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/base/matrix.hpp"

namespace clatter::rom {

/// The rows of u_skin = T q, 3 n_s x r; row 3 a + d: node a, direction d.
class SkinRows {
 public:
  /// Up to this size T is read once and kept [bytes].
  static constexpr int64_t kKept = int64_t{1} << 30;

  /// Rows in memory; `T` must outlive this object.
  explicit SkinRows(const RowMatrix& T) : rows_(T.rows()), columns_(T.cols()), kept_(&T) {}
  /// Rows `skin/T` of a reduced model, kept in memory when they have at most `keep` bytes.
  /// @throws InputError when the file has none
  explicit SkinRows(const std::filesystem::path& rom, int64_t keep = kKept);
  SkinRows(const SkinRows&) = delete;
  SkinRows& operator=(const SkinRows&) = delete;

  Eigen::Index rows() const { return rows_; }
  Eigen::Index cols() const { return columns_; }
  bool in_memory() const { return kept_ != nullptr; }

  /// Rows [first, first + count), count x r: a view of T, or of `buffer`, into which they are read.
  /// @throws InputError for a damaged file or a value that is not finite
  Eigen::Map<const RowMatrix> read(Eigen::Index first, Eigen::Index count, RowMatrix& buffer) const;

  /// The three rows of each of `nodes` (ascending), 3 n x r. Neighbours in the file are read
  /// together.
  RowMatrix of_nodes(const std::vector<int32_t>& nodes) const;

 private:
  Eigen::Index rows_ = 0, columns_ = 0;
  std::optional<H5File> file_;
  RowMatrix stored_;
  const RowMatrix* kept_ = nullptr;
};

}  // namespace clatter::rom
