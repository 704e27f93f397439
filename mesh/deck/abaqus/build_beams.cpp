// SPDX-License-Identifier: GPL-3.0-or-later
// B31, B32 with *BEAM SECTION or *BEAM GENERAL SECTION and T3D2, T3D3 with *SOLID SECTION: beams
// and trusses.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/bar_shapes.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

/// A section of *BEAM SECTION or *BEAM GENERAL SECTION; local 1 is y, 2 is z. Shear factors are
/// those of Abaqus.
struct Shape {
  BeamSection section;
  double shear_factor;
};

/// The first line of a section's card.
class Dimensions {
 public:
  Dimensions(const Card& card, const Source& source)
      : card_(card), source_(source), fields_(card.line(0, source)) {}

  [[noreturn]] void fail(const std::string& message) const {
    source_.fail(card_.origin(), fmt::format("{}: {}", card_.keyword().name, message));
  }

  double positive(size_t i) const {
    const double value = fields_.number(i, "dimension");
    if (!(value > 0.0)) fail(fmt::format("found a dimension of {}, expected more than 0", value));
    return value;
  }

  double any(size_t i) const { return fields_.number_or(i, "dimension", 0.0); }

 private:
  const Card& card_;
  const Source& source_;
  Fields fields_;
};

/// Abaqus has the radius, CalculiX the diameter, once or along local 1 and 2.
double circle_radius(const Dimensions& of, bool is_calculix) {
  const double along_1 = of.positive(0), along_2 = of.any(1);
  if (along_2 != 0.0 && along_2 != along_1)
    of.fail("found an ellipse, expected the radius, or the diameter twice");
  return along_2 != 0.0 || is_calculix ? 0.5 * along_1 : along_1;
}

Shape box_of(const Dimensions& of) {
  const double t1 = of.positive(2), t2 = of.positive(3);
  if (of.positive(4) != t1 || of.positive(5) != t2)
    of.fail("found a BOX of unequal opposite walls, expected t1 = t3 and t2 = t4");
  return {box_section(of.positive(0), of.positive(1), t1, t2), 0.44};
}

/// l, h, b1, b2, t1, t2, t3: the height is along local 2, at l above the lower edge are the nodes.
Shape i_of(const Dimensions& of) {
  const IShape shape{of.positive(1), of.positive(2), of.positive(3),
                     of.positive(6), of.positive(4), of.positive(5)};
  const double web = shape.height - shape.t_below - shape.t_above;
  if (!(web > 0.0)) of.fail("its flanges leave no web");
  const double below = shape.below * shape.t_below, above = shape.above * shape.t_above;
  const double centroid =
      (below * 0.5 * shape.t_below + above * (shape.height - 0.5 * shape.t_above) +
       web * shape.web * (shape.t_below + 0.5 * web)) /
      (below + above + web * shape.web);
  if (std::abs(of.any(0) - centroid) > 1e-6 * shape.height)
    of.fail(
        fmt::format("found nodes at {:g} of the height of an I, expected its centroid at {:g}: "
                    "an offset is not read",
                    of.any(0), centroid));
  BeamSection section = i_section(shape);
  std::swap(section.I1, section.I2);
  return {section, 0.44};
}

/// A, I11, I12, I22, J: moments of inertia for bending about local 1 and 2.
Shape general_of(const Dimensions& of) {
  return {{.area = of.positive(0),
           .I1 = of.positive(3),
           .I2 = of.positive(1),
           .I12 = of.any(2),
           .J = of.positive(4)},
          1.0};
}

Shape shape_of(const Model& model, const Card& card) {
  const Source& source = model.source;
  const Keyword& keyword = card.keyword();
  const bool is_general = keyword.key == "BEAMGENERALSECTION" && !keyword.has("SECTION");
  const std::string kind = is_general ? "GENERAL" : folded(keyword.required("SECTION", source));
  if (card.size() == 0)
    source.fail(card.origin(), fmt::format("{}: found no data lines", keyword.name));
  const Dimensions of(card, source);
  const auto checked = [&](const Shape& shape) {
    if (!(shape.section.area > 0.0) || !(shape.section.J > 0.0)) of.fail("its walls leave no area");
    return shape;
  };
  if (keyword.has("TAPER")) of.fail("TAPER is not supported, expected a section for each element");
  if (kind == "CIRC")
    return checked({ring_section(circle_radius(of, model.is_calculix), 0.0), 0.89});
  if (kind == "RECT") return checked({rectangle_section(of.positive(0), of.positive(1)), 0.85});
  if (kind == "PIPE")
    return checked({ring_section(of.positive(0), of.positive(0) - of.positive(1)), 0.53});
  if (kind == "BOX") return checked(box_of(of));
  if (kind == "I") return checked(i_of(of));
  if (kind == "GENERAL" && keyword.has("MATERIAL"))  // CalculiX: with a shear factor in place of J
    of.fail("SECTION=GENERAL with a MATERIAL is not read, expected E, G in the third line");
  if (kind == "GENERAL" && keyword.key == "BEAMGENERALSECTION") return checked(general_of(of));
  of.fail(
      fmt::format("found SECTION={}, expected CIRC, RECT, PIPE, BOX, I, or GENERAL of a *BEAM "
                  "GENERAL SECTION",
                  keyword.required("SECTION", source)));
}

