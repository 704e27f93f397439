// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of two dimensions or one beside the solids that are no shells: surfaces, beams and node
// sets.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "mesh/deck/abaqus/cells.hpp"
#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/node_sets.hpp"
#include "mesh/deck/skins.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

class ThinElements {
 public:
  explicit ThinElements(Model& model)
      : model_(model),
        numbering_(model.numbering),
        all_(model.numbering.thin()),
        section_(all_.size(), nullptr),
        skin_of_(all_.size(), kNone),
        skins_(model.deck, skin_cells()) {}

  void run() {
    find_sections();
    if (!refuse_structures()) return;
    for (size_t t = 0; t < all_.size(); ++t)
      if (is_beam(t)) model_.refusals.attempt([&] { add_beam(model_, all_[t], *section_[t]); });
    note_circles();
    name_groups();
    skins_.note(where_of_first());
    note_sections();
  }

 private:
  static constexpr size_t kNone = static_cast<size_t>(-1);

  std::vector<SkinCell> skin_cells() {
    std::vector<SkinCell> cells;
    for (size_t t = 0; t < all_.size(); ++t) {
      if (!all_[t].face || is_shell(t)) continue;
      skin_of_[t] = cells.size();
      SkinCell& cell = cells.emplace_back();
      cell.kind = all_[t].type;
      cell.type = *all_[t].face;
      for (size_t i = 0; i < static_cast<size_t>(all_[t].count); ++i) {
        cell.nodes[i] = model_.node_map.mesh_node(all_[t].nodes[i]);
      }
    }
    return cells;
  }

  // Elements with a section have stiffness or mass.
  void find_sections() {
    for_each_card(model_,
                  {"SOLIDSECTION", "SHELLSECTION", "SHELLGENERALSECTION", "MEMBRANESECTION",
                   "SURFACESECTION", "BEAMSECTION", "BEAMGENERALSECTION"},
                  [&](size_t use, const Card& card) {
                    const Keyword& keyword = card.keyword();
                    for (const int32_t element : model_.sets.elements(
                             use, keyword.required("ELSET", model_.source), card.origin())) {
                      const int32_t thin = element - numbering_.first_thin();
                      if (thin >= 0) section_[thin] = &card;
                    }
                  });
  }

  bool on_solids(const ThinElement& one) const {
    for (int32_t i = 0; i < one.count; ++i) {
      if (model_.node_map.mesh_node(one.nodes[i]) == NodeMap::kNone) {
        return false;
      }
    }
    return true;
  }

  bool is_shell(size_t t) const {
    return model_.is_shell(numbering_.first_thin() + static_cast<int32_t>(t));
  }

  bool is_beam(size_t t) const {
    if (all_[t].face || section_[t] == nullptr) return false;
    const std::string keyword = folded(section_[t]->keyword().name);
    if (all_[t].type.starts_with("T")) return keyword == "*SOLIDSECTION";
    return keyword == "*BEAMSECTION" || keyword == "*BEAMGENERALSECTION";
  }

  // A face without stiffness is only a name; one with a section is refused where no solid has it.
  bool is_structure(size_t t) const {
    if (is_shell(t)) return false;
    if (all_[t].face) return section_[t] != nullptr && !skins_.is_surface(skin_of_[t]);
    if (is_beam(t)) return false;
    return section_[t] != nullptr || !on_solids(all_[t]);
  }

  bool refuse_structures() {
    std::map<std::string, std::pair<int64_t, size_t>> found;  // type -> how many, the first
    for (size_t t = 0; t < all_.size(); ++t) {
      if (is_structure(t)) ++found.try_emplace(all_[t].type, 0, t).first->second.first;
    }
    for (const auto& [type, count] : found) {
      const ThinElement& first = all_[count.second];
      model_.refusals.add(fmt::format(
          "{}: {} elements {} {}; ignore = [\"{}\"] leaves out their stiffness and mass: "
          "[[spring]], [[coupling]] and [[point_mass]] of the recipe replace them",
          model_.source.where(first.origin), count.first, type, reason(first), type));
    }
    return found.empty();
  }

  bool has_shell_section(const ThinElement& one) const {
    return section_[static_cast<size_t>(&one - all_.data())]->keyword().key == "SHELLSECTION";
  }

  std::string reason(const ThinElement& one) const {
    if (!one.face)
      return "are beams or trusses without a *BEAM SECTION, *BEAM GENERAL SECTION, or of trusses "
             "*SOLID SECTION";
    if (is_shell_type(one.type) && has_shell_section(one))
      return "are shells whose nodes all belong to solids, which do not turn";
    return fmt::format(
        "are shells or membranes beside the solids, which are not read, expected {} with a "
        "*SHELL SECTION",
        fmt::join(shell_types(), " "));
  }

