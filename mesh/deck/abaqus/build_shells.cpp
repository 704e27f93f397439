// SPDX-License-Identifier: GPL-3.0-or-later
// *SHELL SECTION and *NODAL THICKNESS with their elements S3 to S8R.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/error.hpp"
#include "mesh/deck/abaqus/cells.hpp"
#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

/// What a section gives to its shells.
struct ShellGift {
  double thickness = 0.0;
  double offset = 0.0;    // OFFSET: from the mid-surface to the nodes, over the thickness
  bool is_nodal = false;  // NODAL THICKNESS
};

ShellFace face_of(const Model& model, size_t thin) {
  const ThinElement& element = model.numbering.thin()[thin];
  ShellFace face{.type = *element.face};
  for (size_t i = 0; i < static_cast<size_t>(element.count); ++i)
    face.nodes[i] = model.node_map.mesh_node(element.nodes[i]);
  const auto centre = model.shells.centres.find(static_cast<int32_t>(thin));
  if (centre != model.shells.centres.end()) face.centre = centre->second;
  return face;
}

bool is_shell(const Model& model, size_t thin) {
  return model.shells.section(static_cast<int32_t>(thin)) >= 0;
}

class ShellSections {
 public:
  explicit ShellSections(Model& model) : model_(model) {}

  void read() {
    for_each_card(model_, {"NODALTHICKNESS"},
                  [&](size_t use, const Card& card) { read_thickness(use, card); });
    size_t section = 0;
    std::vector<int32_t>& regions = model_.shells.regions;
    for_each_card(model_, {"SHELLSECTION"}, [&](size_t use, const Card& card) {
      const size_t at = section++;
      regions.resize(section, -1);
      gifts_.resize(section);
      if (std::ranges::find(model_.shells.section_of, static_cast<int32_t>(at)) ==
          model_.shells.section_of.end())
        return;  // only skins of solids
      gifts_[at] = gift_of(card);
      regions[at] = add_region(use, card, gifts_[at]);
    });
    for (const IdSet* set : model_.shells.sets) {
      gifts_.emplace_back();
      regions.push_back(
          new_region(model_.numbering.main_use(), set->name, set->chunks.front().origin, ""));
    }
  }

  ShellCell cell_of(size_t thin) const {
    const ThinElement& element = model_.numbering.thin()[thin];
    const auto section = static_cast<size_t>(model_.shells.section_of[thin]);
    if (model_.shells.regions[section] < 0) throw FollowUp();
    const ShellGift& gift = gifts_[section];
    ShellCell cell{element.type, element.id, model_.shells.regions[section], face_of(model_, thin),
                   -gift.offset * gift.thickness};
    std::array<double, 4>& t = cell.face.values;
    t.fill(gift.thickness);
    const auto corners = static_cast<size_t>(traits(*element.face).corners);
    for (size_t i = 0; gift.is_nodal && i < corners; ++i) t[i] = nodal(element, i);
    if (!gift.is_nodal || gift.offset == 0.0) return cell;
    if (std::any_of(t.begin(), t.begin() + corners, [&](double one) { return one != t[0]; }))
      model_.source.fail(element.origin,
                         fmt::format("element {}: found OFFSET and a *NODAL THICKNESS that varies "
                                     "over it, expected one of them",
                                     element.id));
    cell.offset = -gift.offset * t[0];
    return cell;
  }

 private:
  void read_thickness(size_t use, const Card& card) {
    card.keyword().allow({}, model_.source, model_.ignore);
    if (nodal_.empty())
      nodal_.assign(static_cast<size_t>(model_.numbering.nodes()),
                    std::numeric_limits<double>::quiet_NaN());
    for (size_t i = 0; i < card.size(); ++i) {
      const Fields fields = card.line(i, model_.source);
      fields.at_most(2, "nodes, thickness");
      const double t = positive(fields, 1, "thickness");
      for (const int32_t row : model_.sets.nodes_at(fields, 0, use))
        nodal_[static_cast<size_t>(row)] = t;
    }
  }

  static double positive(const Fields& fields, size_t i, const char* what) {
    const double value = fields.number(i, what);
    if (!(value > 0.0))
      fields.fail(fmt::format("found a {} of {:g}, expected more than 0", what, value));
    return value;
  }

  double nodal(const ThinElement& element, size_t i) const {
    const auto row = static_cast<size_t>(element.nodes[i]);
    if (nodal_.empty() || std::isnan(nodal_[row]))
      model_.source.fail(element.origin,
                         fmt::format("element {}: found no *NODAL THICKNESS of node {}", element.id,
                                     model_.numbering.node_ids()[row]));
    return nodal_[row];
  }

