// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/mesh_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "mesh/cad/gmsh_small_features.hpp"

namespace clatter::mesh {
namespace {

// Gmsh limits edges to a tenth of the part's size; faces and solids get the same limit, so that all
// larger sizes give the same mesh. Coarser chords would cut through walls.
void cap_size(SizeSettings& sizes, double coarsest) {
  if (sizes.size <= coarsest) return;
  say(
      fmt::format("mesh: element size {:g} is above a tenth of the part's diagonal: {:.4g}, the "
                  "largest allowed, is used (lengths in the part's unit)",
                  sizes.size, coarsest));
  sizes.size = std::max(coarsest, sizes.min_size);
}

// Features far below the requested size: they determine the size of cells there.
void say_small_features(GmshSession& session, const std::vector<FaceFacts>& faces, double size) {
  constexpr double kFarBelow = 0.2;  // of the size: cells grow to it over several layers
  const SmallFeatures features = find_small_features(session, faces, kFarBelow * size);
  if (features.count() == 0) return;
  say(fmt::format(
      "mesh: the part has features far smaller than its elements ({:g}), which determine "
      "the mesh around them: {}",
      size, describe_small_features(features)));
}

// A face's local size: the smaller of those by factor and by curvature.
double size_on(GmshSession& session, int face, const LocalSize& local, const SizeSettings& sizes) {
  double size = local.factor * sizes.size;
  const double radius = local.elements_per_turn > 0 ? session.smallest_radius(face) : 0.0;
  if (radius > 0.0)
    size = std::min(size, 2.0 * std::numbers::pi * radius / local.elements_per_turn);
  return std::max(size, sizes.min_size);
}

}  // namespace

FaceTags find_surfaces(const std::vector<FaceFacts>& faces,
                       const std::vector<NamedSurface>& surfaces, const std::string& unit,
                       const std::string& where) {
  const SelectionScale scale{size_of_part(faces), unit};
  FaceTags tags;
  for (const NamedSurface& surface : surfaces) {
    const Selection selection = select_faces(faces, surface, scale, where);
    for (const std::string& warning : selection.warnings) warn(warning);
    for (const std::string& remark : selection.remarks) say(remark);
    tags[surface.name] = selection.tags;
  }
  return tags;
}

SizeSettings size_settings(GmshSession& session, const MeshSettings& settings,
                           const std::vector<FaceFacts>& faces, const FaceTags& surfaces,
                           double metres_per_unit, const std::string& where) {
  SizeSettings sizes;
  sizes.size = settings.element_size / metres_per_unit;
  sizes.min_size = settings.min_size / metres_per_unit;
  sizes.per_turn = settings.elements_per_turn;
  sizes.adaptive_faces = settings.adaptive_faces;
  for (const LocalSize& local : settings.local) {
    const auto found = surfaces.find(local.surface);
    if (found == surfaces.end()) {
      std::string names;
      for (const auto& entry : surfaces) names += (names.empty() ? "" : ", ") + entry.first;
      throw InputError(fmt::format("{}: mesh.local: surface '{}' not found, expected one of: {}",
                                   where, local.surface, names.empty() ? "none" : names));
    }
    for (int tag : found->second) {
      const double size = size_on(session, tag, local, sizes);
      const auto [at, is_new] = sizes.face_sizes.emplace(tag, size);
      at->second = std::min(at->second, size);
      if (local.growth > 0.0 && size < sizes.size)
        sizes.gradations.push_back({tag, size, local.growth});
    }
  }
  cap_size(sizes, kCoarsest * size_of_part(faces));
  say_small_features(session, faces, sizes.size);
  return sizes;
}

}  // namespace clatter::mesh
