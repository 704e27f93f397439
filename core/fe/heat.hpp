// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Steady heat conduction, div (k grad T) + s = 0, on the cells of a mesh:
//
//   K T = q,   K = int grad N^T k grad N dV + int h N^T N dS,
//   q = int N^T s dV + int N^T q'' dS + int h T_f N^T dS
//
// with conductivity k, heat source s, heat flux q'' into the part, and a film of coefficient h to a
// fluid of temperature T_f (Zienkiewicz and Taylor, vol. 1). Integration points are those of the
// full stiffness rules (element.hpp), whatever the material selects for its stiffness; temperatures
// are interpolated by the shape functions of the nodes: error of order 2 with linear cells, 3 with
// quadratic ones.
#include <Eigen/Core>
#include <functional>
#include <variant>
#include <vector>

#include "core/base/sparse.hpp"
#include "core/fe/material.hpp"
#include "core/fe/pattern.hpp"
#include "core/fe/shell_section.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::fe {

/// int grad N^T k grad N dV of one cell with node coordinates `x` (n x 3 [m]), n x n [W/K], both
/// triangles. InputError for an inverted cell.
Eigen::MatrixXd cell_conduction(mesh::CellType type, const mesh::CellNodes& x,
                                const Material& material);

/// The sum over all cells, n_nodes x n_nodes, lower triangle [W/K]; rows sum to zero. `materials`
/// has one entry per region. InputError for an inverted cell.
SparseMatrix conduction(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                        const NodePattern& pattern);

/// int N^T s dV (n_nodes) [W] of a source s [W/m3] that is constant in each region; `source` has
/// one entry per region.
Eigen::VectorXd volume_heat(const mesh::Mesh& mesh, const std::vector<double>& source);

/// Conduction along the shells of a mesh, whose temperature is the same through their thickness:
/// int grad N^T (sum k t) grad N dA over the middle of the sheet, layers in parallel, n_nodes x
/// n_nodes, lower triangle [W/K]; rows sum to zero.
SparseMatrix sheet_conduction(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                              const std::vector<ShellSection>& sections);

/// int N^T s t dA (n_nodes) [W] of a source s [W/m3] in the shells of each region.
Eigen::VectorXd sheet_heat(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                           const std::vector<ShellSection>& sections,
                           const std::vector<double>& source);

/// A value on a surface: at a position [m], or at each node of the mesh (n_nodes, of which those of
/// the surface are used), between them by the shape functions of the faces.
using SurfaceValue = std::variant<std::function<double(const Eigen::Vector3d&)>, Eigen::VectorXd>;

/// Terms of a surface: the heat that enters the part through it is sum(q - H T) [W].
struct SurfaceHeat {
  SparseMatrix H;     // int h N^T N dS, n_nodes x n_nodes, lower triangle [W/K]
  Eigen::VectorXd q;  // int h T_f N^T dS, n_nodes [W]
};

/// A film to a fluid. @param nodes n_nodes x 3 [m]. @param coefficient h [W/(m2 K)].
/// @param temperature T_f of the fluid [K].
SurfaceHeat film_heat(const RowMatrix& nodes, const mesh::Surface& surface,
                      const SurfaceValue& coefficient, const SurfaceValue& temperature);

/// int N^T q'' dS (n_nodes) [W] of a flux q'' into the part [W/m2].
Eigen::VectorXd flux_heat(const RowMatrix& nodes, const mesh::Surface& surface,
                          const SurfaceValue& flux);

}  // namespace clatter::fe
