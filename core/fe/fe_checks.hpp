// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Errors and checks for FE model files: "file: dataset: found X, expected Y".
#include <fmt/format.h>

#include <Eigen/Core>
#include <string>

#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"

namespace clatter::fe {

[[noreturn]] inline void refuse(const H5File& file, const std::string& name,
                                const std::string& found, const std::string& expected) {
  throw InputError(
      fmt::format("{}: {}: found {}, expected {}", file.path().string(), name, found, expected));
}

/// Dense or sparse.
template <typename Matrix>
void check_shape(const H5File& file, const std::string& name, const Matrix& matrix,
                 Eigen::Index rows, Eigen::Index cols) {
  if (matrix.rows() != rows || matrix.cols() != cols)
    refuse(file, name, fmt::format("{} x {}", matrix.rows(), matrix.cols()),
           fmt::format("{} x {}", rows, cols));
}

template <typename Matrix>
void check_finite(const H5File& file, const std::string& name, const Matrix& values) {
  if (!values.allFinite()) refuse(file, name, "a value that is not finite", "finite numbers");
}

}  // namespace clatter::fe
