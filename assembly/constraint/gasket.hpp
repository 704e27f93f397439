// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Gaskets: elastic layers between two surfaces that need not match.
//
// With d = u_slave - P u_master, the motion of the slave side beyond that of a tie (mortar.hpp),
//   K = int N^T (k_t I + (k_n - k_t) n n^T) N dA  on d,
// n the normal and k_n, k_t [N/m3] the stiffnesses per area of the layer. Rigid motions have no d,
// across gaps too. The layer closes by n . d.
#include <vector>

#include "assembly/constraint/part_data.hpp"
#include "core/base/sparse.hpp"
#include "core/fe/fe_gasket.hpp"

namespace clatter::assembly {

/// Of all gaskets on all ids, lower triangles.
struct GasketStiffness {
  SparseMatrix K;                    // [N/m]
  SparseMatrix loss;                 // K times the loss factors; 0 x 0 where no gasket has one
  std::vector<fe::FeGasket> curves;  // gaskets with curves; `closing` is on all ids
};

/// Faces of a slave with a node that faces no master are left out; says the area that is left.
/// InputError when there is none, and when the points that were pressed are not those of the faces.
GasketStiffness gasket_stiffness(const PartData& part);

}  // namespace clatter::assembly
