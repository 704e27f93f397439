// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/node_sets.hpp"

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
NodeIndex rigid_reference(Model& model, int32_t row) {
  NodeMap& node_map = model.node_map;
  return node_map.is_of_solids(row) ? node_map.point_upon(row) : node_map.require(row);
}

void read_rigid_body(Model& model, size_t use, const Card& card) {
  const Keyword& keyword = card.keyword();
  keyword.allow(
      {"NSET", "ELSET", "REFNODE", "ROTNODE", "TIENSET", "PINNSET", "POSITION", "ISOTHERMAL"},
      model.source, model.ignore);
  if (keyword.choice("POSITION", "INPUT") != "INPUT") {
    model.source.fail(card.origin(),
                      "*RIGID BODY: found POSITION=CENTER OF MASS, which moves its reference node, "
                      "expected that node at its place");
  }
  const int32_t row =
      model.sets.node_named(keyword.required("REFNODE", model.source), use, card.origin());
  Rigid rigid;
  rigid.name = fmt::format("rigid_body_{}", model.deck.rigid.size() + 1);
  rigid.where = model.source.where(card.origin());
  rigid.reference = rigid_reference(model, row);
  std::vector<int32_t> rows;
  for (const char* nodes : {"NSET", "TIENSET"}) {
    if (!keyword.has(nodes)) continue;
    const auto& more = model.sets.nodes(use, keyword.required(nodes, model.source), card.origin());
    rows.insert(rows.end(), more.begin(), more.end());
  }
  const bool only_nodes = keyword.has("NSET") || keyword.has("TIENSET") || keyword.has("PINNSET");
  if (keyword.has("ELSET") || !only_nodes) {
    const std::string& set = keyword.required("ELSET", model.source);
    for (const int32_t element : model.sets.elements(use, set, card.origin())) {
      if (model.numbering.point(element) != nullptr) continue;
      const auto nodes = model.numbering.rows_of(element);
      rows.insert(rows.end(), nodes.begin(), nodes.end());
    }
  }
  if (model.node_map.is_of_solids(row)) rows.push_back(row);
  sort_unique(rows);
  if (keyword.has("ROTNODE")) {
    const int32_t rotation =
        model.sets.node_named(keyword.required("ROTNODE", model.source), use, card.origin());
    if (model.node_map.mesh_node(rotation) != NodeMap::kNone || rotation == row) {
      model.source.fail(card.origin(),
                        "*RIGID BODY: found a ROT NODE that is the reference node "
                        "or belongs to an element, expected a separate node");
    }
    model.node_map.set_rotation_node(rotation, rigid.reference);
    std::erase(rows, rotation);
  }
  const std::string name = rigid.name;
  if (!rows.empty()) {
    model.dependents.emplace_back(model.deck.rigid.size(), std::move(rows));
    model.deck.rigid.push_back(rigid);
  }
  if (!keyword.has("PINNSET")) return;
  const auto& pins =
      model.sets.nodes(use, keyword.required("PINNSET", model.source), card.origin());
  rigid.name = name + "_pins";
  rigid.dofs = kTranslations;
  model.dependents.emplace_back(model.deck.rigid.size(), pins);
  model.deck.rigid.push_back(std::move(rigid));
}

// Lines "nodes, first DoF, last DoF" that follow the reference node.
void read_kinematic_coupling(Model& model, size_t use, const Card& card) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"REFNODE"}, model.source, model.ignore);
  const int32_t row =
      model.sets.node_named(keyword.required("REFNODE", model.source), use, card.origin());
  std::map<DofMask, std::vector<int32_t>> rows;
  for (size_t i = 0; i < card.size(); ++i) {
    const Fields fields = card.line(i, model.source);
    fields.at_most(3, "nodes, first and last DoF");
    const DofMask mask = fields.size() > 1 ? dof_range(fields, 1) : kAllDofs;
    for (const int32_t node : model.sets.nodes_at(fields, 0, use)) {
      if (mask != kAllDofs && !model.node_map.displacement_system(node).empty()) {
        fields.fail(
            "some directions only, of nodes with *TRANSFORM, are not supported; expected 1 "
            "to 6");
      }
      rows[mask].push_back(node);
    }
  }
  for (auto& [mask, nodes] : rows) {
    Rigid rigid;
    rigid.name = fmt::format("kinematic_{}", model.deck.rigid.size() + 1);
    rigid.where = model.source.where(card.origin());
    rigid.reference = rigid_reference(model, row);
    rigid.dofs = mask;
    if (&nodes == &rows.begin()->second && model.node_map.is_of_solids(row)) {
      nodes.push_back(row);  // the reference is a mesh node: its point moves it
    }
    sort_unique(nodes);
    model.dependents.emplace_back(model.deck.rigid.size(), std::move(nodes));
    model.deck.rigid.push_back(std::move(rigid));
  }
}

