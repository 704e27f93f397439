// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/pan_geometry.hpp"

#include <algorithm>

#include "mesh/geometry/length_row.hpp"
#include "mesh/geometry/sheet_cells.hpp"
#include "mesh/geometry/sheet_sides.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

constexpr double kSlab = 0.1;  // of the depth: what is fused above the flange

/// The pan full of material, with a slab above whose lower face is the flange.
Solids full_pan(GmshSession& session, const PanParameters& p) {
  const double x = 0.5 * p.length, y = 0.5 * p.width, above = kSlab * p.depth;
  Solids pan = {session.rounded_box({-x, -y, -p.depth}, {x, y, 0.5 * above}, p.corner)};
  if (p.sump_depth > 0.0)
    pan = session.fuse(pan, {session.rounded_box({x - p.sump_length, -y, -p.sump_depth},
                                                 {x, y, 0.5 * above}, p.corner)});
  const double f = p.flange;
  return session.fuse(
      pan, {session.rounded_box({-x - f, -y - f, 0.0}, {x + f, y + f, above}, p.corner + f)});
}

}  // namespace

const keys::Keys<PanParameters>& pan_keys() {
  static const keys::Keys<PanParameters> keys(
      "pan", "an oil pan of sheet; lengths to the middle of the sheet",
      [](auto& key, PanParameters& p) {
        length(key, "length", p.length, "of the walls along x");
        length(key, "width", p.width, "of the walls along y");
        length(key, "depth", p.depth, "of the bottom below the flange, which is at z = 0");
        length(key, "thickness", p.thickness, "of the sheet");
        length(key, "corner", p.corner, "radius of the walls' corners, seen from above");
        length(key, "bottom_fillet", p.bottom_fillet, "radius between walls and bottom");
        length(key, "flange", p.flange, "from the walls to the edge of the flange");
        length(key, "flange_fillet", p.flange_fillet, "radius between walls and flange");
        key.number("sump_depth", p.sump_depth, Range::not_negative(),
                   "of a sump at the end of +x, from the flange; 0 for none")
            .shown_in("length_unit");
        key.number("sump_length", p.sump_length, Range::not_negative(), "of the sump along x")
            .shown_in("length_unit")
            .required_with("sump_depth");
        key.text("region", p.region, "name of the region");
        cells_of_sheet(key, p.cells);
        key.check([](const Config& table, PanParameters& pan) {
          const auto need = [&](const char* name, bool holds, const char* expected) {
            if (!holds) table.fail(name, expected);
          };
          need("corner", 2.0 * pan.corner < std::min(pan.length, pan.width),
               "expected less than half of length and width");
          need("bottom_fillet", pan.bottom_fillet < pan.corner, "expected less than corner");
          need("flange_fillet", pan.flange_fillet < pan.flange, "expected less than flange");
          need("depth", pan.depth > pan.bottom_fillet + pan.flange_fillet,
               "expected more than both fillets");
          if (pan.sump_depth == 0.0) return;
          need("sump_depth", pan.sump_depth > pan.depth + 2.0 * pan.bottom_fillet,
               "expected more than depth and twice bottom_fillet");
          need("sump_length",
               pan.sump_length > 2.0 * pan.corner &&
                   pan.sump_length < pan.length - pan.corner - pan.bottom_fillet,
               "expected more than two corners, and less than length without corner and "
               "bottom_fillet");
        });
      });
  return keys;
}

PartGeometry build_pan(GmshSession& session, const PanParameters& p) {
  const double lowest = std::max(p.depth, p.sump_depth), far = 10.0 * (p.length + p.width);
  const auto slice = [&](double low, double high) {
    return BoxFilter{{-far, -far, low}, {far, far, high}};
  };
  Solids solids = full_pan(session, p);
  solids = session.fillet(solids, slice(-lowest, -lowest), p.bottom_fillet);
  if (p.sump_depth > 0.0)
    solids = session.fillet(solids, slice(-p.depth, -p.depth), p.bottom_fillet);
  const double x = 0.5 * p.length, y = 0.5 * p.width;
  solids = session.fillet(solids, {{-x, -y, 0.0}, {x, y, 0.0}}, p.flange_fillet);
  SheetFaces sheet;
  sheet.region = p.region;
  sheet.cells = p.cells;
  sheet.thickness = p.thickness;
  SurfaceFilter below;
  below.box = slice(-far, 0.0);
  for (const FaceFacts& face : session.boundary_faces())
    if (matches(face, below, kNearSelection * p.thickness)) sheet.faces.push_back(face.tag);
  take_outward(depths_behind_faces(session), sheet);
  session.keep_faces(sheet.faces);
  PartGeometry part;
  part.sheet = std::move(sheet);
  part.surfaces = {in_plane("flange", Vector3d::UnitZ(), 0.0),
                   in_plane("bottom", Vector3d::UnitZ(), -p.depth)};
  if (p.sump_depth > 0.0)
    part.surfaces.push_back(in_plane("sump", Vector3d::UnitZ(), -p.sump_depth));
  return part;
}

}  // namespace clatter::mesh
