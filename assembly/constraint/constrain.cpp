// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/constrain.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "assembly/constraint/constrainer.hpp"
#include "assembly/coupling/contact_patch.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::assembly {
namespace {

/// Unit rigid motions of all nodes and points.
Eigen::MatrixXd rigid_of(const RowMatrix& nodes, const DofNumbers& numbers) {
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
  return rigid;
}

}  // namespace

/// Aligned supports first, then dependences, each after those that it depends on.
void Constrainer::start_elimination() {
  const std::vector<int32_t> order = graph_.order();
  std::vector<int32_t> fixed;
  for (const HeldGroup& group : supports_)
    for (const HeldDof& held : group.held) {
      if (!group.along_axes) continue;
      fixed.push_back(held_functional(held, numbers_).dofs[0]);
      held_of_[fixed.back()] = held;
    }
  for (size_t p = 0; p < numbers_.points().size(); ++p)
    for (const int32_t id : point_dofs(static_cast<int32_t>(p)).ids) kept_.push_back(id);
  eliminator_ = std::make_unique<Eliminator>(numbers_.count(), fixed, kept_);
  for (size_t p = 0; p < numbers_.points().size(); ++p)  // displacements of points on nodes
    for (int d = 0; d < 3 && numbers_.points()[p].node >= 0; ++d)
      eliminator_->drop(static_cast<int32_t>(numbers_.nodal() + 6 * static_cast<int64_t>(p)) + d);
  for (const CouplingSpec& spec : recipe_.couplings) {  // in the order of their ids
    if (!spec.rigid || !spec.on_point.empty()) continue;
    eliminator_->add_coordinates(6);
    const Eigen::Vector3d& position = own_references_.at(spec.name).position;
    Eigen::Matrix<double, 6, 6> motion = Eigen::Matrix<double, 6, 6>::Identity();
    motion.topRows<3>() = rigid_motion(position);
    for (int d = 0; d < 6; ++d) motion_.emplace_back(motion.row(d));
  }
  for (const TieSpec& spec : recipe_.ties) {
    if (!spec.bolt) continue;
    eliminator_->add_coordinates(1);
    motion_.push_back(Eigen::RowVectorXd::Zero(6));
  }
  for (const int32_t dof : order) {
    const auto found = dependences_.find(dof);
    if (found != dependences_.end()) eliminator_->depend(dof, found->second);
  }
}

void Constrainer::append_motion(const std::vector<Functional>& functionals) {
  for (const Functional& functional : functionals) {
    Eigen::RowVectorXd motion = Eigen::RowVectorXd::Zero(6);
    for (size_t k = 0; k < functional.dofs.size(); ++k)
      motion += functional.values[k] * out_.nodal_rigid.row(functional.dofs[k]);
    motion_.push_back(motion);
  }
}

/// Supports in oblique directions: at nodes before faces are coupled, at points after.
void Constrainer::hold_oblique(bool points) {
  for (const HeldGroup& group : supports_) {
    if (group.along_axes || group.held[0].owner.is_point() != points) continue;
    std::vector<Functional> rows;
    for (const HeldDof& held : group.held) rows.push_back(held_functional(held, numbers_));
    const SupportSpec& spec = recipe_.supports[static_cast<size_t>(group.held[0].support)];
    const int32_t first =
        eliminator_->hold(rows, spec.selection.where + ": " + group.held[0].label);
    for (size_t k = 0; k < group.held.size(); ++k)
      held_of_[first + static_cast<int32_t>(k)] = group.held[k];
    append_motion(rows);
  }
}

/// The point's DoFs stay coordinates and displacements of the face are eliminated; where all DoFs
/// of the face are constrained, the point depends on those constraints.
void Constrainer::couple_onto_points() {
  for (const Onto& onto : onto_) {
    append_motion(onto.coupling.means);
    if (eliminator_->add_onto(onto.coupling, onto.ids, onto.where)) continue;
    const std::vector<Functional> rows = onto.coupling.nodal_rows();
    for (size_t k = 0; k < rows.size(); ++k) {
      if (eliminator_->is_held(onto.ids[k]))
        throw InputError(
            fmt::format("{}: found {} held by a support although other couplings already determine "
                        "it, expected one of them",
                        onto.where, numbers_.name(onto.ids[k], mesh_.node_ids)));
      eliminator_->depend(onto.ids[k], rows[k]);
    }
  }
}

void Constrainer::add_generalised(const std::string& name, const Coupling& coupling,
                                  const std::string& where) {
  const int32_t first = eliminator_->add(coupling, where);
  rom::DofSet set = coupling.set;
  for (size_t k = 0; k < coupling.rows.size(); ++k)
    set.dofs.push_back(first + static_cast<int32_t>(k));
  append_motion(coupling.means);
  append_motion(coupling.nodal_rows());
  out_.sets[name] = std::move(set);
}

