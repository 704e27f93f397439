// SPDX-License-Identifier: GPL-3.0-or-later
// *CYCLIC SYMMETRY MODEL with its *TIE, CYCLIC SYMMETRY.
#include <fmt/format.h>

#include "mesh/deck/abaqus/reading.hpp"
#include "mesh/deck/cyclic.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// Mesh nodes on a surface of either type.
std::vector<int32_t> side(Reading* reading, size_t use, const Fields& fields, size_t i) {
  const std::string name = fields.word(i, "a surface");
  std::vector<int32_t> nodes;
  if (const auto* rows = node_surface(*reading, use, name)) {
    for (const int32_t row : *rows) {
      if (reading->node_map->mesh_node(row) != NodeMap::kNone)
        nodes.push_back(reading->node_map->mesh_node(row));
    }
  } else {
    nodes =
        nodes_of(reading->deck->mesh.surfaces.at(surface_named(reading, use, name, fields.spot())));
  }
  if (nodes.empty()) fields.fail(fmt::format("found no nodes of cells in surface {}", name));
  return nodes;
}

bool is_cyclic(const Card& card) {
  return card.keyword().key == "TIE" && card.keyword().has("CYCLICSYMMETRY");
}

void read_sides(Reading* reading, size_t use, const Card& tie, CyclicSector* sector) {
  tie.keyword().allow({"NAME", "POSITIONTOLERANCE", "ADJUST", "CYCLICSYMMETRY"}, reading->source,
                      reading->ignore);
  if (tie.size() != 1) {
    reading->source.fail(tie.spot(), "*TIE, CYCLIC SYMMETRY: expected one line: two surfaces");
  }
  const Fields fields = tie.line(0, reading->source);
  sector->one = side(reading, use, fields, 0);
  sector->other = side(reading, use, fields, 1);
}

void read_model(Reading* reading, size_t use, const Card& card, CyclicSector* sector) {
  const Keyword& keyword = card.keyword();
  const Source& source = reading->source;
  keyword.allow({"N", "TIE", "ELSET", "NGRAPH", "CHECK"}, source, reading->ignore);
  sector->where = source.where(card.spot());
  constexpr int32_t kMostSectors = 10000;
  sector->count = Fields(keyword.required("N", source), source, card.spot())
                      .integer(0, "N, the sectors of the ring", 2, kMostSectors);
  if (keyword.has("ELSET")) {
    const auto& elements = reading->sets->elements(use, *keyword.find("ELSET"), card.spot());
    if (static_cast<int32_t>(elements.size()) != reading->model->cells()) {
      source.fail(card.spot(),
                  "*CYCLIC SYMMETRY MODEL: found a sector of some elements only, "
                  "expected all: several stages are not supported");
    }
  }
  if (card.size() != 1) {
    source.fail(card.spot(), "*CYCLIC SYMMETRY MODEL: expected one line: two points of the axis");
  }
  const Fields fields = card.line(0, source);
  fields.at_most(6, "two points of the axis");
  for (size_t k = 0; k < 3; ++k) {
    const auto d = static_cast<Eigen::Index>(k);
    sector->point[d] = fields.number_or(k, 0.0, "first point of the axis");
    sector->axis[d] = fields.number_or(3 + k, 0.0, "second point of the axis") - sector->point[d];
  }
  if (!(sector->axis.norm() > 0.0)) fields.fail("expected two different points of the axis");
  sector->axis.normalize();
}

}  // namespace

void read_cyclic(Reading* reading) {
  if (reading->refusals->any()) return;
  CyclicSector sector;
  const Card* tie = nullptr;
  const Card* model = nullptr;
  const auto once = [&](const Card*& known, const Card& card) {
    if (known != nullptr) {
      reading->source.fail(card.spot(),
                           fmt::format("found a second {} of cyclic symmetry, expected "
                                       "one: several stages are not supported",
                                       card.keyword().name));
    }
    known = &card;
  };
  std::string modes;
  for_each_card(*reading, {"TIE", "CYCLICSYMMETRYMODEL", "SELECTCYCLICSYMMETRYMODES"},
                [&](size_t use, const Card& card) {
                  if (is_cyclic(card)) {
                    once(tie, card);
                    read_sides(reading, use, card, &sector);
                  } else if (card.keyword().key == "CYCLICSYMMETRYMODEL") {
                    once(model, card);
                    read_model(reading, use, card, &sector);
                  } else if (card.keyword().key != "TIE") {
                    modes = ", of which the deck requests some (" +
                            reading->source.where(card.spot()) + ")";
                  }
                });
  if (tie == nullptr && model == nullptr) return;
  reading->refusals->attempt([&] {
    if (model == nullptr || tie == nullptr) {
      reading->source.fail((tie != nullptr ? tie : model)->spot(),
                           "expected both *TIE, CYCLIC SYMMETRY and *CYCLIC SYMMETRY MODEL");
    }
    if (reading->refusals->any()) throw FollowUp();
    unfold(reading->deck, sector);
    reading->deck->notes.push_back(
        fmt::format("{}: the sector is expanded to the ring of {}: it has the modes of all nodal "
                    "diameters{}",
                    sector.where, sector.count, modes));
  });
}

}  // namespace clatter::mesh::deck::abaqus
