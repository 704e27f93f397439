// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Columns of numbers that go to the datasets of a group, block by block.
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"

namespace clatter::dynamics {

/// Each column is a dataset `group/name` with attribute `unit`. A block of kRows rows is held and
/// written when it is complete; finish() writes the rest.
class ColumnStream {
 public:
  static constexpr size_t kRows = 16384;  // 128 KiB a column, a chunk of the file

  /// `file` outlives the stream.
  ColumnStream(H5File& file, std::string group) : file_(file), group_(std::move(group)) {}
  /// Before the first row.
  void add_column(const std::string& name, const std::string& unit);
  size_t columns() const { return names_.size(); }
  /// One number for each column.
  void add(const std::vector<double>& row);
  /// Writes what is held, at the end or before; columns without any row become empty datasets.
  void finish();

  int64_t rows() const { return rows_; }  // so far
  /// Numbers in memory.
  int64_t held() const;

 private:
  void flush();
  H5File& file_;
  std::string group_;
  std::vector<std::string> names_, units_;
  std::vector<std::vector<double>> values_;  // of the block, one per column
  int64_t rows_ = 0;
};

}  // namespace clatter::dynamics
