// SPDX-License-Identifier: GPL-3.0-or-later
// [[contact]], [[mean]], [[sensor]], [[nodes]], [[point_mass]].
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "assembly/recipe/recipe_keys.hpp"

namespace clatter::assembly {
namespace {

/// Sectors in ascending order; the last one must also end before the first one begins again.
std::vector<Sector> sectors_of(const Config& table, const std::vector<SectorTable>& given) {
  if (given.empty()) table.fail("sector", "found none, expected at least one [[contact.sector]]");
  std::vector<Sector> sectors;
  for (const SectorTable& s : given)
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

const keys::Keys<SectorTable>& RecipeKeys::sector_keys() {
  const auto rows = [](auto& key, SectorTable& sector) {
    key.number("centre_deg", sector.centre, Range::between(-360.0, 360.0),
               "angle of its middle, from zero_angle, right-handed about the axis")
        .required();
    key.number("half_width_deg", sector.half_width, {0.0, 180.0, true},
               "angle from its middle to its ends")
        .required();
    key.integer("strips", sector.strips, Range::between(1.0, 1000.0),
                "equal strips into which it is divided")
        .required();
  };
  return keep<SectorTable>("sector", "a part of the circle", rows);
}

const keys::Keys<ContactTable>& RecipeKeys::contact_keys() {
  const auto rows = [this](auto& key, ContactTable& contact) {
    PatchGridSpec& grid = contact.spec.grid;
    key.name("name", contact.spec.name, "name of its set").required();
    key.text("surface", contact.spec.surface, "a cylindrical surface of the mesh").required();
    key.vector("axis_point", grid.axis_point, {}, "a point of the cylinder's axis")
        .required()
        .in_length_unit();
    key.direction("axis", grid.axis, "direction of the cylinder's axis").required();
    key.direction("zero_angle", grid.zero_angle, "direction from which angles are counted")
        .required();
    key.tables("sector", contact.sectors, sector_keys()).required();
    key.interval("axial", contact.axial,
                 "lower and upper end of the grid, from axis_point along the axis")
        .required()
        .in_length_unit();
    key.integer("rows", contact.rows, Range::between(1.0, 1000.0), "rows of patches along the axis")
        .required();
    key.check([this](const Config& table, ContactTable& c) {
      names_.add_set(table, c.spec.name);
      names_.check_surface(table, c.spec.surface);
      c.spec.where = where(table, "contact " + c.spec.name);
      PatchGridSpec& g = c.spec.grid;
      const Eigen::Vector3d across = g.zero_angle - g.zero_angle.dot(g.axis) * g.axis;
      if (across.norm() < 1e-6)
        table.fail("zero_angle", "found the axis, expected a direction across it");
      g.zero_angle = across.normalized();
      g.sectors = sectors_of(table, c.sectors);
      g.axial_edges = Eigen::VectorXd::LinSpaced(c.rows + 1, c.axial->first, c.axial->second);
    });
  };
  return keep<ContactTable>(
      "contact", "a grid of patches on a cylinder surface, with one radial DoF each", rows);
}

const keys::Keys<MeanSpec>& RecipeKeys::mean_keys() {
  const auto rows = [this](auto& key, MeanSpec& mean) {
    key.name("name", mean.name, "name of its set").required();
    key.text("surface", mean.surface, "a surface of the mesh").required();
    key.direction("direction", mean.direction, "direction of the displacement").required();
    key.interval("range", mean.range, "part of the surface along the direction; all without it")
        .in_length_unit();
    key.check([this](const Config& table, MeanSpec& m) {
      names_.add_set(table, m.name);
      names_.check_surface(table, m.surface);
      m.where = where(table, "mean " + m.name);
    });
  };
  return keep<MeanSpec>("mean", "the mean displacement of a surface along a direction", rows);
}

const keys::Keys<NodesTable>& RecipeKeys::sensor_keys() {
  const auto rows = [this](auto& key, NodesTable& sensor) {
    key.name("name", sensor.spec.name, "name of its set").required();
    key.text("surface", sensor.members.selection.surface, "a surface of the mesh").required();
    key.vector("near", sensor.near, {}, "position to which the nearest node is taken")
        .required()
        .in_length_unit();
    key.check([this](const Config& table, NodesTable& s) {
      names_.add_set(table, s.spec.name);
      names_.check(table, "sensor " + s.spec.name, s.members.selection);
      s.spec.kind = "sensor";
      s.spec.where = s.members.selection.where;
      s.spec.terms = {{s.members.selection, 1.0, {}, {}}};
      s.spec.near = s.near;
    });
  };
  return keep<NodesTable>("sensor", "the node of a surface nearest to a point", rows);
}

const keys::Keys<NodesTable>& RecipeKeys::nodes_keys() {
  const auto rows = [this](auto& key, NodesTable& nodes) {
    key.name("name", nodes.spec.name, "name of its set").required();
    member_rows(key, nodes.members);
    system_row(key, nodes.members);
    key.tables("term", nodes.terms, member_keys(true));
    key.check([this](const Config& table, NodesTable& n) {
      names_.add_set(table, n.spec.name);
      check_members(table, n.members);
      n.spec.kind = "node";
      n.spec.where = where(table, "nodes " + n.spec.name);
      n.spec.terms = terms_of("nodes " + n.spec.name, n.members, n.terms, {});
      if (n.spec.terms.empty()) table.fail("surface", "give surface, node_set, points or terms");
    });
  };
  return keep<NodesTable>("nodes", "nodes and points with all their DoFs, or some", rows);
}

const keys::Keys<MassTable>& RecipeKeys::point_mass_keys() {
  const auto rows = [this](auto& key, MassTable& mass) {
    key.text("on", mass.spec.on, "name of the point or set").required();
    key.number("mass", mass.spec.mass, Range::not_negative(), "mass of the body")
        .required()
        .shown_in("kg");
    key.vector("offset", mass.spec.offset, {},
               "position of its centre from the node, which needs rotations")
        .in_length_unit();
    key.numbers("inertia", mass.inertia, {},
                "moments of inertia about its centre, which need rotations: xx, yy, zz, and also "
                "xy, yz, zx of the "
                "tensor")
        .shown_in("kg m2");
    key.check([this](const Config& table, MassTable& m) {
      check_known(table, "on", m.spec.on, names_.sets);
      m.spec.where = where(table, "point_mass on " + m.spec.on);
      std::vector<double>& J = m.inertia;
      if (J.empty()) J = {0.0, 0.0, 0.0};
      if (J.size() != 3 && J.size() != 6)
        table.fail("inertia", fmt::format("found {} numbers, expected 3 (xx, yy, zz) or 6 (and the "
                                          "tensor's xy, yz, zx)",
                                          J.size()));
      Eigen::Matrix3d& inertia = m.spec.inertia;
      inertia.diagonal() << J[0], J[1], J[2];
      if (J.size() == 6) {
        inertia(0, 1) = inertia(1, 0) = J[3];
        inertia(1, 2) = inertia(2, 1) = J[4];
        inertia(2, 0) = inertia(0, 2) = J[5];
      }
      if (m.spec.mass == 0.0 && inertia.isZero(0.0))
        table.fail("mass", "give mass or inertia above 0");
      // No body has negative second moments tr(J)/2 I - J.
      const Eigen::Vector3d moments =
          Eigen::Vector3d::Constant(0.5 * inertia.trace()) - inertia.diagonal();
      if (moments.minCoeff() < -1e-12 * inertia.trace() || inertia.diagonal().minCoeff() < 0)
        table.fail("inertia",
                   fmt::format("found [{:g}, {:g}, {:g}, ...], expected numbers of a body "
                               "(each at most the sum of the other two)",
                               J[0], J[1], J[2]));
    });
  };
  return keep<MassTable>("point_mass",
                         "mass and inertia on a point, coupling, sensor or set of nodes", rows);
}

}  // namespace clatter::assembly
