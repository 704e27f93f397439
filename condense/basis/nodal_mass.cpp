// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/nodal_mass.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/fe/assemble.hpp"

namespace clatter::condense {
namespace {

/// T^T (m x I_3) T, lower triangle.
SparseMatrix with_directions(const SparseMatrix& m, const SparseMatrix& T) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < m.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(m, j); it; ++it)
      for (int d = 0; d < 3; ++d) {
        const int row = 3 * static_cast<int>(it.row()) + d, column = 3 * j + d;
        entries.emplace_back(row, column, it.value());
        if (row != column) entries.emplace_back(column, row, it.value());
      }
  SparseMatrix M(T.rows(), T.rows());
  M.setFromTriplets(entries.begin(), entries.end());
  const SparseMatrix MT = M * T;
  const SparseMatrix all = SparseMatrix(T.transpose()) * MT;
  return all.triangularView<Eigen::Lower>();
}

double largest_entry(const SparseMatrix& A) {
  return A.nonZeros() > 0 ? A.coeffs().abs().maxCoeff() : 0.0;
}

bool gives_back(const SparseMatrix& m, const fe::FeModel& model) {
  const SparseMatrix rest = with_directions(m, model.T) - model.M;
  return largest_entry(rest) <= 1e-10 * largest_entry(model.M);
}

}  // namespace

SparseMatrix without_directions(const SparseMatrix& M) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < M.outerSize(); j += 3)
    for (SparseMatrix::InnerIterator it(M, j); it; ++it)
      if (it.row() % 3 == 0) entries.emplace_back(it.row() / 3, j / 3, it.value());
  SparseMatrix m(M.rows() / 3, M.cols() / 3);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

SparseMatrix nodal_mass(const fe::FeModel& model, const std::function<SparseMatrix()>& direct,
                        const std::function<bool(const SparseMatrix& m)>& gives_back) {
  if (model.T.rows() == model.size()) {
    const SparseMatrix m = direct();
    if (gives_back(m)) return m;
  }
  if (!model.cells.blocks.empty()) {
    mesh::Mesh mesh;
    mesh.name = model.name;
    mesh.nodes = model.nodes;
    mesh.regions = model.cells.regions;
    mesh.cells = model.cells.blocks;
    const fe::NodePattern pattern = fe::node_pattern(mesh);
    for (const auto form : {fe::MassForm::kConsistent, fe::MassForm::kHrz}) {
      const SparseMatrix m =
          without_directions(fe::assemble(mesh, model.cells.materials, pattern, form).M);
      if (gives_back(m)) return m;
    }
  }
  throw InputError(fmt::format(
      "{}: inertia_invariants: found a mass that is not that of the cells (point masses, "
      "shells, imported matrices), expected one",
      model.name));
}

SparseMatrix nodal_mass(const fe::FeModel& model) {
  return nodal_mass(
      model, [&] { return without_directions(model.M); },
      [&](const SparseMatrix& m) { return gives_back(m, model); });
}

}  // namespace clatter::condense
