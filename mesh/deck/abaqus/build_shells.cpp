// SPDX-License-Identifier: GPL-3.0-or-later
// Elements S3 to S8R with their sections.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/base/error.hpp"
#include "mesh/deck/abaqus/cells.hpp"
#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/abaqus/shell_sections.hpp"
#include "mesh/deck/open_faces.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

bool is_shell(const Model& model, size_t thin) {
  return model.shells.section(static_cast<int32_t>(thin)) >= 0;
}

class ShellFinder {
 public:
  explicit ShellFinder(Model& model)
      : model_(model), on_solid_(static_cast<size_t>(model.numbering.nodes()), false) {
    for (const FlatTable& table : model.numbering.tables())
      for (const int32_t row : table.nodes) on_solid_[static_cast<size_t>(row)] = true;
    find_open_faces();
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
  bool is_on_solids(const ThinElement& one) const {
    const auto corners = one.nodes.begin() + traits(*one.face).corners;
    return std::all_of(one.nodes.begin(), corners, [&](int32_t row) { return on_solid_[row]; });
  }

  // Of its corners, from 1.
  static std::vector<int32_t> numbers_of(const ThinElement& one) {
    std::vector<int32_t> numbers(one.nodes.begin(), one.nodes.begin() + traits(*one.face).corners);
    for (int32_t& number : numbers) ++number;
    return numbers;
  }

  // Between corners of solids, but no face.
  void find_open_faces() {
    for (const ThinElement& one : model_.numbering.thin())
      if (is_shell_type(one.type) && is_on_solids(one)) open_.add(numbers_of(one));
    if (open_.empty()) return;
    std::vector<int32_t> nodes;
    for (const FlatTable& table : model_.numbering.tables()) {
      const auto each = static_cast<size_t>(traits(table.type).nodes);
      for (size_t first = 0; first < table.nodes.size(); first += each) {
        nodes.assign(table.nodes.begin() + static_cast<std::ptrdiff_t>(first),
                     table.nodes.begin() + static_cast<std::ptrdiff_t>(first + each));
        for (int32_t& number : nodes) ++number;
        open_.close(table.type, nodes);
      }
    }
  }

  // Of an element that may be a shell; null for others, as skins of solids.
  int32_t* section_of(int32_t element) const {
    const ThinElement* one = model_.numbering.thin(element);
    if (one == nullptr || !is_shell_type(one->type)) return nullptr;
    if (is_on_solids(*one) && !open_.is_open(numbers_of(*one))) return nullptr;
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
  OpenFaces open_;
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

void let_shells_turn(Model& model) {
  std::vector<bool> turns(static_cast<size_t>(model.deck.mesh.nodes.rows()), false);
  for (size_t t = 0; t < model.shells.section_of.size(); ++t) {
    if (!is_shell(model, t)) continue;
    ShellFace face = face_of_shell(model, t);
    drop_repeated_corner(face);
    for (size_t i = 0; i < static_cast<size_t>(traits(face.type).nodes); ++i)
      turns[static_cast<size_t>(face.nodes[i])] = true;
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
  ShellFace face = face_of_shell(model, thin);
  drop_repeated_corner(face);
  if (id.second == kSneg) turn_over(face.type, face.nodes);
  surface.add(face.type, face.nodes);
}

}  // namespace clatter::mesh::deck::abaqus
