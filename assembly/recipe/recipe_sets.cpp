// SPDX-License-Identifier: GPL-3.0-or-later
// [[contact]], [[mean]], [[sensor]], [[nodes]], [[point_mass]].
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "assembly/recipe/recipe_reader.hpp"

#include "core/base/units.hpp"

namespace clatter::assembly {
std::vector<Sector> RecipeReader::sectors(const Config& table) {
  std::vector<Sector> sectors;
  for (const Config& part : table.tables("sector")) {
    const double centre = kDegree * part.number("centre_deg", {-360.0, 360.0});
    const double half = kDegree * part.number("half_width_deg", {0.0, 180.0, true});
    const auto strips = static_cast<int>(part.integer("strips", {1.0, 1000.0}));
    sectors.push_back({centre - half, centre + half, strips});
  }
  if (sectors.empty()) table.fail("sector", "found none, expected at least one [[contact.sector]]");
  std::sort(sectors.begin(), sectors.end(),
            [](const Sector& a, const Sector& b) { return a.begin < b.begin; });
  // The last sector must also end before the first one begins again.
  for (size_t i = 0; i < sectors.size(); ++i) {
    const bool last = i + 1 == sectors.size();
    const double next =
        last ? sectors.front().begin + 2.0 * std::numbers::pi : sectors[i + 1].begin;
    if (sectors[i].end > next + 1e-9)
      table.fail("sector", "found sectors that overlap, expected separate ones");
  }
  return sectors;
}

Eigen::VectorXd RecipeReader::axial_edges(const Config& table) const {
  const auto ends = range(table, "axial");
  if (!ends) table.fail("axial", "not found, expected [lower, upper] from axis_point");
  const auto rows = static_cast<Eigen::Index>(table.integer("rows", {1.0, 1000.0}));
  return Eigen::VectorXd::LinSpaced(rows + 1, ends->first, ends->second);
}

void RecipeReader::contacts(Recipe& recipe) {
  for (const Config& table : config_.tables("contact")) {
    ContactSpec spec;
    spec.name = new_set(table);
    spec.where = where(table, "contact " + spec.name);
    spec.surface = surface(table);
    spec.grid.axis_point = point(table, "axis_point");
    spec.grid.axis = unit_vector(table, "axis");
    const Eigen::Vector3d zero = unit_vector(table, "zero_angle");
    const Eigen::Vector3d across = zero - zero.dot(spec.grid.axis) * spec.grid.axis;
    if (across.norm() < 1e-6)
      table.fail("zero_angle", "found the axis, expected a direction across it");
    spec.grid.zero_angle = across.normalized();
    spec.grid.sectors = sectors(table);
    spec.grid.axial_edges = axial_edges(table);
    recipe.contacts.push_back(spec);
  }
}

void RecipeReader::means(Recipe& recipe) {
  for (const Config& table : config_.tables("mean")) {
    MeanSpec spec;
    spec.name = new_set(table);
    spec.where = where(table, "mean " + spec.name);
    spec.surface = surface(table);
    spec.direction = unit_vector(table, "direction");
    spec.range = range(table, "range");
    recipe.means.push_back(spec);
  }
}

void RecipeReader::nodes(Recipe& recipe) {
  for (const Config& table : config_.tables("sensor")) {
    NodeSpec spec{new_set(table), "sensor", {}, {}, {}};
    spec.where = where(table, "sensor " + spec.name);
    spec.terms = {{{surface(table), {}, {}, spec.where}, 1.0, {}, {}}};
    spec.near = point(table, "near");
    recipe.nodes.push_back(spec);
  }
  for (const Config& table : config_.tables("nodes")) {
    NodeSpec spec{new_set(table), "node", {}, {}, {}};
    spec.where = where(table, "nodes " + spec.name);
    spec.terms = terms(table, "nodes " + spec.name, {}, true);
    recipe.nodes.push_back(spec);
  }
}

void RecipeReader::point_masses(Recipe& recipe) const {
  for (const Config& table : config_.tables("point_mass")) {
    PointMassSpec spec;
    spec.on = known_set(table, "on");
    spec.where = where(table, "point_mass on " + spec.on);
    spec.mass = table.number("mass", Range::not_negative());
    if (table.has("offset")) spec.offset = point(table, "offset");
    const std::vector<double> J = table.numbers_or("inertia", {0.0, 0.0, 0.0});
    if (J.size() != 3 && J.size() != 6)
      table.fail("inertia", fmt::format("found {} numbers, expected 3 (xx, yy, zz) or 6 (and the "
                                        "tensor's xy, yz, zx)",
                                        J.size()));
    spec.inertia.diagonal() << J[0], J[1], J[2];
    if (J.size() == 6) {
      spec.inertia(0, 1) = spec.inertia(1, 0) = J[3];
      spec.inertia(1, 2) = spec.inertia(2, 1) = J[4];
      spec.inertia(2, 0) = spec.inertia(0, 2) = J[5];
    }
    if (spec.mass == 0.0 && spec.inertia.isZero(0.0))
      table.fail("mass", "found 0 and no inertia, expected one of them above 0");
    // No body has negative second moments tr(J)/2 I - J.
    const Eigen::Vector3d moments =
        Eigen::Vector3d::Constant(0.5 * spec.inertia.trace()) - spec.inertia.diagonal();
    if (moments.minCoeff() < -1e-12 * spec.inertia.trace() ||
        spec.inertia.diagonal().minCoeff() < 0)
      table.fail("inertia", fmt::format("found [{:g}, {:g}, {:g}, ...], expected numbers of a body "
                                        "(each at most the sum of the other two)",
                                        J[0], J[1], J[2]));
    recipe.point_masses.push_back(spec);
  }
}

}  // namespace clatter::assembly
