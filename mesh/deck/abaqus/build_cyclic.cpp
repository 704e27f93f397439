// SPDX-License-Identifier: GPL-3.0-or-later
// *CYCLIC SYMMETRY MODEL with its *TIE, CYCLIC SYMMETRY.
#include <fmt/format.h>

#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/cyclic.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// Mesh nodes on a surface of either type.
std::vector<int32_t> side(Model& model, size_t use, const Fields& fields, size_t i) {
  const std::string name = fields.word(i, "a surface");
  std::vector<int32_t> nodes;
  if (const auto* rows = node_surface(model, use, name)) {
    for (const int32_t row : *rows) {
      if (model.node_map.mesh_node(row) != NodeMap::kNone)
        nodes.push_back(model.node_map.mesh_node(row));
    }
  } else {
    nodes = nodes_of(model.deck.mesh.surfaces.at(surface_named(model, use, name, fields.origin())));
  }
  if (nodes.empty()) fields.fail(fmt::format("found no nodes of cells in surface {}", name));
  return nodes;
}

bool is_cyclic(const Card& card) {
  return card.keyword().key == "TIE" && card.keyword().has("CYCLICSYMMETRY");
}

void read_sides(Model& model, size_t use, const Card& tie, CyclicSector& sector) {
  tie.keyword().allow({"NAME", "POSITIONTOLERANCE", "ADJUST", "CYCLICSYMMETRY"}, model.source,
                      model.ignore);
  if (tie.size() != 1) {
    model.source.fail(tie.origin(), "*TIE, CYCLIC SYMMETRY: expected one line: two surfaces");
  }
  const Fields fields = tie.line(0, model.source);
  sector.one = side(model, use, fields, 0);
  sector.other = side(model, use, fields, 1);
}

void read_model(Model& model, size_t use, const Card& card, CyclicSector& sector) {
  const Keyword& keyword = card.keyword();
  const Source& source = model.source;
  keyword.allow({"N", "TIE", "ELSET", "NGRAPH", "CHECK"}, source, model.ignore);
  sector.where = source.where(card.origin());
  constexpr int32_t kMostSectors = 10000;
  sector.count = Fields(keyword.required("N", source), source, card.origin())
                     .integer(0, "N, the sectors of the ring", 2, kMostSectors);
  if (keyword.has("ELSET")) {
    const auto& elements = model.sets.elements(use, *keyword.find("ELSET"), card.origin());
    if (static_cast<int32_t>(elements.size()) != model.numbering.cells()) {
      source.fail(card.origin(),
                  "*CYCLIC SYMMETRY MODEL: found a sector of some elements only, "
                  "expected all: several stages are not supported");
    }
  }
  if (card.size() != 1) {
    source.fail(card.origin(), "*CYCLIC SYMMETRY MODEL: expected one line: two points of the axis");
  }
  const Fields fields = card.line(0, source);
  fields.at_most(6, "two points of the axis");
  for (size_t k = 0; k < 3; ++k) {
    const auto d = static_cast<Eigen::Index>(k);
    sector.point[d] = fields.number_or(k, "first point of the axis", 0.0);
    sector.axis[d] = fields.number_or(3 + k, "second point of the axis", 0.0) - sector.point[d];
  }
  if (!(sector.axis.norm() > 0.0)) fields.fail("expected two different points of the axis");
  sector.axis.normalize();
}

}  // namespace

void build_cyclic(Model& model) {
  if (model.refusals.any()) return;
  CyclicSector sector;
  const Card* tie = nullptr;
  const Card* ring = nullptr;
  const auto once = [&](const Card*& known, const Card& card) {
    if (known != nullptr) {
      model.source.fail(card.origin(), fmt::format("found a second {} of cyclic symmetry, expected "
                                                   "one: several stages are not supported",
                                                   card.keyword().name));
    }
    known = &card;
  };
  std::string modes;
  for_each_card(model, {"TIE", "CYCLICSYMMETRYMODEL", "SELECTCYCLICSYMMETRYMODES"},
                [&](size_t use, const Card& card) {
                  if (is_cyclic(card)) {
                    once(tie, card);
                    read_sides(model, use, card, sector);
                  } else if (card.keyword().key == "CYCLICSYMMETRYMODEL") {
                    once(ring, card);
                    read_model(model, use, card, sector);
                  } else if (card.keyword().key != "TIE") {
                    modes = ", of which the deck requests some (" +
                            model.source.where(card.origin()) + ")";
                  }
                });
  if (tie == nullptr && ring == nullptr) return;
  model.refusals.attempt([&] {
    if (ring == nullptr || tie == nullptr) {
      model.source.fail((tie != nullptr ? tie : ring)->origin(),
                        "*TIE, CYCLIC SYMMETRY and *CYCLIC SYMMETRY MODEL need each other");
    }
    if (model.refusals.any()) throw FollowUp();
    unfold(model.deck, sector);
    model.deck.notes.push_back(
        fmt::format("{}: the sector is expanded to the ring of {}: it has the modes of all nodal "
                    "diameters{}",
                    sector.where, sector.count, modes));
  });
}

}  // namespace clatter::mesh::deck::abaqus
