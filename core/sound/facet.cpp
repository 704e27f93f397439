// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/facet.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "core/base/error.hpp"

namespace clatter::sound {
namespace {

PreparedFacet prepared(const Eigen::Matrix3d& corners, const Eigen::Vector3i& nodes) {
  PreparedFacet out{{corners, Eigen::Matrix3d::Identity(), {}, 0.0}, nodes, {}, {}, 0.0, {}};
  const Eigen::Vector3d twice =
      (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
  out.facet.area = 0.5 * twice.norm();
  out.facet.normal = twice.normalized();
  // grad N_a = n x (edge opposite a) / 2A, so n x grad N_a is that edge reversed.
  for (int a = 0; a < 3; ++a)
    out.curl.col(a) = (corners.col((a + 1) % 3) - corners.col((a + 2) % 3)) / twice.norm();
  out.centre = out.facet.centre();
  out.radius = out.facet.radius();
  out.points = corners * three_points().shape;
  return out;
}

}  // namespace

Facet Facet::quarter(int which) const {
  const auto part = [&](const Eigen::Matrix3d& of) {
    Eigen::Matrix3d middles;  // column a: of the edge opposite a
    for (int a = 0; a < 3; ++a) middles.col(a) = 0.5 * (of.col((a + 1) % 3) + of.col((a + 2) % 3));
    if (which == 3) return middles;
    Eigen::Matrix3d out;
    out.col(0) = of.col(which);
    out.col(1) = middles.col((which + 2) % 3);
    out.col(2) = middles.col((which + 1) % 3);
    return out;
  };
  return {part(corners), part(shape), normal, 0.25 * area};
}

std::vector<PreparedFacet> prepared_facets(const Surface& surface) {
  std::vector<PreparedFacet> facets;
  facets.reserve(surface.face_count());
  for (Eigen::Index f = 0; f < surface.face_count(); ++f) {
    Eigen::Matrix3d corners;
    for (int a = 0; a < 3; ++a)
      corners.col(a) = surface.nodes.row(surface.triangles(f, a)).transpose();
    facets.push_back(prepared(corners, surface.triangles.row(f).transpose()));
  }
  return facets;
}

std::vector<PreparedFacet> image_facets(const Surface& surface, const Space& space) {
  if (!space.ground) return {};
  for (Eigen::Index n = 0; n < surface.node_count(); ++n)
    if (const double height = space.ground->height(surface.nodes.row(n)); !(height > 0.0))
      throw InputError(fmt::format(
          "ground plane: found node {} of the surface {:.4g} m above it, expected more than 0", n,
          height));
  std::vector<PreparedFacet> facets = prepared_facets(surface);
  for (PreparedFacet& facet : facets) {
    Eigen::Matrix3d corners;
    for (int a = 0; a < 3; ++a)
      corners.col(a) = space.ground->mirrored(facet.facet.corners.col(corner_of_face(a, false)));
    facet = prepared(corners, {facet.nodes[0], facet.nodes[2], facet.nodes[1]});
  }
  return facets;
}

}  // namespace clatter::sound
