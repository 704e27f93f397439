// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The stiffness that a part has by its stress (geometric stiffness): a string that is pulled is
// stiffer across, a column that is pressed softer.
//
//   K_ij = int sigma : grad N_i (x) grad N_j dV I_3,   of shells with the membrane force N over the
//   mid-surface in place of sigma dV
//
// for small motions beside a state of small strains (Cook, Malkus, Plesha and Witt, "Concepts and
// Applications of Finite Element Analysis", 4th ed., ch. 18). The loads keep their directions. Of
// shells, moments and shear forces are left out: they are small beside the bending stiffness.
#include <filesystem>
#include <string>
#include <vector>

#include "core/fe/assemble_shells.hpp"
#include "core/fe/material.hpp"
#include "core/fe/pattern.hpp"
#include "core/fe/shell_section.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::fe {

/// A solved case by which a part is stressed.
struct Prestress {
  std::string of_case;
  RowMatrix displacement;           // n_nodes x 3 [m]
  std::vector<int32_t> turning;     // nodes of shells, ascending
  RowMatrix rotation;               // of each [rad]
  Eigen::VectorXd temperature;      // rise at each node [K]; or empty
  std::vector<std::string> points;  // names
  RowMatrix point_motion;           // x y z rx ry rz of each [m], [rad]
  double factor = 1.0;              // of the stress
};

/// Reads a case of a file of static results for a part with these nodes (n x 3 [m]).
/// @param of_case empty: the only one. InputError for other nodes, an unknown case, and several.
Prestress read_prestress(const std::filesystem::path& file, std::string of_case,
                         const RowMatrix& nodes);

/// Of the solids and shells of a mesh, ids.count x ids.count [N/m], lower triangle.
SparseMatrix geometric_stiffness(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                                 const std::vector<ShellSection>& sections,
                                 const NodePattern& pattern, const ShellIds& ids,
                                 const Prestress& state);

/// int N : grad h_i (x) grad h_j dA of a shell whose nodes moved by `u` (6n) and warmed by `dT`
/// (n, or empty) [N/m]; 6n x 6n.
ShellMatrix shell_geometric_stiffness(const ShellCell& cell, const Eigen::VectorXd& u,
                                      const Eigen::VectorXd& dT);

}  // namespace clatter::fe
