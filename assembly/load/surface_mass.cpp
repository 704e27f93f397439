// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/surface_mass.hpp"

#include <vector>

#include "core/mesh/face_points.hpp"

namespace clatter::assembly {
namespace {

/// Calls use(nodes of the face, N, x, dm) at the integration points of all surface masses.
template <typename Use>
void for_each_mass(const PartData& part, const Use& use) {
  for (const SurfaceMassSpec& spec : part.recipe.surface_masses)
    mesh::for_each_face_point(part.mesh.nodes, part.mesh.surface(spec.surface),
                              [&](const auto& nodes, const auto& N, const Eigen::Vector3d& x,
                                  double weight, const Eigen::Vector3d& normal) {
                                use(nodes, N, x, spec.area_mass * weight * normal.norm());
                              });
}

}  // namespace

SparseMatrix surface_mass_matrix(const PartData& part) {
  if (part.recipe.surface_masses.empty()) return {};
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  for_each_mass(part, [&](const auto& nodes, const auto& N, const Eigen::Vector3d&, double dm) {
    for (Eigen::Index a = 0; a < nodes.size(); ++a)
      for (Eigen::Index b = 0; b < nodes.size(); ++b)
        for (int d = 0; d < 3 && nodes(a) >= nodes(b); ++d)
          entries.emplace_back(3 * nodes(a) + d, 3 * nodes(b) + d, dm * N(a) * N(b));
  });
  SparseMatrix M(part.numbers.count(), part.numbers.count());
  M.setFromTriplets(entries.begin(), entries.end());
  return M;
}

void add_surfaces(MassMoments& moments, const PartData& part) {
  for_each_mass(part, [&](const auto&, const auto&, const Eigen::Vector3d& x, double dm) {
    add_point(moments, dm, x, Eigen::Matrix3d::Zero());
  });
}

}  // namespace clatter::assembly
