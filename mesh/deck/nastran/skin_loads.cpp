// SPDX-License-Identifier: GPL-3.0-or-later
// PLOAD2 and PLOAD4 of two-dimensional cells: shells, or faces of solids.
#include <fmt/format.h>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

const IdIndex& index_of(const std::vector<RawSkin>& cells, std::optional<IdIndex>& made) {
  if (!made) {
    std::vector<int32_t> ids;
    for (const RawSkin& one : cells) ids.push_back(one.id);
    made = IdIndex(ids);
  }
  return *made;
}

// Linear between the corners, along the normal of the deck's own order or along a vector.
void add_shell(Model& model, const RawSkin& shell, const RawPressure& pressure,
               std::vector<SkinLoad>& loads) {
  ShellFace face = face_of_shell(model, shell);
  face.values = pressure.values;
  drop_repeated_corner(face);
  loads.push_back({pressure, {face.type, face.nodes, 0}});
  loads.back().pressure.values = face.values;
}

}  // namespace

std::vector<SkinLoad> loads_on_skins(Model& model, const RawSkinPressure& raw) {
  const RawPressure& pressure = raw.pressure;
  const IdRange& cells = raw.cells;
  std::vector<SkinLoad> loads;
  const IdIndex& shells = index_of(model.raw.shell_cells, model.shells);
  model.spend(shells.effort(cells.first, cells.last), pressure.origin);
  shells.for_each(cells.first, cells.last, cells.step, [&](int32_t row) {
    model.spend(64, pressure.origin);
    add_shell(model, model.raw.shell_cells[static_cast<size_t>(row)], pressure, loads);
  });
  const IdIndex& skins = index_of(model.raw.skins, model.skins);
  model.spend(skins.effort(cells.first, cells.last), pressure.origin);
  skins.for_each(cells.first, cells.last, cells.step, [&](int32_t row) {
    const RawSkin& one = model.raw.skins[static_cast<size_t>(row)];
    const auto corners = std::span(one.grids).first(static_cast<size_t>(traits(one.type).corners));
    model.spend(16, pressure.origin);
    const auto face = boundary_face(model, corners, pressure.origin);
    if (!face) return;
    if (!pressure.is_plain())
      model.source.fail(pressure.origin,
                        "PLOAD4: found a load along a vector or one that varies on a face of a "
                        "solid by a two-dimensional cell, expected one pressure");
    loads.push_back({pressure, *face});
  });
  if (loads.empty())
    model.source.fail(
        pressure.origin,
        model.cells.find(cells.first) >= 0
            ? fmt::format("PLOAD4: G1 of solid {}: found nothing, expected a grid", cells.first)
            : fmt::format("found no shell {} and no two-dimensional cell of this number on a face "
                          "of a solid",
                          cells.first));
  return loads;
}

}  // namespace clatter::mesh::deck::nastran
