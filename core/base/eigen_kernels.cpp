// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/eigen_kernels.hpp"

namespace Eigen::internal {

template struct gebp_kernel<double, double, Index, ProductOut, ProductTraits::mr, ProductTraits::nr,
                            false, false>;
template struct gemm_pack_lhs<double, Index, ProductIn<ColMajor>, ProductTraits::mr,
                              ProductTraits::LhsProgress, ProductTraits::LhsPacket4Packing,
                              ColMajor>;
template struct gemm_pack_lhs<double, Index, ProductIn<RowMajor>, ProductTraits::mr,
                              ProductTraits::LhsProgress, ProductTraits::LhsPacket4Packing,
                              RowMajor>;
template struct gemm_pack_rhs<double, Index, ProductIn<ColMajor>, ProductTraits::nr, ColMajor>;
template struct general_matrix_vector_product<Index, double, ProductIn<ColMajor>, ColMajor, false,
                                              double, ProductIn<RowMajor>, false>;
template struct general_matrix_vector_product<Index, double, ProductIn<RowMajor>, RowMajor, false,
                                              double, ProductIn<ColMajor>, false>;
template struct general_matrix_vector_product<Index, double, ProductIn<RowMajor>, RowMajor, false,
                                              double, ProductIn<RowMajor>, false, 1>;

}  // namespace Eigen::internal
