// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Mid-side nodes of quadratic cells and their edges.
#include <span>
#include <string>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// The two corner nodes of the edge of each of `nodes`. InputError "where: ..." for the first that
/// is not a mid-side node.
std::vector<std::array<int32_t, 2>> ends_of_mid_side_nodes(const Mesh& mesh,
                                                           std::span<const int32_t> nodes,
                                                           const std::string& where);

}  // namespace clatter::mesh