void Constrainer::add_generalised_sets() {
  for (const CouplingSpec& spec : recipe_.couplings) {
    if (spec.rigid || !spec.on_point.empty()) continue;
    const std::vector<Member> coupled = members(spec);
    const Eigen::Vector3d at = own_position(spec, coupled);
    Coupling coupling = distribute(coupled, at, spec.directions, spec.where);
    coupling.set = reference_set(spec.name, spec.kind, at, spec.directions);
    add_generalised(spec.name, coupling, spec.where);
  }
  for (const ContactSpec& spec : recipe_.contacts) {
    const PatchCoupling patches =
        contact_patches(spec.name, mesh_.nodes, surfaces_.at(spec.surface), spec.grid, spec.where);
    add_generalised(spec.name, patches.coupling, spec.where);
    out_.grids[spec.name] = patches.grid;
    say(fmt::format("{}: {} strips x {} rows on radius {:.5f} m, {} to {} nodes per patch",
                    spec.name, patches.grid.angle.size(), patches.grid.axial.size(),
                    patches.grid.radius, patches.nodes_per_patch.minCoeff(),
                    patches.nodes_per_patch.maxCoeff()));
  }
  for (const MeanSpec& spec : recipe_.means)
    add_generalised(spec.name,
                    mean_displacement(spec.name, mesh_.nodes, surfaces_.at(spec.surface),
                                      spec.direction, spec.range, spec.where),
                    spec.where);
}

/// Ids with mass of a [[point_mass]] on a point or on the reference of a rigid coupling.
std::vector<bool> Constrainer::massive_ids() {
  std::vector<bool> massive(static_cast<size_t>(numbers_.count()) + 6 * own_references_.size());
  for (const PointMassSpec& spec : recipe_.point_masses) {
    const auto own = own_references_.find(spec.on);
    const bool is_point = std::any_of(recipe_.points.begin(), recipe_.points.end(),
                                      [&](const PointSpec& p) { return p.point.name == spec.on; });
    if (own == own_references_.end() && !is_point) continue;
    const ReferenceDofs reference = is_point ? point_dofs(point_named(spec.on)) : own->second;
    const bool turns = !spec.inertia.isZero(0.0) || !spec.offset.isZero(0.0);
    for (size_t d = 0; d < (turns ? 6 : 3); ++d)
      for (const int32_t id : eliminator_->express({{reference.ids[d]}, {1.0}}).dofs)
        if (static_cast<size_t>(id) < massive.size()) massive[static_cast<size_t>(id)] = true;
  }
  return massive;
}

void Constrainer::drop_unattached(const std::string& name, const std::string& where,
                                  const ReferenceDofs& reference, const std::vector<bool>& moves,
                                  const std::vector<bool>& massive) {
  std::vector<const char*> loose;
  bool attached = false;
  for (size_t d = 0; d < 6; ++d) {
    const int32_t id = reference.ids[d];
    attached = attached || moves[static_cast<size_t>(id)] || eliminator_->is_eliminated(id);
    if (!eliminator_->is_coordinate(id) || moves[static_cast<size_t>(id)]) continue;
    loose.push_back(kDofNames[d]);
    if (massive[static_cast<size_t>(id)])
      throw InputError(
          fmt::format("{}: found a mass on {} with nothing attached, expected a "
                      "coupling, an equation or a support",
                      where, kDofNames[d]));
    eliminator_->drop(id);
  }
  if (!attached)
    throw InputError(
        fmt::format("{}: found nothing attached to it, expected a coupling or an equation", where));
  if (!loose.empty())
    say(fmt::format("{}: {} omitted: nothing is attached", name, fmt::join(loose, " ")));
}

void Constrainer::drop_unattached() {
  std::vector<bool> moves = eliminator_->moves_nodes(numbers_.nodal());
  for (const Functional& spring : out_.springs) {
    for (const int32_t id : spring.dofs) moves[static_cast<size_t>(id)] = true;
    for (const int32_t id : eliminator_->express(spring).dofs)
      moves[static_cast<size_t>(id)] = true;
  }
  const std::vector<bool> massive = massive_ids();
  for (size_t p = 0; p < recipe_.points.size(); ++p)
    drop_unattached(recipe_.points[p].point.name, recipe_.points[p].where,
                    point_dofs(static_cast<int32_t>(p)), moves, massive);
  for (const CouplingSpec& spec : recipe_.couplings)
    if (own_references_.contains(spec.name))
      drop_unattached(spec.name, spec.where, own_references_.at(spec.name), moves, massive);
}

