// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/dependent_rows.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Transforms rows t so that each has its own pivot column (1 there, 0 in the other rows), by
// elimination with the largest pivots. Returns the pivots.
std::vector<int> reduce_rows(std::vector<Vector3d>& rows) {
  std::vector<int> pivots;
  for (size_t i = 0; i < rows.size(); ++i) {
    Eigen::Index pivot = 0;
    rows[i].cwiseAbs().maxCoeff(&pivot);
    rows[i] /= rows[i][pivot];
    for (size_t j = 0; j < rows.size(); ++j) {
      if (j != i) rows[j] -= rows[j][pivot] * rows[i];
    }
    for (size_t j = 0; j < rows.size(); ++j) {
      if (j != i) rows[j][pivot] = 0.0;
    }
    pivots.push_back(static_cast<int>(pivot));
  }
  return pivots;
}

}  // namespace

std::vector<DependentRow> dependent_rows(const Model& model, NodeIndex dependent, DofMask dofs,
                                         Origin origin) {
  const Matrix3d axes = model.systems.directions(model.node_map.displacement_system(dependent),
                                                 model.node_map.position(dependent), origin);
  std::vector<DependentRow> out;
  for (const int base : {0, 3}) {
    if (base == 3 && !model.node_map.turns(dependent)) break;
    std::vector<Vector3d> rows;
    for (int k = 0; k < 3; ++k) {
      if (dofs >> (base + k) & 1) rows.push_back(axes.col(k));
    }
    const std::vector<int> pivots = reduce_rows(rows);
    for (size_t i = 0; i < rows.size(); ++i) {
      DependentRow row{base, rows[i], {}};
      row.equation.where = model.source.where(origin);
      add_term(row.equation.terms, dependent, base + pivots[i], 1.0);
      for (int k = 0; k < 3; ++k) {
        if (k != pivots[i]) add_term(row.equation.terms, dependent, base + k, rows[i][k]);
      }
      out.push_back(std::move(row));
    }
  }
  return out;
}

}  // namespace clatter::mesh::deck::nastran
