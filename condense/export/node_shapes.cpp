// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/node_shapes.hpp"

#include <fmt/format.h>

#include <map>

#include "core/base/error.hpp"

namespace clatter::condense {

using Kind = rom::MappedDof::Kind;

std::vector<NodeShape> node_shapes(const ExportedPart& part, const PencilModes& modes) {
  std::map<int, NodeShape> by_number;
  for (size_t j = 0; j < part.map.size(); ++j) {
    const rom::MappedDof& dof = part.map[j];
    if (dof.kind == Kind::kModal) continue;
    NodeShape& node = by_number[dof.node];
    if (node.number == 0)
      node = {dof.node, dof.position, Eigen::MatrixXd::Zero(6, modes.Phi.cols())};
    node.shape.middleRows<3>(dof.kind == Kind::kRotation ? 3 : 0) +=
        dof.direction * modes.Phi.row(static_cast<Eigen::Index>(j));
  }
  if (by_number.empty())
    throw InputError(fmt::format(
        "{}: found no boundary coordinate with a position, expected one or more", part.model.name));
  std::vector<NodeShape> nodes;
  for (auto& [number, node] : by_number) nodes.push_back(std::move(node));
  return nodes;
}

}  // namespace clatter::condense
