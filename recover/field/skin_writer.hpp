// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Expands reduced coordinates and writes them as fields of the skin, neither held entirely.
#include <Eigen/SparseCore>
#include <functional>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "recover/field/expand.hpp"
#include "recover/skin/skin.hpp"

namespace clatter::recover {

/// Datasets of one column of an expansion; an empty name is not written.
struct SkinDatasets {
  std::string vectors{};  // n_s x 3: the motion of the nodes
  std::string normals{};  // n_f: its mean normal component on each triangle
};

class SkinWriter {
 public:
  /// Receives the number of columns written since the last call.
  using Report = std::function<void(double columns)>;

  /// @param T rows of the skin, which must outlive this object
  /// @param face_normal n_f x 3 n_s
  SkinWriter(const rom::SkinRows& T, const SparseRows& face_normal);

  /// Columns of one call of `write`: as many as leave their reduced coordinates, and with normal
  /// components these, within 256 MB each. T is read once per call.
  int64_t columns_at_once(bool with_normals) const;

  /// Expands each column of `reduced` (r x m, m at most columns_at_once()) into the datasets of
  /// its entry of `columns` (m), in single or double precision. Each row of T is read once.
  void write(H5File& file, const Eigen::MatrixXd& reduced, const std::vector<SkinDatasets>& columns,
             bool single, const Report& report = {}) const;

 private:
  using SparseColumns = Eigen::SparseMatrix<double, Eigen::ColMajor, int32_t>;

  const rom::SkinRows& T_;
  SparseColumns face_normal_;
};

}  // namespace clatter::recover
