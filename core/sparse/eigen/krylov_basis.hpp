// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A tall row-major basis, and the products that block Krylov methods need.
#include <Eigen/Core>
#include <memory>

namespace clatter::sparse {

/// `count` row-major vectors, size x count, each row aligned.
struct TallBlock {
  std::unique_ptr<double[]> data;
  Eigen::Index size = 0;
  Eigen::Index count = 0;

  TallBlock(Eigen::Index rows, Eigen::Index columns);
  double* row(Eigen::Index i) { return data.get() + i * count; }
  const double* row(Eigen::Index i) const { return data.get() + i * count; }
  bool finite() const;
};

/// A^T B, count x count; tiles of rows on all threads, summed in fixed order.
Eigen::MatrixXd gram(const TallBlock& A, const TallBlock& B);

/// A <- A R in place; R is count x count.
void transform(TallBlock& A, const Eigen::MatrixXd& R);

/// Storage of a basis.
enum class Storage { kMemory, kDisk };

/// n x room, row-major, in large pages or spilled to disk; the first columns are in use.
class KrylovBasis {
 public:
  KrylovBasis(Eigen::Index size, Eigen::Index room, Storage storage = Storage::kMemory);
  /// Columns [first, last)^T B, (last - first) x count; count must be a multiple of kLanes, here
  /// and below.
  Eigen::MatrixXd coefficients(Eigen::Index first, Eigen::Index last, const TallBlock& B) const;
  /// B -= columns [first, first + H.rows()) H.
  void subtract(Eigen::Index first, const Eigen::MatrixXd& H, TallBlock& B) const;
  /// Columns [first, first + B.count) = B, and the reverse.
  void put(Eigen::Index first, const TallBlock& B);
  void get(Eigen::Index first, TallBlock& B) const;
  /// Columns [0, S.cols()) = columns [0, S.rows()) S, in place.
  void transform(const Eigen::MatrixXd& S);
  /// The first `count` columns as a matrix; the memory of the basis is released row by row.
  Eigen::MatrixXd take_columns(Eigen::Index count);

 private:
  template <class Body>
  void over_tiles(Eigen::Index begin, Eigen::Index end, Eigen::Index first, Eigen::Index last,
                  Body&& body) const;
  double* at(Eigen::Index row, Eigen::Index column) const {
    return data_.get() + row * room_ + column;
  }
  Eigen::Index size_, room_;
  std::shared_ptr<double[]> data_;
};

}  // namespace clatter::sparse