  ShellGift gift_of(const Card& card) const {
    const Keyword& keyword = card.keyword();
    for (const char* layers : {"COMPOSITE", "LAYUP"})
      if (keyword.has(layers))
        model_.source.fail(card.origin(),
                           fmt::format("*SHELL SECTION: {}: shells of layers are not read: one "
                                       "material of their mean stiffness replaces them; ignore = "
                                       "[\"*SHELL SECTION\"] leaves out all shells",
                                       layers));
    keyword.allow({"ELSET", "MATERIAL", "OFFSET", "NODALTHICKNESS", "DENSITY", "POISSON",
                   "SECTIONINTEGRATION", "CONTROLS", "THICKNESSMODULUS", "TEMPERATURE"},
                  model_.source, model_.ignore);
    ShellGift gift{.offset = offset_of(card), .is_nodal = keyword.has("NODALTHICKNESS")};
    if (gift.is_nodal) return gift;
    if (card.size() == 0)
      model_.source.fail(card.origin(), "*SHELL SECTION: found no data line, expected a thickness");
    const Fields fields = card.line(0, model_.source);
    fields.at_most(2, "thickness, integration points");
    gift.thickness = positive(fields, 0, "thickness");
    return gift;
  }

  // From the mid-surface to the nodes, along the normal, over the thickness: 0.5 where the nodes
  // are on the top surface (Abaqus Analysis User's Guide, defining the reference surface).
  double offset_of(const Card& card) const {
    const std::string text = card.keyword().choice("OFFSET", "0");
    if (text == "SPOS") return 0.5;
    if (text == "SNEG") return -0.5;
    if (const auto number = to_number(text)) return *number;
    model_.source.fail(card.origin(),
                       fmt::format("*SHELL SECTION: found OFFSET={}, expected a number, SPOS or "
                                   "SNEG",
                                   text));
  }

  int32_t add_region(size_t use, const Card& card, const ShellGift& gift) {
    const Keyword& keyword = card.keyword();
    const std::string& elset = keyword.required("ELSET", model_.source);
    const IdSets& sets = model_.numbering.uses()[use].scope->element_sets;
    const auto set = sets.find(folded(elset));
    const int32_t index = new_region(use, set == sets.end() ? elset : set->second.name,
                                     card.origin(), material_of(card));
    const Region& region = model_.deck.regions.back();
    const std::string& name = model_.deck.mesh.regions.back();
    recipe::Shell shell{recipe::Source(region.where), {name}, {}};
    shell.section.thickness = gift.thickness;
    if (const std::string* density = keyword.find("DENSITY")) {
      shell.section.area_mass = to_number(*density).value_or(-1.0);
      if (!(shell.section.area_mass >= 0.0))
        model_.source.fail(card.origin(), fmt::format("*SHELL SECTION: found DENSITY={}, expected "
                                                      "a mass per area",
                                                      *density));
    }
    model_.deck.shells.push_back(std::move(shell));
    return index;
  }

  int32_t new_region(size_t use, const std::string& set, Origin origin,
                     const std::string& material) {
    const std::string name = model_.numbering.public_name(use, set);
    std::vector<std::string>& names = model_.deck.mesh.regions;
    if (std::ranges::find(names, name) != names.end())
      model_.source.fail(origin, fmt::format("found a second region {}", name));
    Region region;
    region.where = model_.source.where(origin);
    region.material = material;
    names.push_back(name);
    model_.deck.regions.push_back(std::move(region));
    return static_cast<int32_t>(names.size()) - 1;
  }

  std::string material_of(const Card& card) const {
    const std::string& wanted = card.keyword().required("MATERIAL", model_.source);
    const auto known = model_.material_names.find(folded(wanted));
    if (known == model_.material_names.end()) {
      if (model_.refusals.has_lost(folded(wanted))) throw FollowUp();
      model_.source.fail(card.origin(), fmt::format("found no material {}", shown(wanted)));
    }
    const Material& material = model_.deck.materials.at(known->second);
    if (material.kind != Material::Kind::kIsotropic || material.constants.empty())
      model_.source.fail(card.origin(), fmt::format("*SHELL SECTION: material {} is not isotropic, "
                                                    "expected *ELASTIC of E and nu",
                                                    wanted));
    return known->second;
  }

  Model& model_;
  std::vector<ShellGift> gifts_;
  std::vector<double> nodal_;  // by row; NaN: none
};

class ShellFinder {
 public:
  explicit ShellFinder(Model& model)
      : model_(model), on_solid_(static_cast<size_t>(model.numbering.nodes()), false) {
    for (const FlatTable& table : model.numbering.tables())
      for (const int32_t row : table.nodes) on_solid_[static_cast<size_t>(row)] = true;
    model.shells.section_of.assign(model.numbering.thin().size(), -1);
  }

  void run() {
    int32_t section = 0;
    for_each_card(model_, {"SHELLSECTION"}, [&](size_t use, const Card& card) {
      const int32_t number = section++;
      const std::string& set = card.keyword().required("ELSET", model_.source);
      for (const int32_t element : model_.sets.elements(use, set, card.origin())) {
        int32_t* at = section_of(element);
        if (at == nullptr) continue;
        if (*at >= 0)
          model_.source.fail(card.origin(), fmt::format("element {} has a section already",
                                                        model_.numbering.thin(element)->id));
        *at = number;
      }
    });
    if (section == 0 && model_.shells.are_marked) take_sets();
  }

