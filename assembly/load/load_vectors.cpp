// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/load_vectors.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "assembly/load/centrifugal_load.hpp"
#include "assembly/load/load_case.hpp"
#include "assembly/load/nodal_matrix.hpp"
#include "assembly/load/point_mass.hpp"
#include "assembly/load/thermal_load.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::assembly {
namespace {

constexpr double kSameDirection = 1e-9;

/// Index of the [[point]] of that name, or -1.
int32_t find_point(const Recipe& recipe, const std::string& name) {
  for (size_t p = 0; p < recipe.points.size(); ++p)
    if (recipe.points[p].point.name == name) return static_cast<int32_t>(p);
  return -1;
}

/// M a of the [[matrix]] tables on their displacements; `acceleration` at a position.
template <class Field>
void add_matrix_forces(const PartData& part, const Field& acceleration, Eigen::VectorXd& forces) {
  for (const MatrixSpec& spec : part.recipe.matrices) {
    if (!spec.is_mass) continue;
    const std::vector<MatrixRow> rows = rows_of(spec, part.mesh, part.numbers);
    Eigen::VectorXd a = Eigen::VectorXd::Zero(spec.values.rows());
    for (size_t i = 0; i < rows.size(); ++i)
      if (rows[i].direction < 3)
        a(static_cast<Eigen::Index>(i)) = acceleration(rows[i].position)(rows[i].direction);
    const Eigen::VectorXd f = spec.values * a;
    for (size_t i = 0; i < rows.size(); ++i) forces(rows[i].id) += f(static_cast<Eigen::Index>(i));
  }
}

/// rho a on the elements, m a on the masses of points.
Eigen::VectorXd body_force(const PartData& part, const Eigen::MatrixXd& momentum,
                           const Eigen::Vector3d& acceleration) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(part.numbers.count());
  forces.head(momentum.rows()) += momentum * acceleration;
  for (const PointMassSpec& spec : part.recipe.point_masses) {
    const int32_t point = find_point(part.recipe, spec.on);
    if (point < 0) continue;
    const Eigen::Vector3d weight = spec.mass * acceleration;
    const Eigen::Vector3d moment = spec.offset.cross(weight);
    for (int d = 0; d < 3; ++d) {
      forces(part.numbers.of_point(point, d)) += weight(d);
      forces(part.numbers.of_point(point, d + 3)) += moment(d);
    }
  }
  add_matrix_forces(
      part, [&](const Eigen::Vector3d&) { return acceleration; }, forces);
  return forces;
}

/// rho r on the elements, m r on the masses of points, r from the axis.
Eigen::VectorXd rotation_force(const PartData& part, const LoadSpec& load,
                               const LoadInputs& inputs) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(part.numbers.count());
  forces.head(3 * part.mesh.nodes.rows()) =
      centrifugal_load(part.mesh, part.recipe.materials, load.axis, load.rotating);
  if (const auto sheets = inputs.of_sheets.find(load.name); sheets != inputs.of_sheets.end())
    forces += sheets->second;
  if (!load.rotating.empty()) return forces;
  for (const PointMassSpec& spec : part.recipe.point_masses) {
    const int32_t point = find_point(part.recipe, spec.on);
    if (point < 0) continue;
    const Eigen::Vector3d position = part.recipe.points[point].point.position;
    const auto force = centrifugal_force(spec, position, load.axis);
    for (int d = 0; d < 6; ++d) forces(part.numbers.of_point(point, d)) += force(d);
  }
  add_matrix_forces(
      part, [&](const Eigen::Vector3d& at) { return load.axis.arm(at); }, forces);
  return forces;
}

/// Temperatures at the nodes above the stress-free state [K].
Eigen::VectorXd temperature_rise(const mesh::Mesh& mesh, const LoadSpec& load,
                                 const HeatFields& heat) {
  if (load.node_rises.size() > 0) return load.node_rises;
  if (!load.heat.empty()) return heat.at(load.heat).temperature.array() - load.amount;
  if (load.field.empty()) return Eigen::VectorXd::Constant(mesh.nodes.rows(), load.amount);
  return mesh.fields.at(load.field).col(0).array() - load.amount;
}

