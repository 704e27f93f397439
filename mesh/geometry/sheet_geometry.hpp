// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parts of sheet from STEP, BREP or IGES files.
#include <filesystem>
#include <optional>
#include <string>

#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

/// Table [sheet], in the part's unit.
struct SheetParameters {
  std::filesystem::path source;
  std::string region = "sheet";
  std::optional<double> thickness;
  std::string side = "middle";  // of the sheet that the faces are: or outer, inner
  std::optional<SurfaceTable> faces;
  SheetCells cells = SheetCells::kQuadrilaterals;
  std::string where;  // of the table, for messages
};
const keys::Keys<SheetParameters>& sheet_keys();

/// The faces that `faces` selects; else those of one side of a solid of constant thickness
/// (sheet_sides.hpp), else all faces of a file without solids. InputError where the thickness is
/// not known.
PartGeometry build_sheet(GmshSession& session, const SheetParameters& p, const std::string& unit);

}  // namespace clatter::mesh
