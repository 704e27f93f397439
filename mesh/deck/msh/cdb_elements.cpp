// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/cdb_elements.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace clatter::mesh {
namespace {

// Positions of the nodes of each cell among those of the element, in Abaqus' order. Corners I J K L
// M N O P are 0 to 7; mid-side nodes of the lower face 8 to 11, the upper 12 to 15, upright 16
// to 19.
constexpr std::array kTet = {0, 1, 2, 4, 8, 9, 11, 16, 17, 18};
constexpr std::array kPyramid = {0, 1, 2, 3, 4, 8, 9, 10, 11, 16, 17, 18, 19};
constexpr std::array kWedge = {0, 1, 2, 4, 5, 6, 8, 9, 11, 12, 13, 15, 16, 17, 18};
constexpr std::array kHex = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19};
constexpr std::array kPlainTet = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};  // SOLID92 and 187

std::span<const int> order_of(CellType type) {
  const CellTraits& cell = traits(type);
  return cell.to_abaqus.empty() ? cell.to_nastran : cell.to_abaqus;
}

std::optional<CdbCell> cell_of(CellType type, std::span<const int> at,
                               const std::vector<size_t>& nodes) {
  CdbCell cell{type, std::vector<size_t>(static_cast<size_t>(traits(type).nodes))};
  const auto order = order_of(type);
  for (size_t i = 0; i < cell.nodes.size(); ++i)
    cell.nodes[static_cast<size_t>(order[i])] = nodes[static_cast<size_t>(at[i])];
  std::vector<size_t> sorted = cell.nodes;
  std::sort(sorted.begin(), sorted.end());
  const bool distinct = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  if (!distinct || sorted.front() == 0) return std::nullopt;
  return cell;
}

}  // namespace

bool is_cdb_solid(int routine) {
  constexpr std::array kSolids = {45, 92, 95, 185, 186, 187};
  return std::find(kSolids.begin(), kSolids.end(), routine) != kSolids.end();
}

std::optional<CdbCell> cdb_cell(int routine, const std::vector<size_t>& nodes) {
  if (routine == 92 || routine == 187) {
    if (nodes.size() != 10) return std::nullopt;
    return cell_of(CellType::kTet10, kPlainTet, nodes);
  }
  const bool linear = routine == 45 || routine == 185;
  if (nodes.size() != (linear ? 8u : 20u)) return std::nullopt;
  const auto pick = [&](CellType small, CellType large, std::span<const int> at) {
    return cell_of(linear ? small : large, at, nodes);
  };
  const bool point = nodes[4] == nodes[5] && nodes[5] == nodes[6] && nodes[6] == nodes[7];
  if (point && nodes[2] == nodes[3]) return pick(CellType::kTet4, CellType::kTet10, kTet);
  if (point) return pick(CellType::kPyramid5, CellType::kPyramid13, kPyramid);
  if (nodes[2] == nodes[3] && nodes[6] == nodes[7])
    return pick(CellType::kWedge6, CellType::kWedge15, kWedge);
  return pick(CellType::kHex8, CellType::kHex20, kHex);
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
