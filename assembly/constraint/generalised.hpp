// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The steps of an elimination that add generalised coordinates: own reference nodes, supports,
// couplings, patches, means. Each returns what its new coordinates are.
#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "assembly/constraint/elimination.hpp"
#include "assembly/constraint/part_data.hpp"
#include "assembly/constraint/relations.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// Generalised coordinates of the six unit rigid motions, one entry per id, ascending.
using Motions = std::vector<Eigen::RowVectorXd>;

/// Supported coordinates by id.
using HeldById = std::unordered_map<int32_t, HeldDof>;

/// The supports of nodes and points along the axes, each of which holds one DoF.
HeldById aligned_supports(const std::vector<HeldGroup>& supports, const DofNumbers& numbers);

/// An elimination with the aligned supports, the coordinates that stay, own reference nodes, bolts,
/// and all dependences.
Eliminator eliminate_dependences(const PartData& part, const Relations& relations,
                                 const HeldById& aligned);

/// The motions of own reference nodes and bolts, the first generalised coordinates.
Motions own_motions(const PartData& part, const Relations& relations);

/// Supports in directions off the axes.
struct ObliqueSupports {
  Motions motions;
  HeldById held;
};

/// What such supports hold.
enum class Owners { kNodes, kPoints };

/// Adds the oblique supports of nodes (before faces are coupled) or of points (after). InputError
/// when no displacement is left to eliminate.
/// @param nodal_rigid n_dofs x 6: unit rigid motions of nodes and points.
ObliqueSupports hold_oblique(const PartData& part, const std::vector<HeldGroup>& supports,
                             Owners owners, const Eigen::MatrixXd& nodal_rigid,
                             Eliminator& eliminator);

/// Kept coordinates along the axes of systems.
struct TurnedCoordinates {
  Motions motions;
  std::vector<std::vector<int32_t>> ids;  // of each DoF of Relations::kept
};

/// Replaces the displacements (rotations) of nodes and points that are kept along other axes than
/// x y z by the coordinates q = D u; what else D^T leaves of them remains in the model. After all
/// other relations. InputError when some of them are no coordinates.
TurnedCoordinates turn_kept(const PartData& part, const Relations& relations,
                            const Eigen::MatrixXd& nodal_rigid, Eliminator& eliminator);

/// Adds the couplings onto points: the point's DoFs stay coordinates and displacements of the face
/// are eliminated; where all DoFs of the face are constrained, the point depends on those
/// constraints. InputError when such a point is held by a support. Returns the motions of group
/// means.
Motions couple_onto_points(const PartData& part, const std::vector<OntoPoint>& couplings,
                           const Eigen::MatrixXd& nodal_rigid, Eliminator& eliminator);

/// Sets of generalised coordinates.
struct GeneralisedSets {
  Motions motions;
  std::map<std::string, rom::DofSet> sets;  // DoFs are ids
  std::map<std::string, rom::ContactGrid> grids;
};

/// Adds distributing couplings with their own reference, contact patches and means, in this order.
GeneralisedSets couple_faces(const PartData& part, const Eigen::MatrixXd& nodal_rigid,
                             Eliminator& eliminator);

}  // namespace clatter::assembly
