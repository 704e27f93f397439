// SPDX-License-Identifier: GPL-3.0-or-later
// CQUAD4, CTRIA3 and the like. Those on faces of solids are surfaces of the mesh, as meshers write
// them for loads and radiation; others are shells.
#include <fmt/format.h>

#include <algorithm>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

std::span<const int32_t> corners_of(const RawSkins& skins, size_t i) {
  const auto corners = static_cast<size_t>(traits(skins.type).corners);
  return std::span(skins.corners).subspan(i * corners, corners);
}

class Skins {
 public:
  Skins(Model& model, Ignore& ignore) : model_(model), ignore_(ignore) {}

  void build() {
    for (const RawSkins& skins : model_.raw.skins)
      if (!model_.refusals.attempt([&] { sort(skins); })) return;
    for (const auto& [card, lost] : shells_)
      model_.refusals.attempt([&, &name = card, &one = lost] { leave_out(name, one); });
  }

 private:
  struct Shells {
    int64_t count = 0;
    Origin origin = 0;
    std::vector<int32_t> grids;
  };

  void sort(const RawSkins& skins) {
    SurfaceBuilder surface;
    int64_t on_faces = 0;
    Shells& shells = shells_[skins.card];
    if (shells.count == 0) shells.origin = skins.origin;
    for (size_t i = 0; i < skins.ids.size(); ++i) {
      const auto corners = corners_of(skins, i);
      if (const auto face = boundary_face(model_, corners, skins.origin)) {
        surface.add(face->type, face->nodes);
        ++on_faces;
        continue;
      }
      ++shells.count;
      shells.grids.insert(shells.grids.end(), corners.begin(), corners.end());
    }
    if (on_faces == 0) return;
    const auto named = model_.raw.region_names.find(skins.property);
    const std::string name = named == model_.raw.region_names.end()
                                 ? fmt::format("pid_{}", skins.property)
                                 : named->second;
    add_surface(name, surface.finish());
    note(skins, on_faces, name);
  }

  // Cells of several kinds may have one property.
  void add_surface(const std::string& name, const Surface& fresh) {
    Surface& surface = model_.deck.mesh.surfaces[name];
    SurfaceBuilder all;
    for (const Surface* one : {&std::as_const(surface), &fresh})
      for (const FaceBlock& block : one->faces)
        for (Eigen::Index f = 0; f < block.nodes.rows(); ++f)
          all.add(block.type,
                  std::span(block.nodes.row(f).data(), static_cast<size_t>(block.nodes.cols())));
    surface = all.finish();
  }

  // Stiffness that a skin has, and loses here, is named.
  void note(const RawSkins& skins, int64_t count, const std::string& name) {
    const auto shell = model_.raw.shells.find(skins.property);
    std::string text =
        fmt::format("{}: {} {} on faces of solids are surface {}",
                    model_.source.where(skins.origin), count, skins.card, shown(name));
    if (shell != model_.raw.shells.end() && shell->second.material != 0)
      text += fmt::format("; their own stiffness and mass (PSHELL {}, T = {}) are left out",
                          skins.property, shell->second.thickness);
    model_.deck.notes.push_back(text);
  }

  void leave_out(const std::string& card, const Shells& shells) {
    if (shells.count == 0) return;
    if (ignore_.skips(card, shells.count)) {
      auto& lost = model_.raw.lost_grids;
      lost.insert(lost.end(), shells.grids.begin(), shells.grids.end());
      return;
    }
    model_.source.fail(
        shells.origin,
        fmt::format("card {0} ({1} times, not on faces of solids) is not supported: no shells yet; "
                    "ignore = [\"{0}\"] drops their stiffness and mass",
                    card, shells.count));
  }

  Model& model_;
  Ignore& ignore_;
  std::map<std::string, Shells> shells_;
};

}  // namespace

void build_skins(Model& model, Ignore& ignore) {
  Skins(model, ignore).build();
  std::sort(model.raw.lost_grids.begin(), model.raw.lost_grids.end());
}

std::vector<LoadedFace> faces_of_skins(Model& model, const RawSkinPressure& raw) {
  const auto& skins = model.raw.skins;
  if (model.skin_starts.empty()) {
    std::vector<int32_t> ids;
    for (const RawSkins& one : skins) {
      model.skin_starts.push_back(ids.size());
      ids.insert(ids.end(), one.ids.begin(), one.ids.end());
    }
    model.skins = IdIndex(ids);
  }
  std::vector<LoadedFace> faces;
  model.spend(model.skins.effort(raw.cells.first, raw.cells.last), raw.origin);
  model.skins.for_each(raw.cells.first, raw.cells.last, raw.cells.step, [&](int32_t row) {
    const auto at = static_cast<size_t>(row);
    const auto block = std::upper_bound(model.skin_starts.begin(), model.skin_starts.end(), at) - 1;
    const RawSkins& one = skins[static_cast<size_t>(block - model.skin_starts.begin())];
    model.spend(16, raw.origin);
    if (const auto face = boundary_face(model, corners_of(one, at - *block), raw.origin))
      faces.push_back(*face);
  });
  if (faces.empty())
    model.source.fail(
        raw.origin,
        model.cells.find(raw.cells.first) >= 0
            ? fmt::format("PLOAD4: G1 of solid {}: found nothing, expected a grid", raw.cells.first)
            : fmt::format("found no two-dimensional cell {} on a face of a solid",
                          raw.cells.first));
  return faces;
}

}  // namespace clatter::mesh::deck::nastran
