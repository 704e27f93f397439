// SPDX-License-Identifier: GPL-3.0-or-later
// CBAR, CBEAM, CROD, CONROD and CTUBE with their properties and materials.
#include <fmt/format.h>

#include <cmath>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

class Bar {
 public:
  Bar(Model& model, const RawBar& raw, const std::optional<RawBar>& defaults)
      : model_(model), raw_(raw), property_(property_of(defaults)), defaults_(defaults) {}

  void build() {
    if (!property_.refusal.empty())
      model_.source.fail(property_.origin, property_.card + ": " + property_.refusal);
    Beam beam;
    beam.source = recipe::Source(model_.source.where(raw_.origin));
    beam.name = raw_.name;
    beam.ends = {model_.require(raw_.grids[0], raw_.origin),
                 model_.require(raw_.grids[1], raw_.origin)};
    if (beam.ends[0] == beam.ends[1]) fail("found the same grid twice, expected two");
    take_material(beam);
    beam.sections = property_.sections;
    beam.shear_factors = property_.shear_factors;
    const bool bends = beam.sections[0].I1 > 0.0 || beam.sections[0].I2 > 0.0;
    if (!bends || beam.G == 0.0) beam.shear_factors.clear();
    if (bends) beam.y = orientation(beam.ends[0]);
    beam.offset_a = offset(beam.ends[0], 0);
    beam.offset_b = offset(beam.ends[1], 1);
    for (int d = 0; d < 6; ++d) {
      if ((raw_.released[0] >> d & 1) != 0) beam.released_a.push_back(d);
      if ((raw_.released[1] >> d & 1) != 0) beam.released_b.push_back(d);
    }
    if (beam.released_a.size() + beam.released_b.size() > 0 && !beam.y)
      beam.y = orientation(beam.ends[0]);
    model_.deck.beams.push_back(std::move(beam));
  }

 private:
  const RawBarProperty& property_of(const std::optional<RawBar>& defaults) const {
    int32_t id = raw_.property;
    if (id == 0 && defaults) id = defaults->property;
    if (id == 0) id = raw_.id;  // as its own number
    const auto found = model_.raw.bar_properties.find(id);
    if (found == model_.raw.bar_properties.end())
      fail(fmt::format("found no property {}", id == 0 ? "(PID is blank)" : std::to_string(id)));
    return found->second;
  }

  void take_material(Beam& beam) const {
    const auto found = model_.raw.materials.find(property_.material);
    if (found == model_.raw.materials.end() || found->second.kind != Material::Kind::kIsotropic)
      model_.source.fail(property_.origin,
                         fmt::format("{}: found no MAT1 {}", property_.card, property_.material));
    auto [E, G, nu] = found->second.moduli;
    if (std::isnan(G)) G = std::isnan(nu) || std::isnan(E) ? 0.0 : E / (2.0 * (1.0 + nu));
    if (std::isnan(E)) E = std::isnan(nu) ? 0.0 : 2.0 * G * (1.0 + nu);
    if (!(E > 0.0) || !(G >= 0.0))
      model_.source.fail(found->second.origin,
                         fmt::format("MAT1 {}: found E = {:g} and G = {:g} of bars, expected E "
                                     "more than 0 and G not less",
                                     property_.material, E, G));
    beam.E = E;
    beam.G = G;
    beam.rho = found->second.density * model_.raw.control.mass_factor;
    beam.loss_factor = found->second.loss_factor;
    if (model_.raw.control.mass_factor == 1.0) return;
    for (recipe::BeamSection& section : beam.sections)
      section.line_mass *= model_.raw.control.mass_factor;
  }

  Eigen::Matrix3d axes_at(NodeIndex node) const {
    return model_.systems.directions(model_.node_map.displacement_system(node),
                                     model_.node_map.position(node), raw_.origin);
  }

  Eigen::Vector3d orientation(NodeIndex first) const {
    const bool own = raw_.orientation_grid != 0 || raw_.orientation.has_value();
    const RawBar& from = own || !defaults_ ? raw_ : *defaults_;
    if (from.orientation_grid != 0) {
      const int32_t row = model_.grids.find(from.orientation_grid);
      if (row < 0) fail(fmt::format("found no GRID {}, its G0", from.orientation_grid));
      return (vector(model_.raw.grids.at[row]) - model_.node_map.position(first)).normalized();
    }
    if (!from.orientation) fail("found no orientation, expected X1 X2 X3 or G0");
    const Eigen::Vector3d given = vector(*from.orientation);
    if (!(given.norm() > 0.0)) fail("found an orientation of length 0");
    return (from.orientation_is_basic ? given : axes_at(first) * given).normalized();
  }

  std::optional<Eigen::Vector3d> offset(NodeIndex node, size_t end) const {
    const Eigen::Vector3d given = vector(raw_.offset[end]);
    if (given.isZero(0.0)) return std::nullopt;
    return axes_at(node) * given;
  }

  [[noreturn]] void fail(const std::string& message) const {
    model_.source.fail(raw_.origin, fmt::format("{}: {}", raw_.name, message));
  }

  Model& model_;
  const RawBar& raw_;
  const RawBarProperty& property_;
  const std::optional<RawBar>& defaults_;
};

}  // namespace

void build_bars(Model& model) {
  if (model.raw.bars.empty()) return;
  if (model.raw.bar_properties.empty() && model.raw.materials.empty()) {
    model.deck.notes.push_back(
        fmt::format("{}: the deck is a mesh without materials: {} bars are left out",
                    model.source.where(model.raw.bars[0].origin), model.raw.bars.size()));
    return;
  }
  for (const RawBar& raw : model.raw.bars)
    model.refusals.attempt([&] {
      Bar(model, raw,
          raw.name.starts_with("cbeam") ? model.raw.beam_default : model.raw.bar_default)
          .build();
    });
}

}  // namespace clatter::mesh::deck::nastran
