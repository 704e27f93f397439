// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/model/check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "assembly/load/point_mass.hpp"
#include "core/base/error.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::assembly {
namespace {

constexpr double kNoStiffness = 1e-13;  // of the largest diagonal entry of K: rounding
constexpr double kNoMass = 1e-13;       // least eigenvalue of a reference's scaled mass block

}  // namespace

void check_references(const std::string& name, const std::map<std::string, rom::DofSet>& sets,
                      const SparseMatrix& M) {
  for (const auto& [set_name, set] : sets) {
    // A set of several points: each of them is a set too.
    if (!has_rotations(set) || set.dofs.size() > 6) continue;
    std::vector<int32_t> dofs = set.dofs;
    std::erase_if(dofs, [&](int32_t dof) { return M.coeff(dof, dof) == 0.0; });
    const auto n = static_cast<Eigen::Index>(dofs.size());
    if (n == 0) continue;
    Eigen::MatrixXd block(n, n);
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index b = 0; b <= a; ++b) {
        const int32_t i = dofs[a], j = dofs[b];
        block(a, b) = block(b, a) = M.coeff(std::max(i, j), std::min(i, j));
      }
    const Eigen::VectorXd scale = block.diagonal().cwiseSqrt().cwiseInverse();
    const dense::Eigenpairs eigen = dense::symmetric_eigen(
        scale.asDiagonal() * block * scale.asDiagonal(), dense::EigenParts::kValues);
    if (!(eigen.values(0) > kNoMass))
      throw InputError(fmt::format(
          "{}: found a motion of {} that moves nothing (the coupled nodes lie on a line or at "
          "a point), expected supports for its rotations or a wider coupling",
          name, set_name));
  }
}

void check_stiffness(const mesh::Mesh& mesh, const std::map<std::string, rom::DofSet>& sets,
                     const SparseMatrix& K) {
  if (K.rows() == 0 || mesh.nodes.rows() == 0) return;
  const Eigen::VectorXd diagonal = K.diagonal();
  const double length = (mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff()).norm();
  for (const auto& [name, set] : sets) {
    if (!has_rotations(set)) continue;
    for (size_t k = 0; k < set.dofs.size(); ++k) {
      const double unit = set.is_rotation[k] != 0 ? length * length : 1.0;
      const double stiffness = diagonal(set.dofs[k]);
      if (stiffness == 0.0 || stiffness > kNoStiffness * unit * diagonal.maxCoeff()) continue;
      throw InputError(fmt::format(
          "{}: found no stiffness against {}: {} moves a rigid body without elastic attachment, "
          "expected supports of it or a coupling to deformable cells",
          mesh.name, set.labels[k], name));
    }
  }
}

}  // namespace clatter::assembly
