// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/monopole.hpp"

#include <numbers>

#include "core/base/error.hpp"
#include "core/sound/facet.hpp"
#include "core/sound/kernel.hpp"

namespace clatter::sound {

std::optional<Eigen::Vector3d> inner_point(const Surface& surface, double least) {
  constexpr int kSteps = 8;
  const Eigen::Vector3d low = surface.nodes.colwise().minCoeff();
  const Eigen::Vector3d size = surface.nodes.colwise().maxCoeff().transpose() - low;
  Eigen::Vector3d best = low;
  double depth = 0.0;
  for (int i = 1; i < kSteps; ++i)
    for (int j = 1; j < kSteps; ++j)
      for (int k = 1; k < kSteps; ++k) {
        const Eigen::Vector3d at = low + Eigen::Vector3d(i, j, k).cwiseProduct(size) / kSteps;
        if (winding_number(surface, at) < 0.5) continue;
        const double distance = distance_to(surface, at);
        if (distance <= depth) continue;
        depth = distance;
        best = at;
      }
  if (!(depth > 0.0) || depth < least) return std::nullopt;
  return best;
}

MonopoleMotion monopole(const Surface& surface, const Space& space, double frequency_hz,
                        const Eigen::Vector3d& position) {
  const double k = space.fluid.wavenumber(frequency_hz), c4 = 4.0 * std::numbers::pi;
  MonopoleMotion out{Eigen::VectorXcd(3 * surface.face_count()),
                     2.0 * std::numbers::pi / space.fluid.impedance()};
  std::vector<Eigen::Vector3d> sources{position};
  if (space.ground) {
    sources.push_back(space.ground->mirrored(position));
    const double phase = 2.0 * k * space.ground->height(position);
    out.power *= 1.0 + std::sin(phase) / phase;
  }
  const TriangleRule& rule = six_points();
  const std::vector<PreparedFacet> facets = prepared_facets(surface);
  for (size_t f = 0; f < facets.size(); ++f) {
    const Facet& facet = facets[f].facet;
    Eigen::Vector3cd slope = Eigen::Vector3cd::Zero();  // mean of N_a dp/dn
    for (Eigen::Index q = 0; q < rule.weight.size(); ++q)
      for (const Eigen::Vector3d& source : sources) {
        const Eigen::Vector3d d = facet.corners * rule.shape.col(q) - source;
        slope -= rule.weight[q] * c4 * kernel(k, d.norm()).slope * facet.normal.dot(d) *
                 rule.shape.col(q);
      }
    // The inverse of the means of N_a N_b is 12 on the diagonal less 3 everywhere.
    out.velocity.segment(3 * static_cast<Eigen::Index>(f), 3) =
        (12.0 * slope - Eigen::Vector3cd::Constant(3.0 * slope.sum())) /
        Complex(0.0, -k * space.fluid.impedance());
  }
  return out;
}

}  // namespace clatter::sound