 private:
  // Of an element that may be a shell; null for others, as skins of solids.
  int32_t* section_of(int32_t element) const {
    const ThinElement* one = model_.numbering.thin(element);
    if (one == nullptr || !is_shell_type(one->type)) return nullptr;
    const auto corners = one->nodes.begin() + traits(*one->face).corners;
    if (std::all_of(one->nodes.begin(), corners, [&](int32_t row) { return on_solid_[row]; }))
      return nullptr;
    return &model_.shells.section_of[static_cast<size_t>(element - model_.numbering.first_thin())];
  }

  // In the order of the deck.
  void take_sets() {
    const size_t use = model_.numbering.main_use();
    std::map<Origin, const IdSet*> sets;
    for (const auto& [key, set] : model_.numbering.uses()[use].scope->element_sets)
      sets.emplace(set.chunks.front().origin, &set);
    std::vector<const IdSet*>& taken = model_.shells.sets;
    for (const auto& [origin, set] : sets) {
      bool any = false;
      for (const int32_t element : model_.sets.elements(use, set->name, origin)) {
        int32_t* at = section_of(element);
        if (at == nullptr || *at >= 0) continue;
        *at = static_cast<int32_t>(taken.size());
        any = true;
      }
      if (any) taken.push_back(set);
    }
  }

  Model& model_;
  std::vector<bool> on_solid_;
};

void note_integration(Model& model) {
  std::set<std::string> reduced;
  Origin first = 0;
  for (size_t t = 0; t < model.shells.section_of.size(); ++t) {
    const ThinElement& one = model.numbering.thin()[t];
    if (!is_shell(model, t) || !one.type.ends_with('R')) continue;
    if (reduced.empty()) first = one.origin;
    reduced.insert(one.type);
  }
  if (!reduced.empty())
    model.deck.notes.push_back(
        fmt::format("{}: {} are read with full integration: no hourglass control",
                    model.source.where(first), fmt::join(reduced, ", ")));
}

}  // namespace

void find_shells(Model& model) { ShellFinder(model).run(); }

void add_shell_nodes(Model& model) {
  Mesh& mesh = model.deck.mesh;
  std::vector<Eigen::Vector3d> centres;
  for (size_t t = 0; t < model.shells.section_of.size(); ++t) {
    if (!is_shell(model, t) || !has_centre(face_of(model, t))) continue;
    std::array<Eigen::Vector3d, 8> at;
    for (size_t i = 0; i < 8; ++i) at[i] = model.numbering.at(model.numbering.thin()[t].nodes[i]);
    model.shells.centres[static_cast<int32_t>(t)] =
        static_cast<NodeIndex>(mesh.nodes.rows() + std::ssize(centres));
    centres.push_back(shell_centre(at));
  }
  int32_t highest = model.numbering.highest_node();
  for (const int32_t id : mesh.node_ids) highest = std::max(highest, id);
  if (std::numeric_limits<int32_t>::max() - highest < std::ssize(centres))
    throw InputError("found no free numbers for nodes in shells");
  const Eigen::Index first = mesh.nodes.rows();
  mesh.nodes.conservativeResize(first + std::ssize(centres), Eigen::NoChange);
  for (size_t i = 0; i < centres.size(); ++i) {
    mesh.nodes.row(first + static_cast<Eigen::Index>(i)) = centres[i];
    mesh.node_ids.push_back(++highest);
  }
  mesh.deck.largest_node = std::max(mesh.deck.largest_node, highest);
  std::vector<bool> turns(static_cast<size_t>(mesh.nodes.rows()), false);
  for (size_t t = 0; t < model.shells.section_of.size(); ++t) {
    if (!is_shell(model, t)) continue;
    const ShellFace face = face_of(model, t);
    for (size_t i = 0; i < static_cast<size_t>(traits(face.type).nodes); ++i)
      turns[static_cast<size_t>(face.nodes[i])] = true;
    if (face.centre >= 0) turns[static_cast<size_t>(face.centre)] = true;
  }
  model.node_map.set_turning(std::move(turns));
}

void build_shells(Model& model) {
  ShellSections sections(model);
  sections.read();
  std::vector<ShellCell> cells;
  std::vector<Origin> origins;
  for (size_t t = 0; t < model.shells.section_of.size(); ++t)
    if (is_shell(model, t) && model.refusals.attempt([&] { cells.push_back(sections.cell_of(t)); }))
      origins.push_back(model.numbering.thin()[t].origin);
  model.shells.hinges = add_shells(
      model.deck, cells, [&](size_t i) { return model.source.where(origins[i]); }, model.refusals);
  note_integration(model);
}

void add_shell_faces(const Model& model, CellFaceId id, SurfaceBuilder& surface) {
  const auto thin = static_cast<size_t>(id.first - model.numbering.first_thin());
  ShellFace face = face_of(model, thin);
  drop_repeated_corner(face);
  for (ShellFace& part : linear_parts(face)) {
    const auto corners = static_cast<size_t>(traits(part.type).corners);
    if (id.second == kSneg) std::swap(part.nodes[1], part.nodes[corners - 1]);
    surface.add(part.type, part.nodes);
  }
}

}  // namespace clatter::mesh::deck::abaqus
