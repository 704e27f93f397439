// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/acoustic/acoustic_skin.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "recover/acoustic/cgal_wrap.hpp"
#include "recover/acoustic/skin_border.hpp"

namespace clatter::recover {
namespace {

FlatTriangles flat_quarters(const rom::Skin& skin) {
  static constexpr int kQuarters[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  FlatTriangles out{skin.nodes, IndexMatrix(4 * skin.triangles.rows(), 3)};
  for (Eigen::Index face = 0; face < skin.triangles.rows(); ++face)
    for (int quarter = 0; quarter < 4; ++quarter)
      for (int corner = 0; corner < 3; ++corner)
        out.triangles(4 * face + quarter, corner) =
            skin.triangles(face, kQuarters[quarter][corner]);
  return out;
}

}  // namespace

sound::Surface acoustic_skin(const rom::Skin& skin, const AcousticMesh& mesh, double sound_speed,
                             double to_hz) {
  if (skin.triangles.rows() == 0)
    throw InputError(
        "acoustic skin: found a reduced model without a skin, expected one "
        "(clatter-condense: recover surfaces)");
  const double size = (skin.nodes.colwise().maxCoeff() - skin.nodes.colwise().minCoeff()).norm();
  if (!(mesh.opening < size))
    throw InputError(
        fmt::format("acoustic skin: found openings of {:g} m to be closed, expected "
                    "less than the size of the body, {:.3g} m",
                    mesh.opening, size));
  // The wrap would enter through a wider opening and cover both sides of the walls.
  const SkinBorder border = skin_border(skin.nodes, skin.triangles);
  if (border.widest > mesh.opening)
    throw InputError(
        fmt::format("acoustic skin: found a skin that is open along {} edges, {:.3g} m wide, "
                    "expected a closed one or openings up to {:g} m (skin.opening), which are "
                    "closed: recover all surfaces of the part, or raise the opening",
                    border.edges, border.widest, mesh.opening));
  const FlatTriangles body = flat_quarters(skin);
  // Remeshing leaves edges that are some per cent shorter in the mean.
  double edge = 1.06 * sound_speed / (mesh.edges_per_wavelength * to_hz);
  constexpr int kAttempts = 4;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const FlatTriangles wrap = wrapped(body, mesh.opening, edge);
    const sound::Surface surface = sound::closed_surface(wrap.nodes, wrap.triangles);
    const double limit = sound::mesh_limit_hz(surface, sound_speed, mesh.edges_per_wavelength);
    if (limit >= to_hz) return surface;
    edge *= 0.98 * limit / to_hz;
  }
  throw NumericsError(
      fmt::format("acoustic skin: found no mesh with {:g} edges a wavelength at {:g} Hz in {} "
                  "attempts: lower to_hz, or change the opening of {:g} m",
                  mesh.edges_per_wavelength, to_hz, kAttempts, mesh.opening));
}

}  // namespace clatter::recover
