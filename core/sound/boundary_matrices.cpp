// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/boundary_matrices.hpp"

#include <algorithm>

#include "core/base/memory_limit.hpp"
#include "core/base/threads.hpp"
#include "core/sound/pair_integrals.hpp"

namespace clatter::sound {
namespace {

/// The parts of rows of A and B that one test facet contributes.
struct FacetRows {
  Eigen::MatrixXcd A;  // n_v x 3, column a: row of corner a
  Eigen::MatrixXcd B;  // 3 n_f x 3
};

/// Adds what the source facet `y`, which is face `face` or its image, does to the test facet.
void add_pair(double k, Complex alpha, const PreparedFacet& x, const PreparedFacet& y,
              Eigen::Index face, bool same_surface, FacetRows& rows) {
  const PairIntegrals pair = pair_integrals(k, x, y, same_surface);
  const Complex both = pair.single_layer.sum();
  const double normals = k * k * x.facet.normal.dot(y.facet.normal);
  const Eigen::Matrix3d curls = x.curl.transpose() * y.curl;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b)
      rows.A(y.nodes[b], a) += alpha * (curls(a, b) * both - normals * pair.single_layer(a, b)) -
                               pair.double_layer(a, b);
    for (int b = 0; b < 3; ++b)
      rows.B(3 * face + corner_of_face(b, same_surface), a) -=
          pair.single_layer(a, b) + alpha * pair.adjoint(a, b);
  }
}

/// The terms 1/2 M and 1/2 alpha M'.
void add_jump(Complex alpha, const PreparedFacet& x, Eigen::Index face, FacetRows& rows) {
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const double half_mass = 0.5 * x.facet.area / (a == b ? 6.0 : 12.0);
      rows.A(x.nodes[b], a) += half_mass;
      rows.B(3 * face + b, a) -= alpha * half_mass;
    }
}

void require_space(const Surface& surface) {
  const auto n_v = static_cast<double>(surface.node_count());
  const auto n_f = static_cast<double>(surface.face_count());
  require_memory("the boundary element matrices", gib_of_doubles(2.0 * n_v * (n_v + 3.0 * n_f)),
                 "use a coarser surface");
}

}  // namespace

Complex burton_miller_coupling(const Surface& surface, double k) {
  return {0.0, -std::min(1.0 / k, k * surface.radius * surface.radius)};
}

BoundaryMatrices boundary_matrices(const Surface& surface, const Space& space, double k,
                                   Complex alpha) {
  require_space(surface);
  const std::vector<PreparedFacet> facets = prepared_facets(surface);
  const std::vector<PreparedFacet> images = image_facets(surface, space);
  const Eigen::Index n_v = surface.node_count(), n_f = surface.face_count();
  BoundaryMatrices out{Eigen::MatrixXcd::Zero(n_v, n_v), Eigen::MatrixXcd::Zero(3 * n_f, n_v)};
  // Facets share nodes: their rows are computed side by side, and added one after another.
  constexpr Eigen::Index kAtOnce = 64;
  std::vector<FacetRows> batch(kAtOnce);
  for (Eigen::Index first = 0; first < n_f; first += kAtOnce) {
    const auto count = static_cast<int>(std::min(kAtOnce, n_f - first));
    parallel_tasks(count, [&](int task) {
      FacetRows& rows = batch[task];
      const PreparedFacet& x = facets[first + task];
      rows.A.setZero(n_v, 3);
      rows.B.setZero(3 * n_f, 3);
      add_jump(alpha, x, first + task, rows);
      for (size_t y = 0; y < facets.size(); ++y)
        add_pair(k, alpha, x, facets[y], static_cast<Eigen::Index>(y), true, rows);
      for (size_t y = 0; y < images.size(); ++y)
        add_pair(k, alpha, x, images[y], static_cast<Eigen::Index>(y), false, rows);
    });
    for (int task = 0; task < count; ++task)
      for (int a = 0; a < 3; ++a) {
        const int node = facets[first + task].nodes[a];
        out.A_transposed.col(node) += batch[task].A.col(a);
        out.B_transposed.col(node) += batch[task].B.col(a);
      }
  }
  return out;
}

}  // namespace clatter::sound