/// Of the thermal strains of solids and shells (n_dofs).
Eigen::VectorXd thermal_force(const PartData& part, const Eigen::VectorXd& dT) {
  Eigen::VectorXd forces = shell_thermal_load(part, dT);
  forces.head(3 * part.mesh.nodes.rows()) += thermal_load(part.mesh, part.recipe.materials, dT);
  return forces;
}

/// Force and moment on a point.
Eigen::VectorXd point_force(const DofNumbers& numbers, int32_t point, const LoadSpec& load) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(numbers.count());
  for (int d = 0; d < 3; ++d) {
    forces(numbers.of_point(point, d)) = load.force(d);
    forces(numbers.of_point(point, d + 3)) = load.moment(d);
  }
  return forces;
}

/// Forces on the nodes (3 n_nodes, or all ids); zero for a load that acts otherwise.
Eigen::VectorXd nodal_forces(const PartData& part, const LoadSpec& load, const LoadInputs& inputs) {
  const Eigen::Index n_nodes = part.mesh.nodes.rows();
  switch (load.kind) {
    case LoadSpec::Kind::kPressure:
      if (load.node_pressures.size() > 0)
        return -integrate_pressure(part.mesh.nodes, part.mesh.surface(load.selection.surface),
                                   load.node_pressures)
                    .reshaped<Eigen::RowMajor>();
      return pressure_load(n_nodes, part.surfaces.at(load.selection.surface));
    case LoadSpec::Kind::kResultant:
      if (load.at)
        return resultant_load(part.mesh.nodes, part.mesh.surface(load.selection.surface),
                              load.force, *load.at, *load.radius, load.where);
      return resultant_load(n_nodes, part.surfaces.at(load.selection.surface), load.force);
    case LoadSpec::Kind::kNodal: {
      const RowMatrix& field = part.mesh.fields.at(load.field);
      return load.amount * Eigen::Map<const Eigen::VectorXd>(field.data(), field.size());
    }
    case LoadSpec::Kind::kAcceleration:  // of a field
      return inputs.of_fields.at(load.name);
    case LoadSpec::Kind::kTemperature:
      return thermal_force(part, temperature_rise(part.mesh, load, inputs.heat));
    case LoadSpec::Kind::kForce:
    case LoadSpec::Kind::kCentrifugal:
    case LoadSpec::Kind::kDisplacement:
      break;
  }
  return Eigen::VectorXd::Zero(3 * n_nodes);
}

/// Forces on nodes and points (n_dofs), without those on sets.
Eigen::VectorXd forces_of(const PartData& part, const LoadSpec& load, const LoadInputs& inputs) {
  if (load.is_uniform_acceleration()) return body_force(part, inputs.momentum, load.force);
  if (load.kind == LoadSpec::Kind::kCentrifugal) return rotation_force(part, load, inputs);
  if (load.kind == LoadSpec::Kind::kForce)
    if (const int32_t point = find_point(part.recipe, load.set); point >= 0)
      return point_force(part.numbers, point, load);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(part.numbers.count());
  const Eigen::VectorXd nodal = nodal_forces(part, load, inputs);
  forces.head(nodal.size()) = nodal;
  return forces;
}

/// The forces f on the coordinates with those on sets: a force, and the weight of point masses.
Eigen::VectorXd with_set_forces(Eigen::VectorXd f, const Recipe& recipe, const LoadSpec& load,
                                const std::map<std::string, rom::DofSet>& sets) {
  if (load.kind == LoadSpec::Kind::kForce && find_point(recipe, load.set) < 0)
    f += set_load(f.size(), sets.at(load.set), load.force, load.moment, load.where);
  if (load.kind == LoadSpec::Kind::kCentrifugal && load.rotating.empty()) {
    for (const PointMassSpec& spec : recipe.point_masses) {
      if (find_point(recipe, spec.on) >= 0) continue;
      const rom::DofSet& set = sets.at(spec.on);
      if (!has_rotations(set) && set.dofs.size() > 3)
        throw InputError(
            fmt::format("{}: found a mass shared by {} nodes ({}), expected one node "
                        "for each mass of a rotating part",
                        load.where, set.dofs.size() / 3, spec.where));
      const auto force = centrifugal_force(spec, set.position.row(0).transpose(), load.axis);
      f += set_load(f.size(), set, force.head<3>(), force.tail<3>(), load.where);
    }
  }
  if (!load.is_uniform_acceleration()) return f;
  for (const PointMassSpec& spec : recipe.point_masses) {
    if (find_point(recipe, spec.on) >= 0) continue;
    const Eigen::Vector3d weight = spec.mass * load.force;
    f += set_load(f.size(), sets.at(spec.on), weight, spec.offset.cross(weight), load.where);
  }
  return f;
}

