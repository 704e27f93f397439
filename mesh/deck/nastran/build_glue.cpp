// SPDX-License-Identifier: GPL-3.0-or-later
// BGSET: surfaces of BSURFS that are glued become ties.
#include <fmt/format.h>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

// Name of the surface on the faces of a BSURFS.
std::string surface_of(Model& model, int32_t id, Origin origin) {
  const auto found = model.raw.faces.find(id);
  if (found == model.raw.faces.end())
    model.source.fail(origin, fmt::format("BGSET: found no BSURFS {}", id));
  const std::string name = fmt::format("bsurfs_{}", id);
  if (model.deck.mesh.surfaces.contains(name)) return name;
  SurfaceBuilder surface;
  for (const RawFaces::Face& face : found->second.faces) {
    RawPressure as_load;  // a face of a cell by three of its corners
    as_load.origin = face.origin;
    as_load.cell = face.cell;
    const LoadedFace on = face_of_corners(model, as_load, face.corners);
    surface.add(on.type, on.nodes);
  }
  model.deck.mesh.surfaces[name] = surface.finish();
  return name;
}

void add_glue(Model& model, int32_t set, const RawGlue& glue) {
  for (const RawGlue::Pair& pair : glue.pairs) {
    Tie tie;
    tie.name = fmt::format("bgset_{}_{}", set, model.deck.ties.size() + 1);
    tie.where = model.source.where(glue.origin);
    tie.slave = surface_of(model, pair.source, glue.origin);
    tie.master = surface_of(model, pair.target, glue.origin);
    tie.distance = pair.distance;
    model.deck.ties.push_back(std::move(tie));
  }
}

}  // namespace

void build_glue(Model& model) {
  const Control& control = model.raw.control;
  for (const auto& [set, glue] : model.raw.glue) {
    if (control.has_cases && control.glue != set) continue;
    model.refusals.attempt([&, id = set, &one = glue] { add_glue(model, id, one); });
  }
  if (control.glue != 0 && !model.raw.glue.contains(control.glue))
    model.refusals.attempt([&] {
      throw InputError(fmt::format("{}: BGSET = {}: found no such set",
                                   model.source.files().front(), control.glue));
    });
}

}  // namespace clatter::mesh::deck::nastran
