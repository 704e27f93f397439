// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Fields of some instants, which go to the run file block by block.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/base/matrix.hpp"

namespace clatter::dynamics {

/// Each field is a dataset, instants x rows x columns or instants x entries, in single precision.
/// What is held in memory does not grow with the number of instants.
class FieldStream {
 public:
  /// `file` outlives the stream.
  explicit FieldStream(H5File& file) : file_(&file) {}
  /// A field at one more instant, of the same size each time; an empty one is left out.
  void add(const std::string& name, const RowMatrix& frame);
  void add(const std::string& name, const Eigen::VectorXd& frame);
  /// Writes what is held, at the end or before.
  void finish();
  /// Numbers in memory.
  int64_t held() const;

 private:
  struct Field {
    std::vector<float> values;   // instants x cells
    std::vector<int64_t> shape;  // of an instant
    int64_t cells = 0;
  };
  void add(const std::string& name, const double* values, const std::vector<int64_t>& shape);
  void flush(const std::string& name, Field& field);
  H5File* file_;
  std::map<std::string, Field> fields_;  // by dataset
};

}  // namespace clatter::dynamics
