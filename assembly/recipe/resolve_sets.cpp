// SPDX-License-Identifier: GPL-3.0-or-later
// [[contact]], [[mean]], [[sensor]], [[nodes]], [[point_mass]], [[surface_mass]].
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "assembly/recipe/resolve.hpp"

namespace clatter::assembly {
namespace {

/// Sectors in ascending order; the last one must also end before the first one begins again.
std::vector<Sector> sectors_of(const keys::Source& table,
                               const std::vector<recipe::Contact::Sector>& given) {
  if (given.empty()) table.fail("sector", "found none, expected at least one [[contact.sector]]");
  std::vector<Sector> sectors;
  for (const recipe::Contact::Sector& s : given)
    sectors.push_back({s.centre - s.half_width, s.centre + s.half_width, s.strips});
  std::sort(sectors.begin(), sectors.end(),
            [](const Sector& a, const Sector& b) { return a.begin < b.begin; });
  for (size_t i = 0; i < sectors.size(); ++i) {
    const bool last = i + 1 == sectors.size();
    const double next =
        last ? sectors.front().begin + 2.0 * std::numbers::pi : sectors[i + 1].begin;
    if (sectors[i].end > next + 1e-9)
      table.fail("sector", "found sectors that overlap, expected separate ones");
  }
  return sectors;
}

}  // namespace

ContactSpec Resolver::contact(const recipe::Contact& contact, size_t) {
  const Source& table = contact.source;
  names_.add_set(table, contact.name);
  names_.check_surface(table, contact.surface);
  const Eigen::Vector3d across =
      contact.zero_angle - contact.zero_angle.dot(contact.axis) * contact.axis;
  if (across.norm() < 1e-6)
    table.fail("zero_angle", "found the axis, expected a direction across it");
  return {
      contact.name,
      contact.surface,
      where(table, "contact " + contact.name),
      {contact.axis_point, contact.axis, across.normalized(), sectors_of(table, contact.sectors),
       Eigen::VectorXd::LinSpaced(contact.rows + 1, contact.axial->first, contact.axial->second)}};
}

MeanSpec Resolver::mean(const recipe::Mean& mean, size_t) {
  names_.add_set(mean.source, mean.name);
  names_.check_surface(mean.source, mean.surface);
  return {mean, where(mean.source, "mean " + mean.name)};
}

NodeSpec Resolver::sensor(const recipe::Sensor& sensor, size_t) {
  names_.add_set(sensor.source, sensor.name);
  const Selection selection =
      names_.selection(sensor.source, "sensor " + sensor.name, {.surface = sensor.surface});
  return {sensor.name, "sensor", selection.where, {{selection, 1.0, {0, 1, 2}, {}}}, sensor.near};
}

NodeSpec Resolver::nodes(const recipe::Nodes& nodes, size_t) {
  const std::string what = "nodes " + nodes.name;
  names_.add_set(nodes.source, nodes.name);
  NodeSpec spec{nodes.name,
                "node",
                where(nodes.source, what),
                terms_of(nodes.source, what, nodes.members, nodes.terms, {}),
                {}};
  if (spec.terms.empty()) nodes.source.fail("surface", "give surface, node_set, points or terms");
  return spec;
}

PointMassSpec Resolver::point_mass(const recipe::PointMass& mass, size_t) {
  const Source& table = mass.source;
  check_known(table, "on", mass.on, names_.sets);
  std::vector<double> J = mass.inertia;
  if (J.empty()) J = {0.0, 0.0, 0.0};
  if (J.size() != 3 && J.size() != 6)
    table.fail("inertia", fmt::format("found {} numbers, expected 3 (xx, yy, zz) or 6 (and the "
                                      "tensor's xy, yz, zx)",
                                      J.size()));
  PointMassSpec spec{mass.on, where(table, "point_mass on " + mass.on), mass.mass, mass.offset,
                     Eigen::Vector3d(J.data()).asDiagonal()};
  Eigen::Matrix3d& inertia = spec.inertia;
  if (J.size() == 6) {
    inertia(0, 1) = inertia(1, 0) = J[3];
    inertia(1, 2) = inertia(2, 1) = J[4];
    inertia(2, 0) = inertia(0, 2) = J[5];
  }
  if (mass.mass == 0.0 && inertia.isZero(0.0)) table.fail("mass", "give mass or inertia above 0");
  // No body has negative second moments tr(J)/2 I - J.
  const Eigen::Vector3d moments =
      Eigen::Vector3d::Constant(0.5 * inertia.trace()) - inertia.diagonal();
  if (moments.minCoeff() < -1e-12 * inertia.trace() || inertia.diagonal().minCoeff() < 0)
    table.fail("inertia", fmt::format("found [{:g}, {:g}, {:g}, ...], expected numbers of a body "
                                      "(each at most the sum of the other two)",
                                      J[0], J[1], J[2]));
  return spec;
}

SurfaceMassSpec Resolver::surface_mass(const recipe::SurfaceMass& mass, size_t) {
  names_.check_surface(mass.source, mass.surface);
  return {mass, where(mass.source, "surface_mass on " + mass.surface)};
}

}  // namespace clatter::assembly
