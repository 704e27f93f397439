// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/gasket.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "assembly/constraint/tie_relations.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/mesh/face_points.hpp"

namespace clatter::assembly {
namespace {

using Triplets = std::vector<Eigen::Triplet<double, int32_t>>;

/// d of the tied nodes by all ids, rows 3 k + direction; place[node] is k, or -1.
struct Jumps {
  SparseMatrix D;
  std::vector<int32_t> place;
};

Jumps jumps_of(const PartData& part, const GasketSpec& spec, const Projection& found) {
  Jumps jumps{{}, std::vector<int32_t>(static_cast<size_t>(part.mesh.nodes.rows()), -1)};
  Triplets entries;
  const double size = mean_size(tie_faces(part.mesh.nodes, part.mesh.surface(spec.slave)));
  int32_t rows = 0;
  for (const ProjectedNode& row : found.tied) {
    jumps.place[row.node] = rows / 3;
    const PointMotion follows = following(part, row, size, spec.where);
    for (int d = 0; d < 3; ++d, ++rows) {
      entries.emplace_back(rows, 3 * row.node + d, 1.0);
      for (size_t k = 0; k < follows[d].dofs.size(); ++k)
        entries.emplace_back(rows, follows[d].dofs[k], -follows[d].values[k]);
    }
  }
  jumps.D.resize(rows, part.numbers.count());
  jumps.D.setFromTriplets(entries.begin(), entries.end());
  return jumps;
}

/// The stiffness of the layer on d, and its area [m2].
SparseMatrix layer_stiffness(const PartData& part, const GasketSpec& spec, const Jumps& jumps,
                             double& area) {
  Triplets entries;
  const auto at_point = [&](const auto& nodes, const auto& N, const Eigen::Vector3d&, double weight,
                            const Eigen::Vector3d& normal) {
    for (const int32_t node : nodes)
      if (jumps.place[node] < 0) return;
    const double size = normal.norm(), dA = weight * size;
    const Eigen::Vector3d n = normal / size;
    const Eigen::Matrix3d k = dA * (spec.tangential * Eigen::Matrix3d::Identity() +
                                    (spec.normal - spec.tangential) * n * n.transpose());
    area += dA;
    for (Eigen::Index a = 0; a < nodes.size(); ++a)
      for (Eigen::Index b = 0; b < nodes.size(); ++b)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            if (k(i, j) != 0.0)
              entries.emplace_back(3 * jumps.place[nodes(a)] + i, 3 * jumps.place[nodes(b)] + j,
                                   N(a) * N(b) * k(i, j));
  };
  mesh::for_each_face_point(part.mesh.nodes, part.mesh.surface(spec.slave), at_point);
  SparseMatrix K(jumps.D.rows(), jumps.D.rows());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

}  // namespace

GasketStiffness gasket_stiffness(const PartData& part) {
  const auto size = static_cast<Eigen::Index>(part.numbers.count());
  GasketStiffness out{SparseMatrix(size, size), {}};
  for (GasketSpec spec : part.recipe.gaskets) {
    const Projection found = project_tie(part, spec);
    const Jumps jumps = jumps_of(part, spec, found);
    double area = 0.0;
    const SparseMatrix layer = layer_stiffness(part, spec, jumps, area);
    if (area == 0.0)
      throw InputError(fmt::format(
          "{}: found no face of {} whose nodes all face {} within {:.3g} m, expected some",
          spec.where, spec.slave, spec.master, *spec.distance));
    const SparseMatrix K =
        SparseMatrix(jumps.D.transpose() * layer * jumps.D).triangularView<Eigen::Lower>();
    out.K += K;
    if (spec.loss_factor > 0.0) {
      if (out.loss.rows() == 0) out.loss.resize(size, size);
      out.loss += spec.loss_factor * K;
    }
    say(fmt::format("{}: {:.4g} m2, {:.1f} % of the slave surface, largest gap {:.3g} m", spec.name,
                    area, 100.0 * area / found.slave_area, found.largest_gap));
  }
  return out;
}

}  // namespace clatter::assembly