// *COUPLING and the line of *KINEMATIC or *DISTRIBUTING after it.
struct Coupling {
  size_t use = 0;
  const Card* card = nullptr;
  std::string name, surface;
  int32_t row = 0;
  bool oriented = false;
};

Coupling begin_coupling(Model& model, size_t use, const Card& card) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"CONSTRAINTNAME", "REFNODE", "SURFACE", "ORIENTATION"}, model.source,
                model.ignore);
  Coupling coupling;
  coupling.use = use;
  coupling.card = &card;
  const std::string* name = keyword.find("CONSTRAINTNAME");
  coupling.name = name != nullptr ? *name : "coupling";
  coupling.surface = keyword.required("SURFACE", model.source);
  coupling.row =
      model.sets.node_named(keyword.required("REFNODE", model.source), use, card.origin());
  coupling.oriented = keyword.has("ORIENTATION");
  return coupling;
}

// Rows of the nodes of a surface of either type.
std::vector<int32_t> rows_of_surface(Model& model, const Coupling& coupling) {
  const Origin origin = coupling.card->origin();
  if (const auto* rows = node_surface(model, coupling.use, coupling.surface)) return *rows;
  const std::string name = surface_named(model, coupling.use, coupling.surface, origin);
  std::vector<bool> wanted(static_cast<size_t>(model.deck.mesh.nodes.rows()), false);
  for (const int32_t node : nodes_of(model.deck.mesh.surfaces.at(name))) {
    wanted[node] = true;
  }
  std::vector<int32_t> rows;
  for (int32_t row = 0; row < model.numbering.nodes(); ++row) {
    const int32_t node = model.node_map.mesh_node(row);
    if (node != NodeMap::kNone && wanted[node]) rows.push_back(row);
  }
  return rows;
}

void read_kinematic(Model& model, const Coupling& coupling, const Card& card) {
  card.keyword().allow({}, model.source, model.ignore);
  Rigid rigid;
  rigid.name = coupling.name;
  rigid.where = model.source.where(coupling.card->origin());
  rigid.dofs = mask_of(card, model.source, kAllDofs);
  rigid.reference = rigid_reference(model, coupling.row);
  std::vector<int32_t> rows = rows_of_surface(model, coupling);
  if ((rigid.dofs & kTranslations) != kTranslations) {
    const bool turned = std::any_of(rows.begin(), rows.end(), [&](int32_t row) {
      return !model.node_map.displacement_system(row).empty();
    });
    if (coupling.oriented || turned) {
      model.source.fail(card.origin(),
                        "*KINEMATIC: some directions only, in axes other than the "
                        "basic ones, are not supported; expected 1 to 3");
    }
  }
  const bool own = std::find(rows.begin(), rows.end(), coupling.row) != rows.end();
  if (!own && model.node_map.is_of_solids(coupling.row)) {
    Rigid carrier = rigid;  // the reference is a mesh node: its point moves it
    carrier.name += "_reference";
    carrier.dofs = kAllDofs;
    model.dependents.emplace_back(model.deck.rigid.size(), std::vector<int32_t>{coupling.row});
    model.deck.rigid.push_back(std::move(carrier));
  }
  model.dependents.emplace_back(model.deck.rigid.size(), std::move(rows));
  model.deck.rigid.push_back(std::move(rigid));
}

