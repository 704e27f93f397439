// SPDX-License-Identifier: GPL-3.0-or-later
// [[contact]], [[mean]], [[sensor]], [[nodes]], [[point_mass]].
#include "core/recipe/tables.hpp"

namespace clatter::recipe {
namespace {

const Keys<Contact::Sector>& sector_keys() {
  static const Keys<Contact::Sector> keys(
      "sector", "a part of the circle", [](auto& key, Contact::Sector& sector) {
        key.number("centre_deg", sector.centre, Range::between(-360.0, 360.0),
                   "angle of its middle, from zero_angle, right-handed about the axis")
            .required();
        key.number("half_width_deg", sector.half_width, {0.0, 180.0, true},
                   "angle from its middle to its ends")
            .required();
        key.integer("strips", sector.strips, Range::between(1.0, 1000.0),
                    "equal strips into which it is divided")
            .required();
      });
  return keys;
}

}  // namespace

const Keys<Contact>& contact_keys() {
  static const Keys<Contact> keys(
      "contact", "a grid of patches on a cylinder surface, with one radial DoF each",
      [](auto& key, Contact& contact) {
        key.source(contact.source);
        key.name("name", contact.name, "name of its set").required();
        key.text("surface", contact.surface, "a cylindrical surface of the mesh").required();
        key.vector("axis_point", contact.axis_point, {}, "a point of the cylinder's axis")
            .required()
            .in_length_unit();
        key.direction("axis", contact.axis, "direction of the cylinder's axis").required();
        key.direction("zero_angle", contact.zero_angle, "direction from which angles are counted")
            .required();
        key.tables("sector", contact.sectors, sector_keys()).required();
        key.interval("axial", contact.axial,
                     "lower and upper end of the grid, from axis_point along the axis")
            .required()
            .in_length_unit();
        key.integer("rows", contact.rows, Range::between(1.0, 1000.0),
                    "rows of patches along the axis")
            .required();
      });
  return keys;
}

const Keys<Mean>& mean_keys() {
  static const Keys<Mean> keys(
      "mean", "the mean displacement of a surface along a direction", [](auto& key, Mean& mean) {
        key.source(mean.source);
        key.name("name", mean.name, "name of its set").required();
        key.text("surface", mean.surface, "a surface of the mesh").required();
        key.direction("direction", mean.direction, "direction of the displacement").required();
        key.interval("range", mean.range, "part of the surface along the direction; all without it")
            .in_length_unit();
      });
  return keys;
}

const Keys<Sensor>& sensor_keys() {
  static const Keys<Sensor> keys(
      "sensor", "the node of a surface nearest to a point", [](auto& key, Sensor& sensor) {
        key.source(sensor.source);
        key.name("name", sensor.name, "name of its set").required();
        key.text("surface", sensor.surface, "a surface of the mesh").required();
        key.vector("near", sensor.near, {}, "position to which the nearest node is taken")
            .required()
            .in_length_unit();
      });
  return keys;
}

const Keys<Nodes>& nodes_keys() {
  static const Keys<Nodes> keys("nodes", "nodes and points with all their DoFs, or some",
                                [](auto& key, Nodes& nodes) {
                                  key.source(nodes.source);
                                  key.name("name", nodes.name, "name of its set").required();
                                  member_rows(key, nodes.members);
                                  system_row(key, nodes.members);
                                  key.tables("term", nodes.terms, member_keys(true));
                                });
  return keys;
}

const Keys<PointMass>& point_mass_keys() {
  static const Keys<PointMass> keys(
      "point_mass", "mass and inertia on a point, coupling, sensor or set of nodes",
      [](auto& key, PointMass& mass) {
        key.source(mass.source);
        key.text("on", mass.on, "name of the point or set").required();
        key.number("mass", mass.mass, Range::not_negative(), "mass of the body")
            .required()
            .shown_in("kg");
        key.vector("offset", mass.offset, {},
                   "position of its centre from the node, which needs rotations")
            .in_length_unit();
        key.numbers("inertia", mass.inertia, {},
                    "moments of inertia about its centre, which need rotations: xx, yy, zz, and "
                    "also xy, yz, zx of the tensor")
            .shown_in("kg m2");
      });
  return keys;
}

const Keys<SurfaceMass>& surface_mass_keys() {
  static const Keys<SurfaceMass> keys(
      "surface_mass", "mass on a surface that adds no stiffness: lining, trim, oil in a pan",
      [](auto& key, SurfaceMass& mass) {
        key.source(mass.source);
        key.text("surface", mass.surface, "a surface of the mesh").required();
        key.number("area_mass", mass.area_mass, Range::positive(),
                   "mass per area, in all directions; of a liquid of depth h on a wall with "
                   "bending waves of wave number k: density tanh(k h) / k")
            .required()
            .shown_in("kg/m2");
      });
  return keys;
}

}  // namespace clatter::recipe
