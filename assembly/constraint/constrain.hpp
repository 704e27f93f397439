// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// From a recipe's couplings, equations and supports to the transformation and the named sets.
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "assembly/constraint/elimination.hpp"
#include "assembly/constraint/part_data.hpp"
#include "assembly/constraint/support.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// The constrained model's coordinates.
struct Constrained {
  Elimination elimination;
  Eigen::MatrixXd rigid;     // n x 6: unit rigid motions in coordinates q
  Eigen::MatrixXd rigid_s;   // n_s x 6: the same in supported coordinates
  Eigen::MatrixXd grounded;  // k x 6: rigid motions c with grounded c = 0 satisfy all equations and
                             // stretch no spring
  std::vector<Functional> springs;      // elongation of each [[spring]]
  std::vector<Functional> matrix_dofs;  // of each [[matrix]]: one id per row
  std::vector<int32_t> rigid_of_node;   // n_nodes: id of the rigid body that it belongs to, or -1
  std::vector<int32_t> rigid_of_turning_node;  // the same where its rotations belong to it too
  std::map<std::string, rom::DofSet> sets;
  std::map<std::string, rom::ContactGrid> grids;
  std::vector<HeldDof> held;    // n_s, in the order of the supported coordinates
  Eigen::MatrixXd nodal_rigid;  // n_dofs x 6: unit rigid motions of nodes and points
};

/// InputError for what does not fit the mesh, for conflicts and cycles (naming both relations) and
/// for points with nothing attached.
Constrained constrain(const PartData& part);

}  // namespace clatter::assembly
