// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The relations of a recipe: gathered and checked against one another before any is eliminated.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "assembly/constraint/part_data.hpp"
#include "assembly/constraint/support.hpp"
#include "assembly/coupling/coupling.hpp"
#include "assembly/coupling/rigid_coupling.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// A distributing coupling onto a [[point]].
struct OntoPoint {
  Coupling coupling;
  std::vector<int32_t> ids;  // of the point's DoFs, one per row of the coupling
  std::string where;
};

/// A DoF of a [[nodes]] or [[sensor]], which stays a coordinate.
struct KeptDof {
  NodeOrPoint owner;
  int direction = 0;
  int32_t number = 0;  // of the node or point in its set
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  bool turned = false;  // `along` is a direction of a system other than the basic one
};

/// The ids of the DoFs x y z, or rx ry rz, of which a kept one is a combination.
std::array<int32_t, 3> ids_around(const KeptDof& dof, const DofNumbers& numbers);

/// All relations. The DoFs of own reference nodes have the ids after those of nodes and points, six
/// for each rigid coupling; the bolts' shortenings have the next ones; both in the recipe's order.
struct Relations {
  std::vector<HeldGroup> supports;
  std::vector<std::vector<KeptDof>> kept;           // of each [[nodes]] and [[sensor]]
  std::map<std::string, ReferenceDofs> references;  // own ones of rigid couplings, by coupling
  std::vector<OntoPoint> onto_points;
  std::vector<Functional> springs;           // elongation of each [[spring]]
  std::vector<Functional> matrix_dofs;       // of each [[matrix]]: one id per row
  std::map<std::string, rom::DofSet> bolts;  // the shortening of each; its DoF is an id
  std::vector<Dependence> dependences;       // each after those that it depends on
};

/// InputError for what does not fit the mesh, for conflicts and cycles (naming both relations).
Relations gather_relations(const PartData& part);

/// The id of the rigid body of each node, or -1: cells between nodes of one body do not deform.
/// @param references own reference nodes, by coupling.
/// @param directions that belong to it: 3, displacements, or 6, rotations too. @return n_nodes.
std::vector<int32_t> rigid_body_of_nodes(const PartData& part,
                                         const std::map<std::string, ReferenceDofs>& references,
                                         int directions);

/// Values of equations, elongations of springs and forces of stiffness matrices for the six unit
/// rigid motions, each relative to its largest term; those that are zero for each motion are left
/// out.
/// @param nodal_rigid n_dofs x 6: unit rigid motions of nodes and points. @return k x 6.
Eigen::MatrixXd grounded_motions(const PartData& part, const Eigen::MatrixXd& nodal_rigid);

}  // namespace clatter::assembly
