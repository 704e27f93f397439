// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "mesh/deck/abaqus/reading.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// Mask of all "first, last" lines of a card; `all` if there are none.
DofMask mask_of(const Card& card, const Source& source, DofMask all) {
  DofMask mask = 0;
  for (size_t i = 0; i < card.size(); ++i) {
    const Fields fields = card.line(i, source);
    fields.at_most(2, "first and last DoF");
    mask = static_cast<DofMask>(mask | dof_range(fields, 0));
  }
  return card.size() == 0 ? all : mask;
}

// Node index of a reference node: with its own rotations, even on a mesh node.
NodeIndex rigid_reference(Reading* reading, int32_t row) {
  NodeMap& node_map = *reading->node_map;
  return node_map.mesh_node(row) == NodeMap::kNone ? node_map.of(row) : node_map.point_upon(row);
}

void read_rigid_body(Reading* reading, size_t use, const Card& card) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"NSET", "ELSET", "REFNODE", "ROTNODE"}, reading->source, reading->ignore);
  const int32_t row =
      reading->sets->node_named(keyword.required("REFNODE", reading->source), use, card.spot());
  Rigid rigid;
  rigid.name = fmt::format("rigid_body_{}", reading->deck->rigid.size() + 1);
  rigid.where = reading->source.where(card.spot());
  rigid.reference = rigid_reference(reading, row);
  std::vector<int32_t> rows;
  if (keyword.has("NSET")) {
    rows = reading->sets->nodes(use, keyword.required("NSET", reading->source), card.spot());
  } else {
    const std::string& set = keyword.required("ELSET", reading->source);
    for (const int32_t element : reading->sets->elements(use, set, card.spot())) {
      if (element >= reading->model->cells()) continue;
      const auto nodes = reading->model->nodes_of(element);
      rows.insert(rows.end(), nodes.begin(), nodes.end());
    }
  }
  if (reading->node_map->mesh_node(row) != NodeMap::kNone) rows.push_back(row);
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  if (keyword.has("ROTNODE")) {
    const int32_t rotation =
        reading->sets->node_named(keyword.required("ROTNODE", reading->source), use, card.spot());
    if (reading->node_map->mesh_node(rotation) != NodeMap::kNone || rotation == row) {
      reading->source.fail(card.spot(),
                           "*RIGID BODY: found a ROT NODE that is the reference node "
                           "or belongs to an element, expected a separate node");
    }
    reading->node_map->set_rotation_node(rotation, rigid.reference);
    std::erase(rows, rotation);
  }
  reading->dependents.emplace_back(reading->deck->rigid.size(), std::move(rows));
  reading->deck->rigid.push_back(std::move(rigid));
}

// *COUPLING and the line of *KINEMATIC or *DISTRIBUTING after it.
struct Coupling {
  size_t use = 0;
  const Card* card = nullptr;
  std::string name, surface;
  int32_t row = 0;
  bool oriented = false;
};

Coupling begin_coupling(Reading* reading, size_t use, const Card& card) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"CONSTRAINTNAME", "REFNODE", "SURFACE", "ORIENTATION"}, reading->source,
                reading->ignore);
  Coupling coupling;
  coupling.use = use;
  coupling.card = &card;
  const std::string* name = keyword.find("CONSTRAINTNAME");
  coupling.name = name != nullptr ? *name : "coupling";
  coupling.surface = keyword.required("SURFACE", reading->source);
  coupling.row =
      reading->sets->node_named(keyword.required("REFNODE", reading->source), use, card.spot());
  coupling.oriented = keyword.has("ORIENTATION");
  return coupling;
}

// Rows of the nodes of a surface of either type.
std::vector<int32_t> rows_of_surface(Reading* reading, const Coupling& coupling) {
  const Spot spot = coupling.card->spot();
  if (const auto* rows = node_surface(*reading, coupling.use, coupling.surface)) return *rows;
  const std::string name = surface_named(reading, coupling.use, coupling.surface, spot);
  std::vector<bool> wanted(static_cast<size_t>(reading->deck->mesh.nodes.rows()), false);
  for (const int32_t node : nodes_of(reading->deck->mesh.surfaces.at(name))) {
    wanted[static_cast<size_t>(node)] = true;
  }
  std::vector<int32_t> rows;
  for (int32_t row = 0; row < reading->model->nodes(); ++row) {
    const int32_t node = reading->node_map->mesh_node(row);
    if (node != NodeMap::kNone && wanted[static_cast<size_t>(node)]) rows.push_back(row);
  }
  return rows;
}

void read_kinematic(Reading* reading, const Coupling& coupling, const Card& card) {
  card.keyword().allow({}, reading->source, reading->ignore);
  Rigid rigid;
  rigid.name = coupling.name;
  rigid.where = reading->source.where(coupling.card->spot());
  rigid.dofs = mask_of(card, reading->source, kAllDofs);
  rigid.reference = rigid_reference(reading, coupling.row);
  std::vector<int32_t> rows = rows_of_surface(reading, coupling);
  if ((rigid.dofs & kTranslations) != kTranslations) {
    const bool turned = std::any_of(rows.begin(), rows.end(), [&](int32_t row) {
      return !reading->node_map->system(row).empty();
    });
    if (coupling.oriented || turned) {
      reading->source.fail(card.spot(),
                           "*KINEMATIC: some directions only, in axes other than the "
                           "basic ones, are not supported; expected 1 to 3");
    }
  }
  const bool own = std::find(rows.begin(), rows.end(), coupling.row) != rows.end();
  if (!own && reading->node_map->mesh_node(coupling.row) != NodeMap::kNone) {
    Rigid carrier = rigid;  // the reference is a mesh node: its point moves it
    carrier.name += "_reference";
    carrier.dofs = kAllDofs;
    reading->dependents.emplace_back(reading->deck->rigid.size(),
                                     std::vector<int32_t>{coupling.row});
    reading->deck->rigid.push_back(std::move(carrier));
  }
  reading->dependents.emplace_back(reading->deck->rigid.size(), std::move(rows));
  reading->deck->rigid.push_back(std::move(rigid));
}

