// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/solid_volumes.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/mesh/boundary.hpp"

namespace clatter::mesh {
namespace {

constexpr double kMoved = 1e-6;  // relative; OpenCASCADE integrates analytic faces to 1e-9
constexpr double kMm3 = 1e9;     // in a cubic metre

struct MeshVolume {
  double curved = 0.0, chords = 0.0;  // [m3]
};

MeshVolume volume_of_region(const Mesh& mesh, int32_t region) {
  MeshVolume sum;
  Mesh cell;
  cell.nodes = mesh.nodes;
  cell.cells = {{CellType::kTet10, 0, IndexMatrix(1, 10), {}}};
  for (const CellBlock& block : mesh.cells) {
    if (block.region != region) continue;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      cell.cells[0].nodes = block.nodes.row(c);
      const double curved = cell_volume(cell);
      Eigen::Matrix3d edges;
      for (int i = 0; i < 3; ++i)
        edges.row(i) = mesh.nodes.row(block.nodes(c, i + 1)) - mesh.nodes.row(block.nodes(c, 0));
      sum.curved += curved;
      sum.chords += std::abs(curved - edges.determinant() / 6.0);
    }
  }
  return sum;
}

MeshVolume volume_of(const CadSolid& solid, const PartGeometry& part, const Mesh& mesh) {
  MeshVolume sum;
  for (size_t r = 0; r < part.regions.size(); ++r) {
    const Solid of_region = part.regions[r].solids.front();  // CAD regions have one solid each
    if (std::find(solid.pieces.begin(), solid.pieces.end(), of_region) == solid.pieces.end())
      continue;
    const MeshVolume region = volume_of_region(mesh, static_cast<int32_t>(r));
    sum.curved += region.curved;
    sum.chords += region.chords;
  }
  return sum;
}

std::string name_of(const CadSolid& solid, double metres_per_unit) {
  const Eigen::Vector3d mm = 1e3 * metres_per_unit * solid.centre;
  return fmt::format("solid {}{} of {} at ({:.4g}, {:.4g}, {:.4g}) mm",
                     solid.name.empty() ? "" : "'" + solid.name + "', ", solid.number, solid.of,
                     mm.x(), mm.y(), mm.z());
}

}  // namespace

void check_solid_volumes(const PartGeometry& part, const Mesh& mesh, double metres_per_unit,
                         const std::string& where) {
  const double cubed = std::pow(metres_per_unit, 3);
  for (const CadSolid& solid : part.cad_solids) {
    if (std::abs(solid.joined - solid.volume) <= kMoved * solid.volume) continue;
    const double read = cubed * solid.volume, joined = cubed * solid.joined;
    const MeshVolume found = volume_of(solid, part, mesh);
    const std::string text = fmt::format(
        "{}: its volume is by OpenCASCADE {:.9g} mm3 as read and {:.9g} mm3 after joining it with "
        "its neighbours, by its mesh {:.9g} mm3",
        name_of(solid, metres_per_unit), kMm3 * read, kMm3 * joined, kMm3 * found.curved);
    const double allowed = found.chords + part.volume_tolerance * read + cubed * solid.slack;
    if (std::abs(found.curved - read) > allowed)
      throw NumericsError(fmt::format(
          "{}: {}, where chords explain {:.3g} mm3{}: a part was lost or doubled, or OpenCASCADE's "
          "integral is wrong; look at the mesh with a larger cad.volume_tolerance (now {:g}, of "
          "the volume), or repair the solid in its CAD program, or remove it",
          where, text, kMm3 * found.chords,
          solid.slack > 0.0 ? fmt::format(" and join_within {:.3g}", kMm3 * cubed * solid.slack)
                            : "",
          part.volume_tolerance));
    say(fmt::format("mesh: {}: as read, within its chords", text));
  }
}

}  // namespace clatter::mesh
