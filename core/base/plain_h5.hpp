// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// HDF5 files in the layouts of other programs: their types, no filters, no clatter metadata.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace clatter {

/// Writes to `path.part`; commit() syncs and renames it; without commit() it is removed. Missing
/// groups are created. FileError when writing fails.
class PlainH5 {
 public:
  explicit PlainH5(const std::filesystem::path& path);
  ~PlainH5();
  PlainH5(const PlainH5&) = delete;
  PlainH5& operator=(const PlainH5&) = delete;

  void group(const std::string& name);
  /// Lists: 64-bit floats, 32-bit integers.
  void write(const std::string& name, const std::vector<double>& values);
  void write(const std::string& name, const std::vector<int32_t>& values);
  /// Strings of `length` bytes each, padded with zeros.
  void write_fixed(const std::string& name, const std::vector<std::string>& texts, size_t length);
  /// Scalar attributes; a string is null-terminated with its own length.
  void set(const std::string& object, const std::string& name, int32_t value);
  void set(const std::string& object, const std::string& name, double value);
  void set(const std::string& object, const std::string& name, const std::string& text);
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clatter
