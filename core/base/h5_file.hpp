// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reads and writes one HDF5 file in terms of vectors and Eigen matrices.
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/matrix.hpp"

namespace clatter {

/// One HDF5 file. Paths inside the file are "group/dataset"; missing groups are created on writing.
/// Data is written to `path.part`; commit() renames it, and without commit() an older file stays
/// unchanged. Data, attributes and headers have HDF5 checksums, which are verified on reading;
/// files without checksums can be read too. Errors: FileError for failures of the disk or library,
/// InputError for invalid content; each names the file, the position in it, what was found and what
/// was expected.
class H5File {
 public:
  /// Opens a finished file for reading.
  static H5File open(const std::filesystem::path& path);
  /// Starts a new file that commit() renames to `path`.
  static H5File create(const std::filesystem::path& path);

  H5File(H5File&&) noexcept;
  H5File& operator=(H5File&&) noexcept;
  ~H5File();

  /// Flushes, closes and syncs `path.part`, which takes no more data then.
  void complete();
  /// Completes and renames `path.part` to `path`.
  void commit();
  /// The same with another final path in the same folder.
  void commit(const std::filesystem::path& final_path);
  const std::filesystem::path& path() const;

  bool has(std::string_view name) const;
  bool has_attribute(std::string_view object, std::string_view name) const;
  /// Names of the members of a group, sorted; empty when the group is absent.
  std::vector<std::string> list(std::string_view group) const;
  /// Dimensions of a dataset.
  std::vector<int64_t> shape(std::string_view name) const;

  void write(std::string_view name, const std::vector<double>& values);
  void write(std::string_view name, const std::vector<int32_t>& values);
  void write(std::string_view name, const std::vector<int64_t>& values);
  void write(std::string_view name, const std::vector<std::string>& values);
  void write(std::string_view name, const Eigen::VectorXd& values);
  /// Stored as (rows, columns) regardless of the storage order in memory.
  void write(std::string_view name, const Eigen::MatrixXd& values);
  void write(std::string_view name, const RowMatrix& values);
  void write(std::string_view name, const IndexMatrix& values);
  /// Single precision, for visualisation data.
  void write_float(std::string_view name, const std::vector<float>& values,
                   const std::vector<int64_t>& shape);
  /// A dataset of `shape` without values, of single or double precision, and complete rows of it
  /// from row `first` on, `count` values. Parts that begin and end at multiples of
  /// rows_of_a_chunk() are written without reading anything back. Every row must be written.
  void create(std::string_view name, const std::vector<int64_t>& shape, bool single);
  void write_part(std::string_view name, int64_t first, const float* values, int64_t count);
  void write_part(std::string_view name, int64_t first, const double* values, int64_t count);
  /// Rows of one chunk of a dataset of this shape; a multiple of it in single precision is one in
  /// double precision.
  static int64_t rows_of_a_chunk(const std::vector<int64_t>& shape, bool single);

  /// Has the kernel begin to write to disk what is in its cache of the unfinished file, without
  /// waiting: commit() then has less to wait for, while the next values are computed.
  void begin_disk_writes();

  /// While `single` is true, write() stores doubles in single precision.
  void store_single(bool single);

  /// Appends rows to a dataset that grows along its first dimension. The first call creates it, in
  /// chunks of its rows, at most 128 KiB: later calls of the same number of rows fill complete
  /// chunks. What was appended is on disk, apart from the library's metadata.
  void append(std::string_view name, const std::vector<double>& values);
  void append(std::string_view name, const RowMatrix& rows);
  /// Single precision; `shape`: rows, then the extents of each row.
  void append_float(std::string_view name, const std::vector<float>& values,
                    const std::vector<int64_t>& shape);

  /// Copies the members of the group `source` of another file, "/" for its root, into `group`, in
  /// the place of members of the same names.
  void copy(const H5File& from, std::string_view source, std::string_view group);

  std::vector<double> read_doubles(std::string_view name) const;
  std::vector<int32_t> read_ints(std::string_view name) const;
  std::vector<int64_t> read_longs(std::string_view name) const;
  std::vector<std::string> read_strings(std::string_view name) const;
  /// A list of arrays of bytes, each a text that ends at its first zero, without blanks at its end
  /// (names in files of MED).
  std::vector<std::string> read_byte_texts(std::string_view name) const;
  Eigen::VectorXd read_vector(std::string_view name) const;
  Eigen::MatrixXd read_matrix(std::string_view name) const;
  RowMatrix read_rows(std::string_view name) const;
  /// Rows [first, first + count) of a two-dimensional dataset.
  RowMatrix read_rows(std::string_view name, int64_t first, int64_t count) const;
  /// The same into `rows`, whose memory is reused where it fits.
  void read_rows(std::string_view name, int64_t first, int64_t count, RowMatrix& rows) const;
  IndexMatrix read_index_matrix(std::string_view name) const;

  /// Attributes; `object` is a group or dataset, "/" for the root. Missing groups are created. A
  /// string over 60 000 bytes is stored as the single entry of dataset `object/name`.
  void set(std::string_view object, std::string_view name, double value);
  void set(std::string_view object, std::string_view name, int64_t value);
  void set(std::string_view object, std::string_view name, int value) {
    set(object, name, static_cast<int64_t>(value));
  }
  void set(std::string_view object, std::string_view name, const std::vector<int64_t>& values);
  void set(std::string_view object, std::string_view name, const std::string& value);
  void set(std::string_view object, std::string_view name, const char* value) {
    set(object, name, std::string(value));
  }
  double get_double(std::string_view object, std::string_view name) const;
  int64_t get_int(std::string_view object, std::string_view name) const;
  /// A list of integers, at least one.
  std::vector<int64_t> get_ints(std::string_view object, std::string_view name) const;
  std::string get_string(std::string_view object, std::string_view name) const;
  /// Names of all attributes of an object, sorted.
  std::vector<std::string> attributes(std::string_view object) const;

 private:
  struct Impl;
  explicit H5File(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace clatter
