// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/poor_cells.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

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

/// Volume of the cells with one of the marked nodes.
double volume_at(const Mesh& mesh, const std::vector<bool>& marked) {
  double volume = 0.0;
  for (const CellBlock& block : mesh.cells)
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
      if (std::any_of(block.nodes.row(c).begin(), block.nodes.row(c).end(),
                      [&](int32_t node) { return marked[node]; }))
        volume += volume_of(block.type, cell_nodes(mesh, block, c));
  return volume;
}

std::string percent(double value) {
  if (value < 1e-6) return "below 0.0001 %";
  return value < 1.0 ? fmt::format("{:.2g} %", 100.0 * value)
                     : fmt::format("{:.0f} %", 100.0 * value);
}

std::string effect_text(const PoorCells& poor) {
  if (!poor.has_estimate) return "";
  return fmt::format(", estimated effect on frequencies {}, at most {}",
                     percent(poor.frequency_effect), percent(poor.most_effect()));
}

constexpr double kAtAnEnd = 4.0;       // energy per length of a clamped beam, over its mean
constexpr double kAtTheSurface = 3.0;  // energy per volume of a bent wall, over its mean

}  // namespace

double effect_of_share(double share_below_floor) {
  return 0.5 * kAtAnEnd * kAtTheSurface * share_below_floor;  // half of omega^2
}

double PoorCells::most_effect() const {
  return kAtAnEnd * frequency_effect + effect_of_share(share_below_floor) +
         kMostEffect * share_around;
}

PoorCells find_poor_cells(const Mesh& mesh, const QualityReport& quality,
                          const QualityLimits& aims) {
  PoorCells poor;
  std::vector<CellIndex> indices;
  std::vector<bool> far(static_cast<size_t>(mesh.nodes.rows()), false);
  double volume = 0.0, far_below = 0.0;
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const CellBlock& block = mesh.cells[b];
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const CellNodes x = cell_nodes(mesh, block, c);
      const CellQuality cell = quality_of(block.type, x);
      if (!is_below(cell, aims)) continue;
      poor.flat += cell.dihedral_deg < aims.dihedral_deg;
      poor.squeezed += cell.scaled_jacobian < aims.scaled_jacobian;
      poor.has_estimate = poor.has_estimate || traits(block.type).order > 1;
      volume += volume_of(block.type, x);
      if (is_below(cell, kQualityFloor)) {
        ++poor.below_floor;
        far_below += volume_of(block.type, x);
        for (const int32_t node : block.nodes.row(c)) far[node] = true;
      }
      indices.emplace_back(static_cast<int32_t>(b), static_cast<int32_t>(c));
    }
  }
  poor.cells = static_cast<int64_t>(indices.size());
  if (indices.empty()) return poor;
  const double all = cell_volume(mesh);
  poor.volume_share = volume / all;
  poor.share_below_floor = far_below / all;
  if (poor.below_floor > 0) poor.share_around = volume_at(mesh, far) / all;
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
  return fmt::format("{} of {} cells are poor: {}; {} of the volume{}", poor.cells,
                     mesh.cell_count(), fmt::join(kinds, ", "), percent(poor.volume_share),
                     effect_text(poor));
}

void note_poor_cells(const PoorCells& poor, MeshCertificate& certificate) {
  certificate.poor_cells = static_cast<double>(poor.cells);
  certificate.poor_cells_below_floor = static_cast<double>(poor.below_floor);
  certificate.poor_cells_volume_share = poor.volume_share;
  certificate.poor_cells_frequency_effect = poor.frequency_effect;
  certificate.poor_cells_most_effect = poor.most_effect();
}

std::string refusal_of_poor_cells(const PoorCells& poor, const Mesh& mesh,
                                  const QualityLimits& aims, const PositionUnit& unit,
                                  bool accept) {
  if (poor.cells == 0) return "";
  const std::string what = "mesh: " + describe_poor_cells(poor, mesh, aims, unit);
  const double most = poor.most_effect();
  if (most > kMostEffect && !accept)
    return fmt::format("{}: more than {:g} % is too poor to be trusted", what, 100.0 * kMostEffect);
  // Of linear cells nothing is known.
  (most > kHarmless || !poor.has_estimate ? warn : say)(what);
  return "";
}

}  // namespace clatter::mesh
