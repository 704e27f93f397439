// SPDX-License-Identifier: GPL-3.0-or-later
// [[beam]].
#include "core/recipe/tables.hpp"

namespace clatter::recipe {
namespace {

const Keys<BeamSection>& section_keys() {
  static const Keys<BeamSection> keys(
      "sections", "a cross-section about its centroid; x along the beam, y and z across",
      [](auto& key, BeamSection& section) {
        key.source(section.source);
        key.number("at", section.at, Range::between(0.0, 1.0),
                   "where, as a share of the length from the first point");
        key.number("area", section.area, Range::not_negative(), "its area").shown_in("m2");
        key.number("I1", section.I1, Range::not_negative(),
                   "integral of y^2: it bends in the plane of x and y")
            .shown_in("m4");
        key.number("I2", section.I2, Range::not_negative(),
                   "integral of z^2: it bends in the plane of x and z")
            .shown_in("m4");
        key.number("I12", section.I12, {}, "integral of y z").shown_in("m4");
        key.number("J", section.J, Range::not_negative(), "torsion constant").shown_in("m4");
        key.number("line_mass", section.line_mass, Range::not_negative(),
                   "mass per length beside that of the material")
            .shown_in("kg/m");
      });
  return keys;
}

}  // namespace

const Keys<Beam>& beam_keys() {
  static const Keys<Beam> keys(
      "beam", "a straight beam, bar or truss between two points", [](auto& key, Beam& beam) {
        key.source(beam.source);
        key.text("name", beam.name, "name for messages; beam_1, beam_2, ... without it");
        key.texts("points", beam.points, "names of two [[point]] tables").required().count(2);
        key.number("E", beam.E, Range::positive(), "Young's modulus").required().shown_in("Pa");
        key.number("G", beam.G, Range::not_negative(), "shear modulus, for torsion and shear")
            .shown_in("Pa");
        key.number("rho", beam.rho, Range::not_negative(), "density").shown_in("kg/m3");
        key.number("loss_factor", beam.loss_factor, Range::between(0.0, 1.0),
                   "share of its energy that a cycle loses, over 2 pi");
        key.numbers("shear_factors", beam.shear_factors, Range::positive(),
                    "k of the shear stiffness k G area along y and z; rigid in shear without it")
            .count(2)
            .needs("G");
        key.direction("y", beam.y,
                      "a direction in the plane of x (from the first point to the second) and y; "
                      "not needed where y and z are alike");
        key.vector("offset_a", beam.offset_a, {},
                   "from the first point to the end of the beam, which follows like a rigid arm")
            .in_length_unit();
        key.vector("offset_b", beam.offset_b, {}, "the same of the second point").in_length_unit();
        directions(key, beam.released_a,
                   "directions along the beam's axes that its first end does not hold; none "
                   "without it",
                   "released_a");
        directions(key, beam.released_b, "the same of the second end", "released_b");
        key.tables("sections", beam.sections, section_keys(),
                   "one section, or several from at = 0 to 1, linear between them")
            .required()
            .one_line();
      });
  return keys;
}

}  // namespace clatter::recipe
