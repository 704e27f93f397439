// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/dense_product.hpp"

#include <cblas.h>

namespace clatter::sparse {
namespace {

int stride(Eigen::Index value) { return static_cast<int>(value > 0 ? value : 1); }

}  // namespace

Eigen::MatrixXd transposed_product(const DenseView& A, const DenseView& B) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(A.cols(), B.cols());
  if (C.size() == 0 || A.rows() == 0) return C;
  cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, blas_size(A.cols()), blas_size(B.cols()),
              blas_size(A.rows()), 1.0, A.data(), stride(A.outerStride()), B.data(),
              stride(B.outerStride()), 0.0, C.data(), stride(C.outerStride()));
  return C;
}

Eigen::MatrixXd transposed_rows_product(const DenseView& A, const RowMatrix& B) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(A.cols(), B.cols());
  if (C.size() == 0 || A.rows() == 0) return C;
  cblas_dgemm(CblasColMajor, CblasTrans, CblasTrans, blas_size(A.cols()), blas_size(B.cols()),
              blas_size(A.rows()), 1.0, A.data(), stride(A.outerStride()), B.data(),
              stride(B.outerStride()), 0.0, C.data(), stride(C.outerStride()));
  return C;
}

void add_product(double factor, const DenseView& A, const DenseView& B, DenseOut C) {
  if (C.size() == 0 || A.cols() == 0) return;
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, blas_size(A.rows()), blas_size(B.cols()),
              blas_size(A.cols()), factor, A.data(), stride(A.outerStride()), B.data(),
              stride(B.outerStride()), 1.0, C.data(), stride(C.outerStride()));
}

}  // namespace clatter::sparse
