// SPDX-License-Identifier: GPL-3.0-or-later
// *NONSTRUCTURAL MASS: a larger density of its cells, as in Abaqus.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/mesh/validity.hpp"
#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

/// By region; cells may be left-handed still.
std::vector<double> volumes_of(const Mesh& mesh) {
  std::vector<double> volume(mesh.regions.size(), 0.0);
  for (const CellBlock& block : mesh.cells)
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const CellNodes x = cell_nodes(mesh, block, c);
      volume[block.region] += std::abs(volume_of(block.type, x.rowwise() - x.row(0)));
    }
  return volume;
}

class Densities {
 public:
  explicit Densities(Model& model)
      : model_(model), volume_(volumes_of(model.deck.mesh)), added_(volume_.size(), 0.0) {}

  void add(size_t use, const Card& card) {
    const Keyword& keyword = card.keyword();
    keyword.allow({"ELSET", "UNITS", "DISTRIBUTION"}, model_.source, model_.ignore);
    const std::string units = keyword.choice("UNITS", "");
    if (units != "TOTALMASS" && units != "MASSPERVOLUME")
      model_.source.fail(card.origin(),
                         "*NONSTRUCTURAL MASS: expected UNITS=TOTAL MASS or MASS PER VOLUME: those "
                         "of solids");
    if (card.size() != 1)
      model_.source.fail(card.origin(), fmt::format("*NONSTRUCTURAL MASS: found {} data lines, "
                                                    "expected one",
                                                    card.size()));
    const Fields fields = card.line(0, model_.source);
    fields.at_most(1, "mass");
    const double value = fields.number(0, "mass");
    const std::vector<bool> wanted = regions_of(use, card);
    if (units == "MASSPERVOLUME") return spread(wanted, value, false, card);
    const std::string how = keyword.choice("DISTRIBUTION", "MASSPROPORTIONAL");
    if (how != "MASSPROPORTIONAL" && how != "VOLUMEPROPORTIONAL")
      model_.source.fail(card.origin(),
                         "*NONSTRUCTURAL MASS: expected DISTRIBUTION=MASS "
                         "PROPORTIONAL or VOLUME PROPORTIONAL");
    const bool by_mass = how == "MASSPROPORTIONAL";
    double all = 0.0;  // volume or mass without what is added
    for (size_t r = 0; r < wanted.size(); ++r)
      if (wanted[r]) all += volume_[r] * (by_mass ? density(r) : 1.0);
    if (!(all > 0.0))
      model_.source.fail(card.origin(),
                         "*NONSTRUCTURAL MASS: its elements have no mass (*DENSITY) that it could "
                         "be proportional to; expected DISTRIBUTION=VOLUME PROPORTIONAL");
    spread(wanted, value / all, by_mass, card);
  }

  /// Each region with more mass gets a material of its own.
  void finish() {
    for (size_t r = 0; r < added_.size(); ++r) {
      if (added_[r] == 0.0) continue;
      Material heavier = model_.deck.materials.at(model_.deck.regions[r].material);
      heavier.density += added_[r];
      const std::string name = fmt::format("{}_with_mass", model_.deck.mesh.regions[r]);
      heavier.name = name;
      for (int k = 2; model_.deck.materials.contains(heavier.name); ++k)
        heavier.name = fmt::format("{}_{}", name, k);
      model_.deck.regions[r].material = heavier.name;
      model_.deck.materials.emplace(heavier.name, heavier);
    }
  }

 private:
  double density(size_t region) const {
    const auto found = model_.deck.materials.find(model_.deck.regions[region].material);
    return found == model_.deck.materials.end() ? 0.0 : found->second.density;
  }

  /// build_regions() has made regions that lie in the set entirely or not at all.
  std::vector<bool> regions_of(size_t use, const Card& card) {
    std::vector<bool> wanted(volume_.size(), false);
    for (const int32_t element : model_.sets.elements(
             use, card.keyword().required("ELSET", model_.source), card.origin())) {
      if (element >= model_.numbering.cells())
        model_.source.fail(card.origin(),
                           "*NONSTRUCTURAL MASS: its set has elements that are no "
                           "solids; expected a set of solids alone");
      wanted[model_.region_of_cell[element]] = true;
    }
    return wanted;
  }

  void spread(const std::vector<bool>& wanted, double value, bool by_mass, const Card& card) {
    for (size_t r = 0; r < wanted.size(); ++r) {
      if (!wanted[r]) continue;
      if (model_.deck.regions[r].material.empty() && model_.refusals.any()) throw FollowUp();
      if (model_.deck.regions[r].material.empty())
        model_.source.fail(card.origin(),
                           "*NONSTRUCTURAL MASS: its elements have no *SOLID SECTION");
      added_[r] += value * (by_mass ? density(r) : 1.0);
      if (!(density(r) + added_[r] > 0.0) || !std::isfinite(added_[r]))
        model_.source.fail(card.origin(), fmt::format("*NONSTRUCTURAL MASS: leaves a density of "
                                                      "{}, expected more than 0",
                                                      density(r) + added_[r]));
    }
  }

  Model& model_;
  std::vector<double> volume_, added_;  // by region
};

}  // namespace

void build_nonstructural_mass(Model& model) {
  std::optional<Densities> densities;
  for_each_card(model, {"NONSTRUCTURALMASS"}, [&](size_t use, const Card& card) {
    if (!densities) densities.emplace(model);
    densities->add(use, card);
  });
  if (densities) densities->finish();
}

}  // namespace clatter::mesh::deck::abaqus
