// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/generalised.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assembly/constraint/coupling_members.hpp"
#include "assembly/coupling/contact_patch.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::assembly {
namespace {

constexpr double kNoPart = 1e-12;  // of a unit vector: rounding of its axes

/// The motions of new coordinates that are functionals of nodes' and points' DoFs.
void append_motions(const std::vector<Functional>& functionals, const Eigen::MatrixXd& nodal_rigid,
                    Motions& motions) {
  for (const Functional& functional : functionals) {
    Eigen::RowVectorXd motion = Eigen::RowVectorXd::Zero(6);
    for (size_t k = 0; k < functional.dofs.size(); ++k)
      motion += functional.values[k] * nodal_rigid.row(functional.dofs[k]);
    motions.push_back(motion);
  }
}

/// DoFs of sensors, node sets and points, and own ones of reduced parts: they stay coordinates.
std::vector<int32_t> kept_dofs(const PartData& part, const Relations& relations) {
  std::vector<int32_t> kept;
  for (const std::vector<KeptDof>& set : relations.kept)
    for (const KeptDof& dof : set)
      for (const int32_t id : ids_around(dof, part.numbers)) kept.push_back(id);
  for (size_t p = 0; p < part.numbers.points().size(); ++p)
    for (const int32_t id : point_dofs(part.numbers, static_cast<int32_t>(p)).ids)
      kept.push_back(id);
  for (int64_t id = part.numbers.first_own(); id < part.numbers.count(); ++id)
    kept.push_back(static_cast<int32_t>(id));
  return kept;
}

}  // namespace

HeldById aligned_supports(const std::vector<HeldGroup>& supports, const DofNumbers& numbers) {
  HeldById by_id;
  for (const HeldGroup& group : supports)
    for (const HeldDof& held : group.held)
      if (group.along_axes) {
        // The coordinate counts along the basic axis, also where the system's points against it.
        const Functional along = held_functional(held, numbers);
        HeldDof& own = by_id[along.dofs[0]] = held;
        if (along.values[0] < 0.0) own.direction = -own.direction;
      }
  return by_id;
}

Eliminator eliminate_dependences(const PartData& part, const Relations& relations,
                                 const HeldById& aligned) {
  std::vector<int32_t> fixed;
  for (const auto& [id, held] : aligned) fixed.push_back(id);
  const DofNumbers& numbers = part.numbers;
  Eliminator eliminator(numbers.count(), fixed, kept_dofs(part, relations));
  for (size_t p = 0; p < numbers.points().size(); ++p)  // what points share with their nodes
    for (int d = 0; d < 6; ++d) {
      const auto own = static_cast<int32_t>(numbers.nodal() + 6 * static_cast<int64_t>(p)) + d;
      if (numbers.of_point(static_cast<int32_t>(p), d) != own) eliminator.drop(own);
    }
  for (const PartSpec& spec : part.recipe.parts)
    for (const auto& [node, direction] : spec.without)
      eliminator.drop(numbers.of(NodeOrPoint::of_node(node), direction));
  eliminator.add_coordinates(6 * static_cast<int>(relations.references.size()));
  eliminator.add_coordinates(static_cast<int>(relations.bolts.size()));
  for (const Dependence& one : relations.dependences) eliminator.depend(one.dof, one.on);
  return eliminator;
}

Motions own_motions(const PartData& part, const Relations& relations) {
  Motions motions;
  for (const CouplingSpec& spec : part.recipe.couplings) {  // in the order of their ids
    if (!spec.rigid || !spec.on_point.empty()) continue;
    const Eigen::Vector3d& position = relations.references.at(spec.name).position;
    Eigen::Matrix<double, 6, 6> motion = Eigen::Matrix<double, 6, 6>::Identity();
    motion.topRows<3>() = rigid_motion(position);
    for (int d = 0; d < 6; ++d) motions.emplace_back(motion.row(d));
  }
  motions.resize(motions.size() + relations.bolts.size(), Eigen::RowVectorXd::Zero(6));
  return motions;
}

ObliqueSupports hold_oblique(const PartData& part, const std::vector<HeldGroup>& supports,
                             Owners owners, const Eigen::MatrixXd& nodal_rigid,
                             Eliminator& eliminator) {
  ObliqueSupports oblique;
  for (const HeldGroup& group : supports) {
    if (group.along_axes || group.held[0].owner.is_point() != (owners == Owners::kPoints)) continue;
    std::vector<Functional> rows;
    for (const HeldDof& held : group.held) rows.push_back(held_functional(held, part.numbers));
    const SupportSpec& spec = part.recipe.supports[group.held[0].support];
    const int32_t first = eliminator.hold(rows, spec.where + ": " + group.held[0].label);
    for (size_t k = 0; k < group.held.size(); ++k)
      oblique.held[first + static_cast<int32_t>(k)] = group.held[k];
    append_motions(rows, nodal_rigid, oblique.motions);
  }
  return oblique;
}

