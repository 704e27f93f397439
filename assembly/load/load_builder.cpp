// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/load_builder.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "assembly/load/centrifugal_load.hpp"
#include "assembly/load/load_case.hpp"
#include "assembly/load/point_mass.hpp"
#include "assembly/load/thermal_load.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::assembly {
namespace {

constexpr double kSameDirection = 1e-9;

}  // namespace

int32_t LoadBuilder::point_named(const std::string& name) const {
  for (size_t p = 0; p < recipe_.points.size(); ++p)
    if (recipe_.points[p].point.name == name) return static_cast<int32_t>(p);
  return -1;
}

/// rho a on the elements, m a on the masses of points.
void LoadBuilder::add_body_force(const Eigen::Vector3d& acceleration,
                                 Eigen::VectorXd& forces) const {
  forces.head(momentum_.rows()) += momentum_ * acceleration;
  for (const PointMassSpec& spec : recipe_.point_masses) {
    const int32_t point = point_named(spec.on);
    if (point < 0) continue;
    const Eigen::Vector3d weight = spec.mass * acceleration;
    const Eigen::Vector3d moment = spec.offset.cross(weight);
    for (int d = 0; d < 3; ++d) {
      forces(numbers_.of_point(point, d)) += weight(d);
      forces(numbers_.of_point(point, d + 3)) += moment(d);
    }
  }
}

/// rho r on the elements, m r on the masses of points, r from the axis.
void LoadBuilder::add_centrifugal(const LoadSpec& load, Eigen::VectorXd& forces) const {
  forces.head(3 * mesh_.nodes.rows()) =
      centrifugal_load(mesh_, recipe_.materials, load.axis, load.rotating);
  if (!load.rotating.empty()) return;
  for (const PointMassSpec& spec : recipe_.point_masses) {
    const int32_t point = point_named(spec.on);
    if (point < 0) continue;
    const Eigen::Vector3d position = recipe_.points[static_cast<size_t>(point)].point.position;
    const auto force = centrifugal_force(spec, position, load.axis);
    for (int d = 0; d < 6; ++d) forces(numbers_.of_point(point, d)) += force(d);
  }
}

/// Temperatures at the nodes above the stress-free state [K].
Eigen::VectorXd LoadBuilder::temperature_rise(const LoadSpec& load) const {
  if (load.field.empty()) return Eigen::VectorXd::Constant(mesh_.nodes.rows(), load.value);
  return mesh_.fields.at(load.field).col(0).array() - load.value;
}

/// Forces on nodes and points (n_dofs).
Eigen::VectorXd LoadBuilder::forces(const LoadSpec& load) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(numbers_.count());
  const Eigen::Index n_nodes = mesh_.nodes.rows();
  switch (load.kind) {
    case LoadSpec::Kind::kPressure:
      forces.head(3 * n_nodes) = pressure_load(n_nodes, surfaces_.at(load.surface));
      break;
    case LoadSpec::Kind::kResultant:
      forces.head(3 * n_nodes) = resultant_load(n_nodes, surfaces_.at(load.surface), load.force);
      break;
    case LoadSpec::Kind::kForce:
      if (const int32_t point = point_named(load.set); point >= 0) {
        for (int d = 0; d < 3; ++d) {
          forces(numbers_.of_point(point, d)) = load.force(d);
          forces(numbers_.of_point(point, d + 3)) = load.moment(d);
        }
      }
      break;
    case LoadSpec::Kind::kGravity:
      add_body_force(load.force, forces);
      break;
    case LoadSpec::Kind::kCentrifugal:
      add_centrifugal(load, forces);
      break;
    case LoadSpec::Kind::kNodal: {
      const RowMatrix& field = mesh_.fields.at(load.field);
      forces.head(3 * n_nodes) =
          load.value * Eigen::Map<const Eigen::VectorXd>(field.data(), field.size());
      break;
    }
    case LoadSpec::Kind::kTemperature:
      forces.head(3 * n_nodes) = thermal_load(mesh_, recipe_.materials, temperature_rise(load));
      break;
    case LoadSpec::Kind::kDisplacement:
      break;
  }
  return forces;
}

