// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/part_shape.hpp"

namespace clatter::mesh {
namespace {

PartGeometry build_kind(GmshSession& session, const PartShape& shape) {
  if (shape.kind == "block") return build_block(session, shape.block);
  if (shape.kind == "head") return build_head(session, shape.head);
  if (shape.kind == "piston") return build_piston(session, shape.piston);
  if (shape.kind == "rod") return build_rod(session, shape.rod);
  if (shape.kind == "box") return build_box(session, shape.box);
  if (shape.kind == "cylinder") return build_cylinder(session, shape.cylinder);
  if (shape.kind == "sheet") return build_sheet(session, shape.sheet, shape.unit.name);
  if (shape.kind == "pan") return build_pan(session, shape.pan);
  return build_cad(session, shape.cad, shape.unit.name);
}

}  // namespace

const keys::Keys<PartShape>& shape_keys() {
  static const keys::Keys<PartShape> keys(
      "shape", "a part's geometry", [](auto& key, PartShape& s) {
        key.choice(
               "kind", s.kind,
               {"block", "head", "piston", "rod", "box", "cylinder", "pan", "cad", "sheet", "deck"},
               "what the part is; the table of this name has its dimensions or its file")
            .required();
        key.choice("length_unit", s.unit.name, {"mm", "m", "cm", "in"},
                   "unit of the lengths of this file that name none");
        const auto table = [&key](const char* name, auto& at, const auto& keys_of) {
          key.table(name, at, keys_of).needs("kind", name).required_with("kind", name);
        };
        table("block", s.block, block_keys());
        table("head", s.head, head_keys());
        table("piston", s.piston, piston_keys());
        table("rod", s.rod, rod_keys());
        table("box", s.box, box_part_keys());
        table("cylinder", s.cylinder, cylinder_part_keys());
        table("pan", s.pan, pan_keys());
        table("cad", s.cad, cad_keys());
        table("sheet", s.sheet, sheet_keys());
        key.named("surface", s.surface_tables, surface_keys());
        key.named("edge", s.edge_tables, surface_keys()).needs("kind", {"sheet", "pan"});
        key.check([](const Config& config, PartShape& shape) {
          const std::string& unit = shape.unit.name;
          shape.unit.metres = unit == "m"    ? 1.0
                              : unit == "cm" ? 1e-2
                              : unit == "in" ? 25.4e-3
                                             : 1e-3;
          shape.surfaces = named_surfaces(config, shape.surface_tables);
          for (const auto& [name, table] : shape.edge_tables)
            shape.edges.push_back({name, {table.filter}, table.tolerance});
        });
      });
  return keys;
}

PartGeometry build_part(GmshSession& session, const PartShape& shape) {
  PartGeometry part = build_kind(session, shape);
  part.unit = shape.unit.name;
  part.surfaces.insert(part.surfaces.end(), shape.surfaces.begin(), shape.surfaces.end());
  part.edges = shape.edges;
  return part;
}

}  // namespace clatter::mesh
