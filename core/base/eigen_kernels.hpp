// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The kernels of Eigen's products of dense matrices of doubles are compiled once, in
// eigen_kernels.cpp, and not in each unit that multiplies: they take seconds. This header is
// precompiled; a unit without it has kernels of its own.
#include <Eigen/Core>

namespace Eigen::internal {

using ProductTraits = gebp_traits<double, double>;
using ProductOut = blas_data_mapper<double, Index, ColMajor, Unaligned, 1>;
template <int kOrder>
using ProductIn = const_blas_data_mapper<double, Index, kOrder>;

extern template struct gebp_kernel<double, double, Index, ProductOut, ProductTraits::mr,
                                   ProductTraits::nr, false, false>;
extern template struct gemm_pack_lhs<double, Index, ProductIn<ColMajor>, ProductTraits::mr,
                                     ProductTraits::LhsProgress, ProductTraits::LhsPacket4Packing,
                                     ColMajor>;
extern template struct gemm_pack_lhs<double, Index, ProductIn<RowMajor>, ProductTraits::mr,
                                     ProductTraits::LhsProgress, ProductTraits::LhsPacket4Packing,
                                     RowMajor>;
extern template struct gemm_pack_rhs<double, Index, ProductIn<ColMajor>, ProductTraits::nr,
                                     ColMajor>;
extern template struct general_matrix_vector_product<Index, double, ProductIn<ColMajor>, ColMajor,
                                                     false, double, ProductIn<RowMajor>, false>;
extern template struct general_matrix_vector_product<Index, double, ProductIn<RowMajor>, RowMajor,
                                                     false, double, ProductIn<ColMajor>, false>;
extern template struct general_matrix_vector_product<Index, double, ProductIn<RowMajor>, RowMajor,
                                                     false, double, ProductIn<RowMajor>, false, 1>;

}  // namespace Eigen::internal