void Constrainer::number_node_sets() {
  for (size_t s = 0; s < recipe_.nodes.size(); ++s) {
    const NodeSpec& spec = recipe_.nodes[s];
    const std::vector<int32_t>& nodes = set_nodes_[s];
    rom::DofSet set;
    set.kind = spec.kind;
    const auto rows = 3 * static_cast<Eigen::Index>(nodes.size());
    set.position.resize(rows, 3);
    set.direction =
        Eigen::Matrix3d::Identity().replicate(static_cast<Eigen::Index>(nodes.size()), 1);
    set.is_rotation.assign(static_cast<size_t>(rows), 0);
    for (Eigen::Index r = 0; r < rows; ++r) {
      const int32_t node = nodes[static_cast<size_t>(r / 3)];
      set.dofs.push_back(static_cast<int32_t>(3 * node + r % 3));
      set.position.row(r) = mesh_.nodes.row(node);
      const char axis = "xyz"[r % 3];
      set.labels.push_back(nodes.size() == 1 ? fmt::format("{}.{}", spec.name, axis)
                                             : fmt::format("{}[{}].{}", spec.name, r / 3, axis));
    }
    out_.sets[spec.name] = std::move(set);
  }
}

/// Replaces the ids in sets by coordinates; ids that are no coordinates are removed.
void Constrainer::number_sets() {
  number_node_sets();
  for (size_t p = 0; p < recipe_.points.size(); ++p) {
    const ReferencePoint& point = recipe_.points[p].point;
    rom::DofSet set = reference_set(point.name, "node", point.position, {0, 1, 2, 3, 4, 5});
    const ReferenceDofs reference = point_dofs(static_cast<int32_t>(p));
    set.dofs.assign(reference.ids.begin(), reference.ids.end());
    out_.sets[point.name] = std::move(set);
  }
  for (const auto& [name, reference] : own_references_)
    out_.sets[name].dofs.assign(reference.ids.begin(), reference.ids.end());
  for (auto at = out_.sets.begin(); at != out_.sets.end();) {
    rom::DofSet& set = at->second;
    std::vector<Eigen::Index> rows;
    for (size_t k = 0; k < set.dofs.size(); ++k) {
      const int32_t reduced = out_.elimination.reduced_of[static_cast<size_t>(set.dofs[k])];
      if (reduced < 0) continue;
      const size_t to = rows.size();
      rows.push_back(static_cast<Eigen::Index>(k));
      set.dofs[to] = reduced;
      set.labels[to] = set.labels[k];
      set.is_rotation[to] = set.is_rotation[k];
    }
    set.dofs.resize(rows.size());
    set.labels.resize(rows.size());
    set.is_rotation.resize(rows.size());
    set.position = set.position(rows, Eigen::all).eval();
    set.direction = set.direction(rows, Eigen::all).eval();
    at = set.dofs.empty() ? out_.sets.erase(at) : std::next(at);
  }
}

void Constrainer::finish() {
  Elimination& e = out_.elimination;
  e = eliminator_->finish();
  out_.rigid.resize(e.size(), 6);
  out_.rigid_s.resize(e.supports(), 6);
  out_.held.resize(static_cast<size_t>(e.supports()));
  out_.grounded.resize(static_cast<Eigen::Index>(grounded_.size()), 6);
  for (size_t r = 0; r < grounded_.size(); ++r)
    out_.grounded.row(static_cast<Eigen::Index>(r)) = grounded_[r];
  const auto given = static_cast<size_t>(numbers_.count());
  for (size_t id = 0; id < e.reduced_of.size(); ++id) {
    if (e.reduced_of[id] < 0 && e.support_of[id] < 0) continue;
    const Eigen::RowVectorXd motion =
        id < given ? out_.nodal_rigid.row(static_cast<Eigen::Index>(id)) : motion_[id - given];
    if (e.reduced_of[id] >= 0) {
      out_.rigid.row(e.reduced_of[id]) = motion;
    } else {
      out_.rigid_s.row(e.support_of[id]) = motion;
      out_.held[static_cast<size_t>(e.support_of[id])] = held_of_.at(static_cast<int32_t>(id));
    }
  }
}

Constrained Constrainer::run() {
  out_.nodal_rigid = rigid_of(mesh_.nodes, numbers_);
  out_.rigid_of_node.assign(static_cast<size_t>(mesh_.nodes.rows()), -1);
  gather_supports();
  gather_node_sets();
  gather_couplings();
  gather_equations();
  gather_springs();
  gather_straight_edges();
  gather_ties();
  start_elimination();
  hold_oblique(false);
  couple_onto_points();
  hold_oblique(true);
  add_generalised_sets();
  drop_unattached();
  finish();
  number_sets();
  return std::move(out_);
}

Constrained constrain(const mesh::Mesh& mesh, const Recipe& recipe, const DofNumbers& numbers,
                      SurfaceCache& surfaces) {
  return Constrainer(mesh, recipe, numbers, surfaces).run();
}

}  // namespace clatter::assembly
