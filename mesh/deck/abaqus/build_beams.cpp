// SPDX-License-Identifier: GPL-3.0-or-later
// B31, B32 with *BEAM SECTION and T3D2, T3D3 with *SOLID SECTION: beams and trusses.
#include <fmt/format.h>

#include <Eigen/Geometry>

#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/bar_shapes.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

/// A section of *BEAM SECTION; local 1 is y, 2 is z. Shear factors are those of Abaqus.
struct Shape {
  BeamSection section;
  double shear_factor;
};

Shape shape_of(const Card& card, const Source& source) {
  const Keyword& keyword = card.keyword();
  const std::string kind = folded(keyword.required("SECTION", source));
  if (card.size() == 0) source.fail(card.origin(), "*BEAM SECTION: found no data lines");
  const Fields fields = card.line(0, source);
  const auto number = [&](size_t i) {
    const double value = fields.number(i, "dimension");
    if (!(value > 0.0))
      source.fail(card.origin(),
                  fmt::format("*BEAM SECTION: found a dimension of {}, expected more "
                              "than 0",
                              value));
    return value;
  };
  const auto checked = [&](const BeamSection& section, double shear_factor) -> Shape {
    if (!(section.area > 0.0) || !(section.J > 0.0))
      source.fail(card.origin(), "*BEAM SECTION: its walls leave no area");
    return {section, shear_factor};
  };
  if (kind == "CIRC") return checked(ring_section(number(0), 0.0), 0.89);
  if (kind == "RECT") return checked(rectangle_section(number(0), number(1)), 0.85);
  if (kind == "PIPE") return checked(ring_section(number(0), number(0) - number(1)), 0.53);
  if (kind == "BOX") {
    const double t1 = number(2), t2 = number(3);
    if (number(4) != t1 || number(5) != t2)
      source.fail(card.origin(),
                  "*BEAM SECTION: found a BOX of unequal opposite walls, expected "
                  "t1 = t3 and t2 = t4");
    return checked(box_section(number(0), number(1), t1, t2), 0.44);
  }
  source.fail(card.origin(),
              fmt::format("*BEAM SECTION: found SECTION={}, expected CIRC, RECT, PIPE or BOX",
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
                "*BEAM SECTION: its n1 is along an element, expected a direction "
                "across it in the second line");
  return n1.normalized();
}

void take_material(const Model& model, const Card& card, Beam& beam) {
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
    const Shape shape = shape_of(card, model.source);
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