  // Each set that has such elements is a surface of their faces, or a node set of the lines' nodes.
  void name_groups() {
    std::vector<bool> named(all_.size(), false);
    for (size_t use = 0; use < numbering_.uses().size(); ++use) {
      for (const auto& [key, set] : numbering_.uses()[use].scope->element_sets) {
        const Origin origin = set.chunks.front().origin;
        std::vector<size_t> members;
        for (const int32_t element : model_.sets.elements(use, set.name, origin)) {
          const int32_t thin = element - numbering_.first_thin();
          if (thin >= 0) members.push_back(static_cast<size_t>(thin));
        }
        for (const size_t t : members) named[t] = true;
        if (!members.empty()) add_group(numbering_.public_name(use, set.name), members);
      }
    }
    std::map<std::string, std::vector<size_t>> rest;
    for (size_t t = 0; t < all_.size(); ++t) {
      if (!named[t]) rest[all_[t].type].push_back(t);
    }
    for (const auto& [type, members] : rest) add_group(type, members);
  }

  void add_group(const std::string& name, const std::vector<size_t>& members) {
    std::vector<size_t> faces;
    std::vector<NodeIndex> nodes;
    for (const size_t t : members) {
      if (all_[t].face && !is_shell(t)) faces.push_back(skin_of_[t]);
      for (int32_t i = 0; !all_[t].face && i < all_[t].count; ++i) {
        nodes.push_back(model_.node_map.require(all_[t].nodes[i]));
      }
    }
    skins_.add_surface(name, faces);
    const IdSets& sets = numbering_.uses()[numbering_.main_use()].scope->node_sets;
    if (nodes.empty() || has_node_set(model_.deck, name) || sets.contains(folded(name))) return;
    sort_unique(nodes);
    add_node_set(model_.deck, name, std::move(nodes));
  }

  std::string where_of_first() const {
    for (size_t t = 0; t < all_.size(); ++t) {
      if (all_[t].face && !is_shell(t)) return model_.source.where(all_[t].origin);
    }
    return "";
  }

  // What the solids have is the deck's; what a section of their skin adds is left out.
  // The one number of a CIRC is the radius in Abaqus, the diameter in CalculiX.
  void note_circles() {
    std::map<Origin, std::string> found;
    for (size_t t = 0; t < all_.size(); ++t) {
      if (!is_beam(t) || folded(section_[t]->keyword().choice("SECTION", "")) != "CIRC") continue;
      const Card& card = *section_[t];
      if (card.size() == 0 || !card.line(0, model_.source).blank(1)) continue;
      found[card.origin()] = std::string(card.line(0, model_.source).text(0));
    }
    for (const auto& [origin, number] : found)
      model_.deck.notes.push_back(
          fmt::format("{}: CIRC: {} is the {}", model_.source.where(origin), number,
                      model_.is_calculix
                          ? "diameter, since the deck has OUTPUT=2D or 3D as CalculiX reads them"
                          : "radius, as Abaqus has it; the diameter of CalculiX is written twice"));
  }

  void note_sections() {
    std::map<const Card*, double> areas;
    for (size_t t = 0; t < all_.size(); ++t) {
      if (section_[t] != nullptr && all_[t].face && !is_shell(t))
        areas[section_[t]] += skins_.area(skin_of_[t]);
    }
    for (const auto& [card, area] : areas) {
      const double thickness =
          card->size() > 0 ? to_number(card->line(0, model_.source).text(0)).value_or(0.0) : 0.0;
      const auto material = model_.material_names.find(card->keyword().choice("MATERIAL", ""));
      const double density = material == model_.material_names.end()
                                 ? 0.0
                                 : model_.deck.materials.at(material->second).density;
      model_.deck.notes.push_back(
          fmt::format("{}: {}", model_.source.where(card->origin()),
                      skin_loss(card->keyword().name, thickness, area * thickness * density)));
    }
  }

  Model& model_;
  const Numbering& numbering_;
  const std::vector<ThinElement>& all_;
  std::vector<const Card*> section_;  // of each, null without
  std::vector<size_t> skin_of_;       // its number in skins_
  Skins skins_;
};

}  // namespace

void build_thin(Model& model) {
  if (!model.numbering.thin().empty()) ThinElements(model).run();
}

}  // namespace clatter::mesh::deck::abaqus
