// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/acoustic/acoustic_skin.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

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

/// Volume of a sphere with the same area.
double sphere_volume(const sound::Surface& surface) {
  return surface.area / 3.0 * std::sqrt(surface.area / (4.0 * std::numbers::pi));
}

/// @throws InputError where the wrap would not go around the body
void check_body(const rom::Skin& skin, double size, double opening) {
  if (!(opening < size))
    throw InputError(
        fmt::format("acoustic skin: found openings of {:g} m to be closed, expected "
                    "less than the size of the body, {:.3g} m",
                    opening, size));
  // The wrap would enter through a wider opening and cover both sides of the walls.
  const SkinBorder border = skin_border(skin);
  if (border.widest > opening)
    throw InputError(
        fmt::format("acoustic skin: found a skin that is open along {} edges, {:.3g} m wide, "
                    "expected a closed one or openings up to {:g} m (skin.opening), which are "
                    "closed: recover all surfaces of the part, or raise the opening",
                    border.edges, border.widest, opening));
}

}  // namespace

double shape_difference(const sound::Surface& one, const sound::Surface& exact) {
  const double sphere = sphere_volume(exact);
  return std::max(std::abs(one.volume - exact.volume), std::abs(sphere_volume(one) - sphere)) /
         sphere;
}

AcousticSkin acoustic_skin(const rom::Skin& skin, const AcousticMesh& mesh, double sound_speed,
                           double to_hz) {
  if (skin.triangles.rows() == 0)
    throw InputError(
        "acoustic skin: found a reduced model without a skin, expected one "
        "(clatter-condense: recover surfaces)");
  const double size = (skin.nodes.colwise().maxCoeff() - skin.nodes.colwise().minCoeff()).norm();
  const double opening = mesh.opening_for(size);
  check_body(skin, size, opening);
  // Fine enough that the wrap's distance from the body is small beside both.
  const double offset = std::min(opening / 60.0, size / 500.0);
  const FlatTriangles wrap = alpha_wrap(flat_quarters(skin), opening, offset);
  const sound::Surface exact = sound::closed_surface(wrap.nodes, wrap.triangles);
  // Remeshing leaves edges that are some per cent shorter in the mean.
  double edge = std::min(1.06 * sound_speed / (mesh.edges_per_wavelength * to_hz), size / 6.0);
  for (;;) {
    const FlatTriangles regular = remeshed(wrap, edge);
    const sound::Surface surface = sound::closed_surface(regular.nodes, regular.triangles);
    const double error = shape_difference(surface, exact);
    const double limit = sound::mesh_limit_hz(surface, sound_speed, mesh.edges_per_wavelength);
    if (limit >= to_hz && error <= mesh.shape_error) return {surface, opening, error};
    // The error of the shape falls with the square of the edge.
    const double shorter =
        std::min(limit < to_hz ? 0.98 * limit / to_hz : 0.95,
                 std::clamp(0.9 * std::sqrt(mesh.shape_error / error), 0.5, 0.95));
    edge *= shorter;
    const double faces = static_cast<double>(surface.face_count()) / (shorter * shorter);
    if (faces > mesh.most_faces)
      throw NumericsError(
          fmt::format("acoustic skin: {:g} edges a wavelength at {:g} Hz and a shape error of {:g} "
                      "take about {:.2g} faces, expected at most {} (skin.most_faces): lower "
                      "grid.to_hz, or raise skin.shape_error or skin.most_faces",
                      mesh.edges_per_wavelength, to_hz, mesh.shape_error, faces, mesh.most_faces));
  }
}

}  // namespace clatter::recover
