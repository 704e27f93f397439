// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Integrals over the mass of a mesh: integration points shared by mass properties and body forces.
#include <Eigen/LU>
#include <vector>

#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::assembly {

/// Calls visit(c, N, x, dm) at each point of each cell c of a block: N the values of the shape
/// functions there, x the position [m], dm = density weight det J [kg]. Sums over it are exact for
/// polynomials of x up to x x^T: det J has at most the degrees that cube_bernstein.cpp lists, x
/// adds its own twice.
template <class Visit>
void for_each_mass_point(const mesh::Mesh& mesh, const mesh::CellBlock& block, double density,
                         Visit&& visit) {
  const mesh::CellRule& rule = mesh::fine_rule(block.type);
  std::vector<mesh::CellShape> shapes;
  for (const auto& point : rule.points.rowwise())
    shapes.push_back(mesh::cell_shape(block.type, point.transpose()));
  for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
    const mesh::CellNodes x = mesh::cell_nodes(mesh, block, c);
    for (size_t q = 0; q < shapes.size(); ++q) {
      const Eigen::Vector3d at = x.transpose() * shapes[q].value;
      const Eigen::Matrix3d J = x.transpose() * shapes[q].gradient;
      visit(c, shapes[q].value, at,
            density * rule.weights(static_cast<Eigen::Index>(q)) * J.determinant());
    }
  }
}

}  // namespace clatter::assembly