// Weights are the areas of a surface of faces; nodes of a node surface have equal weights.
void read_weighted(Model& model, const Coupling& coupling, const Card& card) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"WEIGHTINGMETHOD", "COUPLING"}, model.source, model.ignore);
  if (keyword.choice("WEIGHTINGMETHOD", "UNIFORM") != "UNIFORM" ||
      keyword.choice("COUPLING", "CONTINUUM") != "CONTINUUM" || coupling.oriented) {
    model.source.fail(card.origin(),
                      "*DISTRIBUTING: expected WEIGHTING METHOD=UNIFORM, "
                      "COUPLING=CONTINUUM and no ORIENTATION");
  }
  Distributing distributing;
  distributing.name = coupling.name;
  distributing.where = model.source.where(coupling.card->origin());
  distributing.dofs = mask_of(card, model.source, kAllDofs);
  distributing.reference = model.node_map.require(coupling.row);
  if (const auto* rows = node_surface(model, coupling.use, coupling.surface)) {
    Distributing::Term term;
    for (const int32_t row : *rows) {
      if (model.node_map.mesh_node(row) != NodeMap::kNone) {
        term.node_indices.push_back(model.node_map.mesh_node(row));
      }
    }
    distributing.terms.push_back(std::move(term));
  } else {
    distributing.surface =
        surface_named(model, coupling.use, coupling.surface, coupling.card->origin());
  }
  model.deck.distributing.push_back(std::move(distributing));
}

void expect_coupling_done(const Model& model, const Card* open) {
  if (open == nullptr) return;
  model.source.fail(open->origin(), "*COUPLING: expected *KINEMATIC or *DISTRIBUTING after it");
}

/// The only data line of a card.
Fields only_line(const Model& model, const Card& card, const char* expected) {
  if (card.size() != 1)
    model.source.fail(card.origin(), fmt::format("{}: found {} data lines, expected one: {}",
                                                 card.keyword().name, card.size(), expected));
  return card.line(0, model.source);
}

/// A tie with its name and tolerance.
Tie begin_tie(const Model& model, const Card& card, const char* name_parameter) {
  const std::string* name = card.keyword().find(name_parameter);
  Tie tie;
  tie.name = name != nullptr ? *name : fmt::format("tie_{}", model.deck.ties.size() + 1);
  tie.where = model.source.where(card.origin());
  if (const std::string* tolerance = card.keyword().find("POSITIONTOLERANCE"))
    tie.distance = Fields(*tolerance, model.source, card.origin()).number(0, "POSITION TOLERANCE");
  return tie;
}

void read_tie(Model& model, size_t use, const Card& card) {
  card.keyword().allow({"NAME", "POSITIONTOLERANCE", "ADJUST", "TYPE", "NOROTATION", "NOTHICKNESS"},
                       model.source, model.ignore);
  const Fields fields = only_line(model, card, "slave, master");
  Tie tie = begin_tie(model, card, "NAME");
  tie.slave = surface_named(model, use, fields.word(0, "slave surface"), fields.origin());
  tie.master = surface_named(model, use, fields.word(1, "master surface"), fields.origin());
  model.deck.ties.push_back(std::move(tie));
}

/// The node set of a surface of edges, or of nodes, of shells.
std::string edge_set(Model& model, size_t use, const Fields& fields, const std::string& tie) {
  const std::string name = fields.word(0, "shell surface");
  const std::vector<int32_t>* rows = node_surface(model, use, name);
  if (rows == nullptr && model.refusals.has_lost(folded(name))) throw FollowUp();
  if (rows == nullptr)
    fields.fail(fmt::format("found no surface {} of edges of shells, expected one", shown(name)));
  auto& sets = model.deck.mesh.node_sets;
  std::string set = tie + "_edge";
  for (int i = 2; sets.contains(set); ++i) set = fmt::format("{}_edge_{}", tie, i);
  std::vector<int32_t>& nodes = sets[set];
  for (const int32_t row : *rows) nodes.push_back(model.node_map.mesh_node(row));
  sort_unique(nodes);
  return set;
}

