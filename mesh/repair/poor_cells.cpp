// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/poor_cells.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/validity.hpp"
#include "mesh/repair/poor_cell_effect.hpp"

namespace clatter::mesh {
namespace {

constexpr size_t kNamed = 3;

using CellQuality = QualityLimits;

CellQuality quality_of(CellType type, const CellNodes& x) {
  return {smallest_angle_of(type, x), jacobian_bounds(type, x).ratio()};
}

bool is_below(const CellQuality& cell, const QualityLimits& limits) {
  return cell.dihedral_deg < limits.dihedral_deg || cell.scaled_jacobian < limits.scaled_jacobian;
}

std::vector<WorstCell> worst_below(const Measure& measure, double limit) {
  std::vector<WorstCell> worst;
  for (const WorstCell& cell : measure.worst_cells)
    if (cell.value < limit && worst.size() < kNamed) worst.push_back(cell);
  return worst;
}

std::string name_positions(const std::vector<WorstCell>& cells, int64_t count,
                           const char* value_unit, const PositionUnit& unit) {
  std::vector<std::string> names;
  for (const WorstCell& cell : cells) {
    const Eigen::Vector3d x = cell.position / unit.metres;
    names.push_back(fmt::format("{:.3g}{} in cell {} at ({:.5g}, {:.5g}, {:.5g}) {}", cell.value,
                                value_unit, cell.label, x.x(), x.y(), x.z(), unit.name));
  }
  return fmt::format("{}{}", fmt::join(names, ", "),
                     count > static_cast<int64_t>(names.size()) ? ", ..." : "");
}

std::string effect_text(const PoorCells& poor) {
  if (!poor.has_estimate) return "";
  return poor.frequency_effect < 1e-6 ? ", estimated effect on frequencies below 0.0001 %"
                                      : fmt::format(", estimated effect on frequencies {:.2g} %",
                                                    100.0 * poor.frequency_effect);
}

}  // namespace

PoorCells find_poor_cells(const Mesh& mesh, const QualityReport& quality,
                          const QualityLimits& aims) {
  PoorCells poor;
  std::vector<CellIndex> indices;
  double volume = 0.0;
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const CellBlock& block = mesh.cells[b];
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const CellNodes x = cell_nodes(mesh, block, c);
      const CellQuality cell = quality_of(block.type, x);
      if (!is_below(cell, aims)) continue;
      poor.flat += cell.dihedral_deg < aims.dihedral_deg;
      poor.squeezed += cell.scaled_jacobian < aims.scaled_jacobian;
      poor.below_floor += is_below(cell, kQualityFloor);
      poor.has_estimate = poor.has_estimate || traits(block.type).order > 1;
      volume += volume_of(block.type, x);
      indices.emplace_back(static_cast<int32_t>(b), static_cast<int32_t>(c));
    }
  }
  poor.cells = static_cast<int64_t>(indices.size());
  if (indices.empty()) return poor;
  poor.volume_share = volume / cell_volume(mesh);
  poor.frequency_effect = frequency_effect(mesh, indices);
  poor.worst_flat = worst_below(quality.min_dihedral_deg, aims.dihedral_deg);
  poor.worst_squeezed = worst_below(quality.scaled_jacobian, aims.scaled_jacobian);
  return poor;
}

std::string describe_poor_cells(const PoorCells& poor, const Mesh& mesh, const QualityLimits& aims,
                                const PositionUnit& unit) {
  std::vector<std::string> kinds;
  if (poor.flat > 0)
    kinds.push_back(fmt::format("{} with a dihedral angle below {:g} deg ({})", poor.flat,
                                aims.dihedral_deg,
                                name_positions(poor.worst_flat, poor.flat, " deg", unit)));
  if (poor.squeezed > 0)
    kinds.push_back(fmt::format("{} with a scaled Jacobian below {:g} ({})", poor.squeezed,
                                aims.scaled_jacobian,
                                name_positions(poor.worst_squeezed, poor.squeezed, "", unit)));
  return fmt::format("{} of {} cells are poor: {}; {:.2g} % of the volume{}", poor.cells,
                     mesh.cell_count(), fmt::join(kinds, ", "), 100.0 * poor.volume_share,
                     effect_text(poor));
}

void note_poor_cells(const PoorCells& poor, MeshCertificate& certificate) {
  certificate.poor_cells = static_cast<double>(poor.cells);
  certificate.poor_cells_below_floor = static_cast<double>(poor.below_floor);
  certificate.poor_cells_volume_share = poor.volume_share;
  certificate.poor_cells_frequency_effect = poor.frequency_effect;
}

void check_poor_cells(const PoorCells& poor, const Mesh& mesh, const QualityLimits& aims,
                      const PositionUnit& unit, bool accept) {
  if (poor.cells == 0) return;
  const std::string what = describe_poor_cells(poor, mesh, aims, unit);
  if (poor.below_floor == 0 || accept) {
    warn("mesh: " + what);
    return;
  }
  throw NumericsError(fmt::format(
      "mesh: {} cells are below {:g} deg or a scaled Jacobian of {:g}, too poor to be trusted; {}: "
      "choose another element_size_mm or finer [[mesh.local]] there, suppress small features by "
      "[cad] defeature_below, or accept the mesh with --accept-poor-cells ([mesh] "
      "accept_poor_cells = true)",
      poor.below_floor, kQualityFloor.dihedral_deg, kQualityFloor.scaled_jacobian, what));
}

}  // namespace clatter::mesh
