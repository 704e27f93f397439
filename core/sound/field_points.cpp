// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/field_points.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "core/sound/complex_lu.hpp"
#include "core/sound/facet.hpp"
#include "core/sound/kernel.hpp"

namespace clatter::sound {
namespace {

// Distance over size from which six points suffice: the integrals are then within 1e-4.
constexpr double kFarFrom = 3.0;
// A point at 1/64 of a facet's size is still resolved; nearer ones are refused.
constexpr int kDivisions = 6;
constexpr double kLeastGap = 1.0 / 50.0;

/// Integrals of a facet's shape functions times G and dG/dn(y), seen from a point.
struct PointIntegrals {
  Eigen::Vector3cd single_layer = Eigen::Vector3cd::Zero();
  Eigen::Vector3cd double_layer = Eigen::Vector3cd::Zero();
};

void add_part(double k, const Eigen::Vector3d& x, const Facet& y, int divisions,
              PointIntegrals& sum) {
  if (divisions > 0 && (x - y.centre()).norm() < kFarFrom * y.radius()) {
    for (int part = 0; part < 4; ++part) add_part(k, x, y.quarter(part), divisions - 1, sum);
    return;
  }
  const TriangleRule& rule = six_points();
  for (Eigen::Index q = 0; q < rule.weight.size(); ++q) {
    const Eigen::Vector3d d = x - y.corners * rule.shape.col(q);
    const Eigen::Vector3d shape = rule.weight[q] * y.area * (y.shape * rule.shape.col(q));
    const Kernel at = kernel(k, d.norm());
    sum.single_layer += at.g * shape;
    sum.double_layer += at.slope * y.normal.dot(d) * shape;
  }
}

}  // namespace

void require_in_fluid(const Surface& surface, const Space& space, const std::string& name,
                      const Eigen::Vector3d& point) {
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    throw InputError(fmt::format("{}: found ({:g}, {:g}, {:g}) m {}, expected a point {}", name,
                                 point[0], point[1], point[2], found, expected));
  };
  if (!point.allFinite()) refuse("", "with finite coordinates");
  if (space.ground && space.ground->height(point) < 0.0)
    refuse("below the ground plane", "above it");
  if (winding_number(surface, point) > 0.5) refuse("inside the body", "outside");
  const double gap = distance_to(surface, point), least = kLeastGap * surface.mean_edge;
  if (gap < least)
    refuse(fmt::format("{:.3g} m from the body", gap), fmt::format("{:.3g} m away", least));
}

Eigen::MatrixXcd field_pressure(const Surface& surface, const Space& space,
                                const SurfaceState& state, const RowMatrix& points) {
  for (Eigen::Index n = 0; n < points.rows(); ++n)
    require_in_fluid(surface, space, fmt::format("field point {}", n), points.row(n));
  const double k = space.fluid.wavenumber(state.frequency_hz);
  const std::vector<PreparedFacet> facets = prepared_facets(surface);
  const std::vector<PreparedFacet> images = image_facets(surface, space);
  Eigen::MatrixXcd of_pressure = Eigen::MatrixXcd::Zero(surface.node_count(), points.rows());
  Eigen::MatrixXcd of_velocity = Eigen::MatrixXcd::Zero(3 * surface.face_count(), points.rows());
  parallel_pieces(points.rows(), [&](int64_t begin, int64_t end) {
    for (int64_t n = begin; n < end; ++n)
      for (const std::vector<PreparedFacet>* sources : {&facets, &images})
        for (size_t f = 0; f < sources->size(); ++f) {
          const PreparedFacet& y = (*sources)[f];
          PointIntegrals seen;
          add_part(k, points.row(n), y.facet, kDivisions, seen);
          for (int b = 0; b < 3; ++b) {
            const int corner = corner_of_face(b, sources == &facets);
            of_pressure(y.nodes[b], n) += seen.double_layer[b];
            of_velocity(3 * static_cast<Eigen::Index>(f) + corner, n) += seen.single_layer[b];
          }
        }
  });
  // -G dp/dn = i omega rho v_n G.
  const Complex slope(0.0, k * space.fluid.impedance());
  return rows_product(of_pressure, state.pressure) +
         slope * rows_product(of_velocity, state.velocity);
}

}  // namespace clatter::sound