// The influence distance of Abaqus is the footprint, as wide as the sheet is thick.
void read_shell_to_solid(Model& model, size_t use, const Card& card) {
  card.keyword().allow({"CONSTRAINTNAME", "INFLUENCEDISTANCE", "POSITIONTOLERANCE"}, model.source,
                       model.ignore);
  const Fields fields = only_line(model, card, "surface of the shell's edge, surface of the solid");
  Tie tie = begin_tie(model, card, "CONSTRAINTNAME");
  tie.edge = edge_set(model, use, fields, tie.name);
  tie.master = surface_named(model, use, fields.word(1, "solid surface"), fields.origin());
  model.deck.ties.push_back(std::move(tie));
}

}  // namespace

DofMask dof_range(const Fields& fields, size_t i) {
  constexpr std::string_view kWhat = "DoF: 1 to 3 displacements, 4 to 6 rotations";
  const int32_t first = fields.integer(i, kWhat, 1, 6);
  const int32_t last = fields.blank(i + 1) ? first : fields.integer(i + 1, kWhat, first, 6);
  DofMask mask = 0;
  for (int32_t dof = first; dof <= last; ++dof) mask = static_cast<DofMask>(mask | 1 << (dof - 1));
  return mask;
}

void build_couplings(Model& model) {
  for_each_card(model, {"RIGIDBODY"},
                [&](size_t use, const Card& card) { read_rigid_body(model, use, card); });
  for_each_card(model, {"KINEMATICCOUPLING"},
                [&](size_t use, const Card& card) { read_kinematic_coupling(model, use, card); });
  Coupling coupling;
  bool refused = false;
  for_each_card(model, {"COUPLING", "KINEMATIC", "DISTRIBUTING"},
                [&](size_t use, const Card& card) {
                  if (card.keyword().key == "COUPLING") {
                    model.refusals.attempt([&] { expect_coupling_done(model, coupling.card); });
                    coupling = Coupling();
                    refused = true;
                    coupling = begin_coupling(model, use, card);
                    refused = false;
                    return;
                  }
                  if (refused) throw FollowUp();
                  if (coupling.card == nullptr) {
                    model.source.fail(card.origin(), "expected one line after *COUPLING");
                  }
                  const Coupling done = std::exchange(coupling, Coupling());
                  if (card.keyword().key == "KINEMATIC") {
                    read_kinematic(model, done, card);
                  } else {
                    read_weighted(model, done, card);
                  }
                });
  model.refusals.attempt([&] { expect_coupling_done(model, coupling.card); });
}

void build_ties(Model& model) {
  for_each_card(model, {"TIE"}, [&](size_t use, const Card& card) {
    if (!card.keyword().has("CYCLICSYMMETRY")) read_tie(model, use, card);
  });
  for_each_card(model, {"SHELLTOSOLIDCOUPLING"},
                [&](size_t use, const Card& card) { read_shell_to_solid(model, use, card); });
}

void finish_couplings(Model& model) {
  std::set<NodeIndex> carried;  // mesh nodes that their own point already moves
  for (const auto& [index, rows] : model.dependents) {
    Rigid& rigid = model.deck.rigid[index];
    for (const int32_t row : rows) {
      NodeIndex node_index = model.node_map.find(row);
      if (node_index == rigid.reference) {
        if (!model.node_map.is_of_solids(row)) continue;
        node_index = model.node_map.mesh_node(row);
        if (!carried.insert(node_index).second) continue;
      }
      if (node_index != NodeMap::kNone) rigid.dependents.push_back(node_index);
    }
  }
  // Of rigid elements, say, that touch no solid.
  std::erase_if(model.deck.rigid, [&](const Rigid& rigid) {
    if (!rigid.dependents.empty()) return false;
    model.deck.notes.push_back(fmt::format(
        "{}: the rigid body moves no node of a solid or of a mass: left out", rigid.where));
    return true;
  });
}

}  // namespace clatter::mesh::deck::abaqus
