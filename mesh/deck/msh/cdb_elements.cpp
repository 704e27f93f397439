// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/cdb_elements.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace clatter::mesh {
namespace {

std::span<const int> order_of(CellType type) {
  const CellTraits& cell = traits(type);
  return cell.to_abaqus.empty() ? cell.to_nastran : cell.to_abaqus;
}

}  // namespace

bool is_cdb_solid(int routine) {
  constexpr std::array kSolids = {45, 92, 95, 185, 186, 187};
  return std::find(kSolids.begin(), kSolids.end(), routine) != kSolids.end();
}

std::optional<CdbCell> cdb_cell(int routine, const std::vector<size_t>& nodes) {
  const CellType type = routine == 92 || routine == 187   ? CellType::kTet10
                        : routine == 45 || routine == 185 ? CellType::kHex8
                                                          : CellType::kHex20;
  const auto order = order_of(type);
  if (nodes.size() != order.size() || std::count(nodes.begin(), nodes.end(), 0U) > 0)
    return std::nullopt;
  CdbCell cell{type, nodes};
  for (size_t i = 0; i < nodes.size(); ++i) cell.nodes[order[i]] = nodes[i];
  return cell;
}

deck::Formulation cdb_formulation(int routine, int keyopt2, CellType type) {
  using deck::Formulation;
  if (type == CellType::kHex8) {
    if (routine == 45 || keyopt2 >= 2) return Formulation::kIncompatible;
    return keyopt2 == 1 ? Formulation::kReduced : Formulation::kFull;
  }
  if (type == CellType::kHex20)
    return routine == 186 && keyopt2 != 1 ? Formulation::kReduced : Formulation::kFull;
  return Formulation::kDefault;
}

}  // namespace clatter::mesh