/// n1 of the second line; (0, 0, -1) without it.
Eigen::Vector3d first_axis(const Card& card, const Eigen::Vector3d& along, const Source& source) {
  Eigen::Vector3d n1(0.0, 0.0, -1.0);
  if (card.size() > 1) {
    const Fields fields = card.line(1, source);
    for (size_t k = 0; k < 3; ++k)
      n1[static_cast<Eigen::Index>(k)] = fields.number_or(k, "n1", 0.0);
  }
  if (!(along.cross(n1).norm() > 1e-6 * along.norm() * n1.norm()))
    source.fail(card.origin(),
                fmt::format("{}: its n1 is along an element, expected a direction across it in "
                            "the second line",
                            card.keyword().name));
  return n1.normalized();
}

/// E and G of the third line, and the parameter DENSITY.
void take_own_material(const Model& model, const Card& card, Beam& beam) {
  if (card.size() < 3)
    model.source.fail(card.origin(),
                      "*BEAM GENERAL SECTION: found no MATERIAL and no third line, "
                      "expected E, G");
  const Fields fields = card.line(2, model.source);
  beam.E = fields.number(0, "E");
  beam.G = fields.number(1, "G");
  if (!(beam.E > 0.0) || !(beam.G > 0.0)) fields.fail("found E, G that are not more than 0");
  if (const std::string* density = card.keyword().find("DENSITY"))
    beam.rho = Fields(*density, model.source, card.origin()).number(0, "DENSITY");
}

void take_material(const Model& model, const Card& card, Beam& beam) {
  if (card.keyword().key == "BEAMGENERALSECTION" && !card.keyword().has("MATERIAL"))
    return take_own_material(model, card, beam);
  const std::string wanted = card.keyword().required("MATERIAL", model.source);
  const auto known = model.material_names.find(folded(wanted));
  if (known == model.material_names.end())
    model.source.fail(card.origin(), fmt::format("found no *MATERIAL {}", wanted));
  const Material& material = model.deck.materials.at(known->second);
  if (material.kind != Material::Kind::kIsotropic || material.constants.empty())
    model.source.fail(card.origin(), fmt::format("*MATERIAL {} of beams is not isotropic, expected "
                                                 "*ELASTIC of E and nu",
                                                 wanted));
  beam.E = material.constants[0];
  beam.G = beam.E / (2.0 * (1.0 + material.constants[1]));
  beam.rho = material.density;
  beam.loss_factor = material.loss_factor;
}

}  // namespace

void add_beam(Model& model, const ThinElement& element, const Card& card) {
  Beam beam;
  beam.source = recipe::Source(model.source.where(element.origin));
  take_material(model, card, beam);
  const bool truss = element.type.starts_with("T");
  if (truss) {
    const double area = card.size() > 0 ? card.line(0, model.source).number(0, "area") : 1.0;
    if (!(area > 0.0))
      model.source.fail(card.origin(),
                        fmt::format("found an area of {}, expected more than 0", area));
    beam.sections = {{.area = area}};
  } else {
    const Shape shape = shape_of(model, card);
    beam.sections = {shape.section};
    beam.shear_factors = {shape.shear_factor, shape.shear_factor};
  }
  for (int32_t i = 0; i + 1 < element.count; ++i) {
    const Eigen::Vector3d along =
        model.numbering.at(element.nodes[i + 1]) - model.numbering.at(element.nodes[i]);
    if (!(along.norm() > 0.0))
      model.source.fail(element.origin, fmt::format("element {}: both ends have the same position, "
                                                    "expected a length",
                                                    element.id));
    beam.name = fmt::format("{}_{}", element.type, element.id);
    if (element.count > 2) beam.name += i == 0 ? "a" : "b";
    if (!truss) beam.y = first_axis(card, along, model.source);
    beam.ends = {model.node_map.require(element.nodes[i]),
                 model.node_map.require(element.nodes[i + 1])};
    model.deck.beams.push_back(beam);
  }
}

}  // namespace clatter::mesh::deck::abaqus
