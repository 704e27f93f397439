// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// NumPy's file format (numpy.lib.format, version 1.0): arrays in C order, little-endian.
#include <Eigen/Core>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace clatter::condense {

/// Writes arrays one after the other, as repeated numpy.save does; repeated numpy.load reads them.
class NpyWriter {
 public:
  explicit NpyWriter(std::ostream& out) : out_(out) {}

  void put(double value);                   // shape ()
  void put(const Eigen::VectorXd& values);  // shape (n,)
  void put(const Eigen::MatrixXd& values);  // shape (rows, columns)
  void put(const std::vector<int64_t>& values, const std::vector<int64_t>& shape);
  void put(const std::string& ascii);  // shape ()
  void put_no_text();                  // an array of no strings

 private:
  void head(const std::string& type, const std::vector<int64_t>& shape);
  void raw(const void* data, size_t size);

  std::ostream& out_;
};

}  // namespace clatter::condense