/// Loads on sets: a force, and the weight of point masses.
void LoadBuilder::add_to_sets(const fe::FeModel& model, const LoadSpec& load,
                              Eigen::VectorXd& f) const {
  if (load.kind == LoadSpec::Kind::kForce && point_named(load.set) < 0)
    f += set_load(f.size(), model.sets.at(load.set), load.force, load.moment, load.where);
  if (load.kind == LoadSpec::Kind::kCentrifugal && load.rotating.empty()) {
    for (const PointMassSpec& spec : recipe_.point_masses) {
      if (point_named(spec.on) >= 0) continue;
      const rom::DofSet& set = model.sets.at(spec.on);
      if (!has_rotations(set) && set.dofs.size() > 3)
        throw InputError(
            fmt::format("{}: found a mass shared by {} nodes ({}), expected one node "
                        "for each mass of a rotating part",
                        load.where, set.dofs.size() / 3, spec.where));
      const auto force = centrifugal_force(spec, set.position.row(0).transpose(), load.axis);
      f += set_load(f.size(), set, force.head<3>(), force.tail<3>(), load.where);
    }
  }
  if (load.kind != LoadSpec::Kind::kGravity) return;
  for (const PointMassSpec& spec : recipe_.point_masses) {
    if (point_named(spec.on) >= 0) continue;
    const Eigen::Vector3d weight = spec.mass * load.force;
    f += set_load(f.size(), model.sets.at(spec.on), weight, spec.offset.cross(weight), load.where);
  }
}

/// s of a prescribed displacement; a support must hold each requested direction.
Eigen::VectorXd LoadBuilder::prescribed(const LoadSpec& load) const {
  Eigen::VectorXd s = Eigen::VectorXd::Zero(constrained_.elimination.supports());
  for (const NodeOrPoint owner : selected(load.selection, mesh_, numbers_)) {
    const Eigen::Matrix3d axes = load.axes.at(numbers_.position(owner));
    for (const int d : load.directions) {
      const int32_t id = numbers_.of(owner, d);
      Eigen::Index match = -1;
      for (size_t k = 0; k < constrained_.held.size(); ++k) {
        const HeldDof& held = constrained_.held[k];
        if (numbers_.of(held.owner, held.is_rotation ? 3 + d % 3 : d % 3) != id) continue;
        const double along = held.direction.dot(axes.col(d % 3));
        if (std::abs(along) < 1.0 - kSameDirection) continue;
        match = static_cast<Eigen::Index>(k);
        s(match) = along > 0.0 ? load.value : -load.value;
      }
      if (match < 0)
        throw InputError(fmt::format("{}: found {}, which no support holds, expected one that does",
                                     load.where, numbers_.name(id, mesh_.node_ids)));
    }
  }
  return s;
}

/// True when every DoF with a force is a coordinate, is held, or depends on coordinates.
bool LoadBuilder::all_attached(const Eigen::VectorXd& forces) const {
  const Elimination& e = constrained_.elimination;
  Eigen::VectorXd most = Eigen::VectorXd::Zero(forces.size());
  for (const SparseMatrix* T : {&e.T, &e.T_s})
    for (int j = 0; j < T->outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(*T, j); it; ++it)
        most[it.row()] = std::max(most[it.row()], std::abs(it.value()));
  return ((forces.array() == 0.0) || (most.array() > 0.0)).all();
}

void LoadBuilder::build(fe::FeModel& model) {
  const Elimination& e = constrained_.elimination;
  for (const LoadSpec& load : recipe_.loads) {
    const Eigen::VectorXd all = forces(load);
    Eigen::VectorXd f = e.T.transpose() * all;
    const Eigen::VectorXd f_s = e.T_s.transpose() * all;
    add_to_sets(model, load, f);
    const Eigen::VectorXd resultant =
        model.rigid.transpose() * f + constrained_.rigid_s.transpose() * f_s;
    // Not checked by the resultant, of which an equation may carry a part.
    if (load.kind == LoadSpec::Kind::kForce && point_named(load.set) >= 0 && !all_attached(all))
      throw InputError(fmt::format(
          "{}: found a load on a direction of {} with nothing attached, expected a coupling",
          load.where, load.set));
    say(fmt::format("load {}: resultant ({:.5g}, {:.5g}, {:.5g}) N per unit of {}", load.name,
                    resultant(0), resultant(1), resultant(2), load.unit));
    model.loads[load.name] = std::move(f);
    model.load_units[load.name] = load.unit;
    if (e.supports() > 0) model.support_loads[load.name] = f_s;
    if (load.kind == LoadSpec::Kind::kDisplacement) model.prescribed[load.name] = prescribed(load);
    if (load.kind == LoadSpec::Kind::kTemperature)
      model.temperature_rise[load.name] = temperature_rise(load);
  }
  model.cases = recipe_.cases;
}

}  // namespace clatter::assembly