TurnedCoordinates turn_kept(const PartData& part, const Relations& relations,
                            const Eigen::MatrixXd& nodal_rigid, Eliminator& eliminator) {
  TurnedCoordinates all;
  for (size_t s = 0; s < relations.kept.size(); ++s) {
    const std::vector<KeptDof>& kept = relations.kept[s];
    std::vector<int32_t> ids;
    for (size_t k = 0; k < kept.size();) {
      size_t end = k;  // of the displacements, or of the rotations, of one node or point
      const auto around = ids_around(kept[k], part.numbers);
      while (end < kept.size() && kept[end].turned && ids_around(kept[end], part.numbers) == around)
        ++end;
      if (end == k) {
        ids.push_back(around[0]);
        ++k;
        continue;
      }
      const auto loose =
          std::ranges::count_if(around, [&](int32_t id) { return eliminator.is_dropped(id); });
      const std::string& where = part.recipe.nodes[s].where;
      if (loose != 0 && loose != 3)
        throw InputError(
            fmt::format("{}: {}: nothing is attached to some of its directions, expected it kept "
                        "along x y z: without system",
                        where, part.numbers.name(around[0], part.mesh.node_ids)));
      std::vector<Functional> rows;
      for (; k < end; ++k) {
        rows.emplace_back();
        for (int d = 0; d < 3; ++d) {
          if (std::abs(kept[k].along[d]) < kNoPart) continue;
          rows.back().dofs.push_back(around[d]);
          rows.back().values.push_back(kept[k].along[d]);
        }
      }
      const int32_t first = loose != 0 ? around[0] : eliminator.turn(rows, where);
      for (size_t r = 0; r < rows.size(); ++r)
        ids.push_back(loose != 0 ? first : first + static_cast<int32_t>(r));
      if (loose == 0) append_motions(rows, nodal_rigid, all.motions);
    }
    all.ids.push_back(std::move(ids));
  }
  return all;
}

Motions couple_onto_points(const PartData& part, const std::vector<OntoPoint>& couplings,
                           const Eigen::MatrixXd& nodal_rigid, Eliminator& eliminator) {
  Motions motions;
  for (const OntoPoint& onto : couplings) {
    append_motions(onto.coupling.means, nodal_rigid, motions);
    if (eliminator.add_onto(onto.coupling, onto.ids, onto.where)) continue;
    const std::vector<Functional> rows = onto.coupling.nodal_rows();
    for (size_t k = 0; k < rows.size(); ++k) {
      if (eliminator.is_held(onto.ids[k]))
        throw InputError(
            fmt::format("{}: found {} held by a support although other couplings already determine "
                        "it, expected one of them",
                        onto.where, part.numbers.name(onto.ids[k], part.mesh.node_ids)));
      eliminator.depend(onto.ids[k], rows[k]);
    }
  }
  return motions;
}

GeneralisedSets couple_faces(const PartData& part, const Eigen::MatrixXd& nodal_rigid,
                             Eliminator& eliminator) {
  const Recipe& recipe = part.recipe;
  GeneralisedSets all;
  const auto add = [&](const std::string& name, const Coupling& coupling,
                       const std::string& where) {
    const int32_t first = eliminator.add(coupling, where);
    rom::DofSet set = coupling.set;
    for (size_t k = 0; k < coupling.rows.size(); ++k)
      set.dofs.push_back(first + static_cast<int32_t>(k));
    append_motions(coupling.means, nodal_rigid, all.motions);
    append_motions(coupling.nodal_rows(), nodal_rigid, all.motions);
    all.sets[name] = std::move(set);
  };
  for (const CouplingSpec& spec : recipe.couplings) {
    if (spec.rigid || !spec.on_point.empty()) continue;
    const std::vector<Member> coupled = coupling_members(part, spec);
    const Eigen::Vector3d at = reference_position(spec, coupled);
    Coupling coupling = distribute(coupled, at, spec.directions, spec.where);
    coupling.set = reference_set(spec.name, spec.kind, at, spec.directions);
    add(spec.name, coupling, spec.where);
  }
  for (const ContactSpec& spec : recipe.contacts) {
    const PatchCoupling patches = contact_patches(
        spec.name, part.mesh.nodes, part.surfaces.at(spec.surface), spec.grid, spec.where);
    add(spec.name, patches.coupling, spec.where);
    all.grids[spec.name] = patches.grid;
    say(fmt::format("{}: {} strips x {} rows on radius {:.5f} m, {} to {} nodes per patch",
                    spec.name, patches.grid.angle.size(), patches.grid.axial.size(),
                    patches.grid.radius, patches.nodes_per_patch.minCoeff(),
                    patches.nodes_per_patch.maxCoeff()));
  }
  for (const MeanSpec& spec : recipe.means)
    add(spec.name,
        mean_displacement(spec.name, part.mesh.nodes, part.surfaces.at(spec.surface),
                          spec.direction, spec.range, spec.where),
        spec.where);
  return all;
}

}  // namespace clatter::assembly
