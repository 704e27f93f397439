// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/constrain.hpp"

#include <iterator>

#include "assembly/constraint/dof_sets.hpp"
#include "assembly/constraint/generalised.hpp"
#include "assembly/constraint/relations.hpp"
#include "assembly/constraint/unattached.hpp"

namespace clatter::assembly {
namespace {

/// Unit rigid motions of all nodes, points, rotations of nodes and coordinates of reduced parts.
Eigen::MatrixXd rigid_of(const PartData& part) {
  const RowMatrix& nodes = part.mesh.nodes;
  const DofNumbers& numbers = part.numbers;
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(numbers.count(), 6);
  for (Eigen::Index a = 0; a < nodes.rows(); ++a)
    rigid.middleRows<3>(3 * a) = rigid_motion(nodes.row(a).transpose());
  for (size_t p = 0; p < numbers.points().size(); ++p) {
    if (numbers.points()[p].node >= 0) continue;
    const Eigen::Index row = numbers.nodal() + 6 * static_cast<Eigen::Index>(p);
    rigid.middleRows<3>(row) = rigid_motion(numbers.points()[p].position);
  }
  for (size_t p = 0; p < numbers.points().size(); ++p) {
    const Eigen::Index row = numbers.nodal() + 6 * static_cast<Eigen::Index>(p);
    rigid.block<3, 3>(row + 3, 3).setIdentity();
  }
  for (Eigen::Index row = numbers.first_rotation(); row < numbers.first_own(); row += 3)
    rigid.block<3, 3>(row, 3).setIdentity();
  for (const PartSpec& spec : part.recipe.parts)
    for (size_t j = 0; j < spec.coordinates.size(); ++j)
      if (const int32_t own = spec.coordinates[j].own; own >= 0)
        rigid.row(numbers.first_own() + own) = spec.model.rigid.row(static_cast<Eigen::Index>(j));
  return rigid;
}

/// Unit rigid motions in the coordinates of each number: reduced_of or support_of of an
/// elimination. @param count of these coordinates.
Eigen::MatrixXd rigid_in(const std::vector<int32_t>& number_of, int count,
                         const Eigen::MatrixXd& nodal_rigid, const Motions& generalised) {
  Eigen::MatrixXd rigid(count, 6);
  const auto given = static_cast<size_t>(nodal_rigid.rows());
  for (size_t id = 0; id < number_of.size(); ++id) {
    if (number_of[id] < 0) continue;
    rigid.row(number_of[id]) =
        id < given ? nodal_rigid.row(static_cast<Eigen::Index>(id)) : generalised[id - given];
  }
  return rigid;
}

/// The supported coordinates by their numbers.
std::vector<HeldDof> held_in_order(const Elimination& elimination, const HeldById& held) {
  std::vector<HeldDof> all(static_cast<size_t>(elimination.supports()));
  for (size_t id = 0; id < elimination.support_of.size(); ++id) {
    const int32_t number = elimination.support_of[id];
    if (number >= 0) all[number] = held.at(static_cast<int32_t>(id));
  }
  return all;
}

void append(Motions& all, Motions more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

Constrained constrain(const PartData& part) {
  Eigen::MatrixXd nodal_rigid = rigid_of(part);
  const Relations relations = gather_relations(part);

  HeldById held = aligned_supports(relations.supports, part.numbers);
  Eliminator eliminator = eliminate_dependences(part, relations, held);
  ObliqueSupports of_nodes =
      hold_oblique(part, relations.supports, Owners::kNodes, nodal_rigid, eliminator);
  Motions means = couple_onto_points(part, relations.onto_points, nodal_rigid, eliminator);
  ObliqueSupports of_points =
      hold_oblique(part, relations.supports, Owners::kPoints, nodal_rigid, eliminator);
  GeneralisedSets faces = couple_faces(part, nodal_rigid, eliminator);
  Motions linked = drop_unattached(part, relations, eliminator);
  TurnedCoordinates turned = turn_kept(part, relations, nodal_rigid, eliminator);
  const Elimination elimination = eliminator.finish();

  Motions motions = own_motions(part, relations);  // then in the order in which ids were added
  append(motions, std::move(of_nodes.motions));
  append(motions, std::move(means));
  append(motions, std::move(of_points.motions));
  append(motions, std::move(faces.motions));
  append(motions, std::move(linked));
  append(motions, std::move(turned.motions));
  for (const PartSpec& spec : part.recipe.parts)
    for (const auto& [name, grid] : spec.model.grids)
      if (spec.has(name)) faces.grids[spec.named(name)] = grid;
  held.merge(of_nodes.held);
  held.merge(of_points.held);
  return {.elimination = elimination,
          .rigid = rigid_in(elimination.reduced_of, elimination.size(), nodal_rigid, motions),
          .rigid_s = rigid_in(elimination.support_of, elimination.supports(), nodal_rigid, motions),
          .grounded = grounded_motions(part, nodal_rigid),
          .springs = relations.springs,
          .matrix_dofs = relations.matrix_dofs,
          .rigid_of_node = rigid_body_of_nodes(part, relations.references, 3),
          .rigid_of_turning_node = rigid_body_of_nodes(part, relations.references, 6),
          .sets = sets_of_coordinates(part, {relations, turned.ids}, faces.sets, elimination),
          .grids = std::move(faces.grids),
          .held = held_in_order(elimination, held),
          .nodal_rigid = std::move(nodal_rigid)};
}

}  // namespace clatter::assembly
