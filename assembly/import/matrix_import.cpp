// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/import/matrix_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assembly/import/matrix_rows.hpp"
#include "assembly/load/mass_properties.hpp"
#include "core/base/error.hpp"
#include "core/base/matrix_text.hpp"

namespace clatter::assembly {
namespace {

using Kind = rom::MappedDof::Kind;

/// To SI: rows and columns of rotations are multiplied by a length.
void scale(SparseMatrix& matrix, double unit, double length,
           const std::vector<rom::MappedDof>& dofs) {
  const auto arm = [&](Eigen::Index j) { return dofs[j].kind == Kind::kRotation ? length : 1.0; };
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (SparseMatrix::InnerIterator entry(matrix, j); entry; ++entry)
      entry.valueRef() *= unit * arm(entry.row()) * arm(j);
}

SparseMatrix read_sized(const std::filesystem::path& path, size_t dofs, const std::string& source) {
  SparseMatrix matrix = read_matrix_text(path);
  if (static_cast<size_t>(matrix.rows()) != dofs)
    throw InputError(fmt::format("{}: found {} rows, expected {} as in {}", path.string(),
                                 matrix.rows(), dofs, source));
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    const double diagonal = matrix.coeff(j, j);
    if (!(diagonal >= 0.0))
      throw InputError(
          fmt::format("{}: row {}: found {:.6g} on the diagonal, expected a number that is not "
                      "negative",
                      path.string(), j + 1, diagonal));
  }
  return matrix;
}

/// |K r| over |K| |r|, with |K| |r| from the absolute values of the entries.
double rigid_residue(const SparseMatrix& K, const Eigen::MatrixXd& rigid) {
  const Eigen::MatrixXd force = multiply_symmetric(K, rigid);
  const Eigen::MatrixXd size = multiply_symmetric(K.cwiseAbs(), rigid.cwiseAbs());
  double worst = 0.0;
  for (Eigen::Index m = 0; m < rigid.cols(); ++m) {
    const double scale = size.col(m).maxCoeff();
    if (scale > 0.0) worst = std::max(worst, force.col(m).cwiseAbs().maxCoeff() / scale);
  }
  return worst;
}

/// Mass, centre and inertia; empty unless every translation is known.
rom::MassProperties mass_of(const SparseMatrix& M, const Eigen::MatrixXd& rigid) {
  for (Eigen::Index d = 0; d < 3; ++d)
    if (rigid.col(d).isZero(0.0)) return {};
  return properties_of(M, rigid);
}

SparseMatrix rows_and_columns(const SparseMatrix& lower, const std::vector<int32_t>& coordinate,
                              int32_t size) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(lower.nonZeros());
  for (Eigen::Index j = 0; j < lower.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(lower, j); entry; ++entry) {
      const int32_t p = coordinate[entry.row()], q = coordinate[j];
      if (p >= 0 && q >= 0) entries.emplace_back(p, q, entry.value());
    }
  }
  SparseMatrix part(size, size);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

}  // namespace

BuiltModel import_matrices(const MatrixFiles& files, const mesh::Mesh* mesh) {
  const MatrixRows layout =
      mesh ? matrix_rows(*mesh) : matrix_rows(rom::read_dof_map(files.dofs), files.dofs.string());
  const std::string source = mesh ? "the mesh (three a node)" : files.dofs.string();
  SparseMatrix K = read_sized(files.K, layout.dofs.size(), source);
  SparseMatrix M = read_sized(files.M, layout.dofs.size(), source);

  std::vector<int32_t> coordinate(layout.dofs.size(), -1), kept;
  for (size_t j = 0; j < coordinate.size(); ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    if (K.coeff(row, row) >= kHeldStiffness) continue;
    coordinate[j] = static_cast<int32_t>(kept.size());
    kept.push_back(static_cast<int32_t>(j));
  }
  if (kept.empty())
    throw InputError(fmt::format("{}: found every DoF held, expected some free", files.K.string()));
  const auto size = static_cast<int32_t>(kept.size());
  scale(K, files.units.force() / files.units.length, files.units.length, layout.dofs);
  scale(M, files.units.mass, files.units.length, layout.dofs);

  BuiltModel built;
  fe::FeModel& model = built.model;
  model.name = !files.name.empty() ? files.name : mesh ? mesh->name : files.K.stem().string();
  model.alpha = files.alpha;
  model.beta = files.beta;
  const Eigen::MatrixXd rigid = rigid_motions(layout.dofs);
  model.mass = mass_of(M, rigid);
  model.K = rows_and_columns(K, coordinate, size);
  model.M = rows_and_columns(M, coordinate, size);
  model.rigid = rigid(kept, Eigen::all);
  model.nodes = layout.nodes;
  model.T = displacement_of(layout, coordinate, size);
  model.sets = sets_of(layout, coordinate);
  if (mesh) model.surfaces = mesh->surfaces;
  // The other program's units and numbers are those of the deck for exports.
  model.deck.units = files.units.name;
  for (const rom::MappedDof& dof : layout.dofs)
    model.deck.largest_node = std::max(model.deck.largest_node, dof.node);
  const auto held = static_cast<double>(coordinate.size() - kept.size());
  built.certificate.dofs = size;
  built.certificate.held_dofs = held;
  if (held == 0.0) built.certificate.rigid_force_residue = rigid_residue(K, rigid);
  return built;
}

}  // namespace clatter::assembly