/// s of a prescribed displacement; a support must hold each requested direction.
Eigen::VectorXd prescribed_displacement(const PartData& part, const Constrained& constrained,
                                        const LoadSpec& load) {
  Eigen::VectorXd s = Eigen::VectorXd::Zero(constrained.elimination.supports());
  for (const NodeOrPoint owner : selected(load.selection, part.mesh, part.numbers)) {
    const Eigen::Matrix3d axes = load.axes.at(part.numbers.position(owner));
    for (const int d : load.directions) {
      const int32_t id = part.numbers.of(owner, d);
      if (id < 0) continue;  // a rotation of a node of solids
      Eigen::Index match = -1;
      for (size_t k = 0; k < constrained.held.size(); ++k) {
        const HeldDof& held = constrained.held[k];
        if (part.numbers.of(held.owner, held.is_rotation ? 3 + d % 3 : d % 3) != id) continue;
        const double along = held.direction.dot(axes.col(d % 3));
        if (std::abs(along) < 1.0 - kSameDirection) continue;
        match = static_cast<Eigen::Index>(k);
        s(match) = along > 0.0 ? load.amount : -load.amount;
      }
      if (match < 0)
        throw InputError(fmt::format("{}: found {}, which no support holds, expected one that does",
                                     load.where, part.numbers.name(id, part.mesh.node_ids)));
    }
  }
  return s;
}

/// True when every DoF with a force is a coordinate, is held, or depends on coordinates.
bool all_attached(const Elimination& e, const Eigen::VectorXd& forces) {
  Eigen::VectorXd most = Eigen::VectorXd::Zero(forces.size());
  for (const SparseMatrix* T : {&e.T, &e.T_s})
    for (int j = 0; j < T->outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(*T, j); it; ++it)
        most[it.row()] = std::max(most[it.row()], std::abs(it.value()));
  return ((forces.array() == 0.0) || (most.array() > 0.0)).all();
}

}  // namespace

LoadVectors load_vectors(const PartData& part, const Constrained& constrained,
                         const LoadInputs& inputs) {
  const Elimination& e = constrained.elimination;
  const Recipe& recipe = part.recipe;
  LoadVectors all;
  for (const LoadSpec& load : recipe.loads) {
    const Eigen::VectorXd forces = forces_of(part, load, inputs);
    Eigen::VectorXd f = with_set_forces(e.T.transpose() * forces, recipe, load, constrained.sets);
    const Eigen::VectorXd f_s = e.T_s.transpose() * forces;
    const Eigen::VectorXd resultant =
        constrained.rigid.transpose() * f + constrained.rigid_s.transpose() * f_s;
    // Not checked by the resultant, of which an equation may carry a part.
    if (load.kind == LoadSpec::Kind::kForce && find_point(recipe, load.set) >= 0 &&
        !all_attached(e, forces))
      throw InputError(fmt::format(
          "{}: found a load on a direction of {} with nothing attached, expected a coupling",
          load.where, load.set));
    say(fmt::format("load {}: resultant ({:.5g}, {:.5g}, {:.5g}) N per unit of {}", load.name,
                    resultant(0), resultant(1), resultant(2), load.unit));
    all.forces[load.name] = std::move(f);
    all.units[load.name] = load.unit;
    if (e.supports() > 0) all.support_forces[load.name] = f_s;
    if (load.kind == LoadSpec::Kind::kDisplacement)
      all.prescribed[load.name] = prescribed_displacement(part, constrained, load);
    if (load.kind == LoadSpec::Kind::kTemperature)
      all.temperature_rise[load.name] = temperature_rise(part.mesh, load, inputs.heat);
  }
  return all;
}

}  // namespace clatter::assembly