// Weights are the areas of a surface of faces; nodes of a node surface have equal weights.
void read_weighted(Reading* reading, const Coupling& coupling, const Card& card) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"WEIGHTINGMETHOD", "COUPLING"}, reading->source, reading->ignore);
  if (keyword.choice("WEIGHTINGMETHOD", "UNIFORM") != "UNIFORM" ||
      keyword.choice("COUPLING", "CONTINUUM") != "CONTINUUM" || coupling.oriented) {
    reading->source.fail(card.spot(),
                         "*DISTRIBUTING: expected WEIGHTING METHOD=UNIFORM, "
                         "COUPLING=CONTINUUM and no ORIENTATION");
  }
  Distributing distributing;
  distributing.name = coupling.name;
  distributing.where = reading->source.where(coupling.card->spot());
  distributing.dofs = mask_of(card, reading->source, kAllDofs);
  distributing.reference = reading->node_map->of(coupling.row);
  if (const auto* rows = node_surface(*reading, coupling.use, coupling.surface)) {
    Distributing::Term term;
    for (const int32_t row : *rows) {
      if (reading->node_map->mesh_node(row) != NodeMap::kNone) {
        term.node_indices.push_back(reading->node_map->mesh_node(row));
      }
    }
    distributing.terms.push_back(std::move(term));
  } else {
    distributing.surface =
        surface_named(reading, coupling.use, coupling.surface, coupling.card->spot());
  }
  reading->deck->distributing.push_back(std::move(distributing));
}

void expect_coupling_done(const Reading& reading, const Card* open) {
  if (open == nullptr) return;
  reading.source.fail(open->spot(), "*COUPLING: expected *KINEMATIC or *DISTRIBUTING after it");
}

void read_tie(Reading* reading, size_t use, const Card& card) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"NAME", "POSITIONTOLERANCE", "ADJUST", "TYPE", "NOROTATION"}, reading->source,
                reading->ignore);
  if (card.size() != 1) {
    reading->source.fail(card.spot(), fmt::format("*TIE: found {} data lines, expected one: slave, "
                                                  "master",
                                                  card.size()));
  }
  const Fields fields = card.line(0, reading->source);
  Tie tie;
  const std::string* name = keyword.find("NAME");
  tie.name = name != nullptr ? *name : fmt::format("tie_{}", reading->deck->ties.size() + 1);
  tie.where = reading->source.where(card.spot());
  tie.slave = surface_named(reading, use, fields.word(0, "slave surface"), fields.spot());
  tie.master = surface_named(reading, use, fields.word(1, "master surface"), fields.spot());
  if (const std::string* tolerance = keyword.find("POSITIONTOLERANCE")) {
    tie.distance = Fields(*tolerance, reading->source, card.spot()).number(0, "POSITION TOLERANCE");
  }
  reading->deck->ties.push_back(std::move(tie));
}

}  // namespace

DofMask dof_range(const Fields& fields, size_t i) {
  constexpr std::string_view kWhat = "DoF: 1 to 3 displacements, 4 to 6 rotations";
  const int32_t first = fields.integer(i, kWhat, 1, 6);
  const int32_t last = fields.empty(i + 1) ? first : fields.integer(i + 1, kWhat, first, 6);
  DofMask mask = 0;
  for (int32_t dof = first; dof <= last; ++dof) mask = static_cast<DofMask>(mask | 1 << (dof - 1));
  return mask;
}

void read_rigid(Reading* reading) {
  for_each_card(*reading, {"RIGIDBODY"},
                [&](size_t use, const Card& card) { read_rigid_body(reading, use, card); });
  Coupling coupling;
  bool refused = false;
  for_each_card(
      *reading, {"COUPLING", "KINEMATIC", "DISTRIBUTING"}, [&](size_t use, const Card& card) {
        if (card.keyword().key == "COUPLING") {
          reading->refusals->attempt([&] { expect_coupling_done(*reading, coupling.card); });
          coupling = Coupling();
          refused = true;
          coupling = begin_coupling(reading, use, card);
          refused = false;
          return;
        }
        if (refused) throw FollowUp();
        if (coupling.card == nullptr) {
          reading->source.fail(card.spot(), "expected one line after *COUPLING");
        }
        const Coupling done = std::exchange(coupling, Coupling());
        if (card.keyword().key == "KINEMATIC") {
          read_kinematic(reading, done, card);
        } else {
          read_weighted(reading, done, card);
        }
      });
  reading->refusals->attempt([&] { expect_coupling_done(*reading, coupling.card); });
}

void read_ties(Reading* reading) {
  for_each_card(*reading, {"TIE"}, [&](size_t use, const Card& card) {
    if (!card.keyword().has("CYCLICSYMMETRY")) read_tie(reading, use, card);
  });
}

void finish_rigid(Reading* reading) {
  std::set<NodeIndex> carried;  // mesh nodes that their own point already moves
  for (const auto& [index, rows] : reading->dependents) {
    Rigid& rigid = reading->deck->rigid[index];
    for (const int32_t row : rows) {
      NodeIndex node_index = reading->node_map->find(row);
      if (node_index == rigid.reference) {
        node_index = reading->node_map->mesh_node(row);
        if (node_index == NodeMap::kNone || !carried.insert(node_index).second) continue;
      }
      if (node_index != NodeMap::kNone) rigid.dependents.push_back(node_index);
    }
  }
}

}  // namespace clatter::mesh::deck::abaqus
