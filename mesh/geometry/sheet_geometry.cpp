// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/sheet_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "mesh/geometry/sheet_cells.hpp"
#include "mesh/geometry/sheet_sides.hpp"

namespace clatter::mesh {
namespace {

std::map<int, std::vector<int>> curves_of(GmshSession& session, const std::vector<int>& faces) {
  std::map<int, std::vector<int>> curves;
  for (const int face : faces) curves[face] = session.curves_of(face);
  return curves;
}

/// Groups of faces that share no curve.
size_t pieces_of(GmshSession& session) {
  const std::vector<int> faces = session.all_faces();
  return groups_of(faces, curves_of(session, faces)).size();
}

std::vector<int> selected_faces(GmshSession& session, const SheetParameters& p,
                                const std::string& unit) {
  const std::vector<FaceFacts> faces = session.boundary_faces();
  const NamedSurface wanted{"sheet.faces", {p.faces->filter}, p.faces->tolerance};
  const Selection found = select_faces(faces, wanted, {size_of_part(faces), unit}, p.where);
  for (const std::string& warning : found.warnings) warn(warning);
  for (const std::string& remark : found.remarks) say(remark);
  return found.tags;
}

/// The outer side of the file's only solid.
void take_side(GmshSession& session, const SheetParameters& p, const Solids& solids,
               const std::string& unit, const std::vector<FaceDepths>& depths, SheetFaces& sheet) {
  if (solids.size() > 1)
    throw InputError(
        fmt::format("{}: source: found {} solids, expected one sheet; [sheet.faces] "
                    "chooses faces of several",
                    p.where, solids.size()));
  const std::map<int, std::vector<int>> curves = curves_of(session, session.all_faces());
  try {
    const SheetSides sides = find_sides(depths, curves, session.volume(solids), p.thickness, unit);
    sheet.faces = sides.outer;
    sheet.thickness = sides.thickness;
    say(fmt::format(
        "mesh: the solid is a sheet of {:.4g} {}: {} faces are its outer side, {} its "
        "inner one, {} its rims; its middle is meshed from the outer side",
        sides.thickness, unit, sides.outer.size(), sides.inner.size(), sides.rims.size()));
  } catch (const NumericsError& none) {
    throw NumericsError(fmt::format("{}: {}", p.where, none.what()));
  }
}

}  // namespace

const keys::Keys<SheetParameters>& sheet_keys() {
  static const keys::Keys<SheetParameters> keys(
      "sheet", "a part of sheet of a CAD program", [](auto& key, SheetParameters& p) {
        key.path("source", p.source, "STEP, BREP or IGES file").required();
        key.text("region", p.region, "name of the region");
        key.number("thickness", p.thickness, Range::positive(),
                   "of the sheet; of a solid of constant thickness it is found")
            .shown_in("length_unit");
        key.choice("side", p.side, {"middle", "outer", "inner"},
                   "where the faces lie in the sheet; of a solid whose sides are found, outer");
        cells_of_sheet(key, p.cells);
        key.table("faces", p.faces, surface_keys());
        key.check([](const Config& table, SheetParameters& sheet) { sheet.where = table.where(); });
      });
  return keys;
}

PartGeometry build_sheet(GmshSession& session, const SheetParameters& p, const std::string& unit) {
  const Solids solids = session.import_sheet(p.source, unit);
  SheetFaces sheet;
  sheet.region = p.region;
  sheet.cells = p.cells;
  sheet.thickness = p.thickness.value_or(0.0);
  std::string side = p.side;
  std::vector<FaceDepths> depths;
  if (!solids.empty()) depths = depths_behind_faces(session);
  if (p.faces) {
    sheet.faces = selected_faces(session, p, unit);
  } else if (!solids.empty()) {
    take_side(session, p, solids, unit, depths, sheet);
    side = "outer";
  } else {
    sheet.faces = session.all_faces();
  }
  if (!(sheet.thickness > 0.0))
    throw InputError(
        fmt::format("{}: found no thickness, expected that of the sheet: only that of "
                    "a solid is found",
                    p.where));
  std::ranges::sort(sheet.faces);
  take_outward(depths, sheet);
  session.keep_faces(sheet.faces);
  if (const size_t pieces = pieces_of(session); solids.empty() && pieces > 1) {
    session.join_faces();
    say(
        fmt::format("mesh: the file has {} sheets that share no edge; where they touch they are "
                    "joined: {} left",
                    pieces, pieces_of(session)));
  }
  if (side != "middle") sheet.offset = (side == "outer" ? -0.5 : 0.5) * sheet.thickness;
  PartGeometry part;
  part.sheet = std::move(sheet);
  return part;
}

}  // namespace clatter::mesh
