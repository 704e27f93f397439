// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/sparse.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/base/error.hpp"

namespace clatter {

void write_sparse(H5File& file, std::string_view name, const SparseMatrix& matrix, bool lower) {
  const std::string group(name);
  const SparseMatrix* source = &matrix;
  SparseMatrix compressed;
  if (!matrix.isCompressed()) {
    compressed = matrix;
    compressed.makeCompressed();
    source = &compressed;
  }
  const auto count = source->nonZeros();
  file.write(group + "/data", std::vector<double>(source->valuePtr(), source->valuePtr() + count));
  file.write(group + "/indices",
             std::vector<int32_t>(source->innerIndexPtr(), source->innerIndexPtr() + count));
  file.write(group + "/indptr",
             std::vector<int32_t>(source->outerIndexPtr(),
                                  source->outerIndexPtr() + source->outerSize() + 1));
  file.set(group, "format", "csc");
  file.set(group, "shape", std::vector<int64_t>{source->rows(), source->cols()});
  file.set(group, "symmetric", lower ? "lower" : "no");
}

SparseMatrix read_sparse(const H5File& file, std::string_view name) {
  const std::string group(name);
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}: {}", file.path().string(), group, what));
  };
  const std::vector<int64_t> shape = file.get_ints(group, "shape");
  if (shape.size() != 2) fail(fmt::format("shape has {} numbers, expected 2", shape.size()));
  const int64_t rows = shape[0], columns = shape[1];
  const bool lower = file.get_string(group, "symmetric") == "lower";
  const auto data = file.read_doubles(group + "/data");
  const auto indices = file.read_ints(group + "/indices");
  const auto indptr = file.read_ints(group + "/indptr");
  if (rows < 0 || columns < 0 || static_cast<int64_t>(indptr.size()) != columns + 1) {
    fail(fmt::format("indptr has {} entries, expected {}", indptr.size(), columns + 1));
  }
  if (data.size() != indices.size() || indptr.front() != 0 ||
      indptr.back() != static_cast<int64_t>(data.size())) {
    fail(fmt::format("data has {} and indices {} entries, indptr ends at {}", data.size(),
                     indices.size(), indptr.back()));
  }
  for (int64_t j = 0; j < columns; ++j) {
    if (indptr[j + 1] < indptr[j]) fail(fmt::format("indptr falls at column {}", j));
    for (int32_t k = indptr[j]; k < indptr[j + 1]; ++k) {
      const bool sorted = k == indptr[j] || indices[k] > indices[k - 1];
      if (indices[k] < (lower ? j : 0) || indices[k] >= rows || !sorted) {
        fail(fmt::format("column {} has row index {}, expected ascending within {} to {}", j,
                         indices[k], lower ? j : 0, rows - 1));
      }
      if (!std::isfinite(data[k])) fail(fmt::format("column {} holds {}", j, data[k]));
    }
  }
  return Eigen::Map<const SparseMatrix>(rows, columns, static_cast<Eigen::Index>(data.size()),
                                        indptr.data(), indices.data(), data.data());
}

Eigen::MatrixXd multiply_symmetric(const SparseMatrix& lower, const Eigen::MatrixXd& x) {
  return lower.selfadjointView<Eigen::Lower>() * x;
}

Eigen::MatrixXd magnitude_product(const SparseMatrix& lower, const Eigen::MatrixXd& x) {
  const Eigen::MatrixXd size = x.cwiseAbs();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size.rows(), size.cols());
  for (int j = 0; j < lower.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      const double value = std::abs(it.value());
      out.row(it.row()) += value * size.row(j);
      if (it.row() != j) out.row(j) += value * size.row(it.row());
    }
  return out;
}

}  // namespace clatter
