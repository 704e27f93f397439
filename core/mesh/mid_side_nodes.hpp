#pragma once
// Middle nodes of quadratic cells and the edges that they stand on.
#include <span>
#include <string>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// The two corner nodes of the edge that each of `nodes` is the middle of. InputError "where: ..."
/// for the first that is no middle node.
std::vector<std::array<int32_t, 2>> ends_of_mid_side_nodes(const Mesh& mesh,
                                                           std::span<const int32_t> nodes,
                                                           const std::string& where);

}  // namespace clatter::mesh
