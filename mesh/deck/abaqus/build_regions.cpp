// SPDX-License-Identifier: GPL-3.0-or-later
// Sections and materials of the cells.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr int32_t kNoRegion = -1;

const std::string& set_name(const Model& model, size_t use, const std::string& name) {
  const IdSets& sets = model.numbering.uses()[use].scope->element_sets;
  const auto set = sets.find(folded(name));
  return set != sets.end() ? set->second.name : name;
}

// Regions of the cells by *SOLID SECTION, or by the sets of *ELEMENT.
class Sections {
 public:
  explicit Sections(Model& model)
      : model_(model), region_(static_cast<size_t>(model.numbering.cells()), kNoRegion) {}

  std::vector<int32_t> run() {
    bool any = false;
    for_each_card(model_, {"SOLIDSECTION"}, [&](size_t use, const Card& card) {
      any = true;
      read_section(use, card);
    });
    // A refused deck still gets a mesh, so that its steps can be checked.
    if (!any || model_.refusals.any()) by_element_sets(any);
    for_each_card(model_, {"DLOAD"}, [&](size_t use, const Card& card) {
      for (size_t i = 0; i < card.size(); ++i) {
        const Fields fields = card.line(i, model_.source);
        if (folded(fields.text(1)) == "CENTRIF")
          split(model_.sets.elements_or_all(fields, 0, use), fields.text(0), fields.origin());
      }
    });
    for_each_card(model_, {"NONSTRUCTURALMASS"}, [&](size_t use, const Card& card) {
      const std::string& set = card.keyword().required("ELSET", model_.source);
      split(model_.sets.elements(use, set, card.origin()), set_name(model_, use, set),
            card.origin());
    });
    for (int32_t cell = 0; cell < model_.numbering.cells(); ++cell) add_formulation(cell);
    return std::move(region_);
  }

 private:
  int32_t new_region(size_t use, const std::string& name, Origin origin) {
    const std::string shown = model_.numbering.public_name(use, set_name(model_, use, name));
    if (!names_.insert(shown).second) {
      model_.source.fail(origin, fmt::format("found a second region {}", shown));
    }
    model_.deck.mesh.regions.push_back(shown);
    model_.deck.regions.emplace_back();
    model_.deck.regions.back().where = model_.source.where(origin);
    return static_cast<int32_t>(model_.deck.regions.size()) - 1;
  }

  void read_section(size_t use, const Card& card) {
    const Keyword& keyword = card.keyword();
    keyword.allow({"ELSET", "MATERIAL", "ORIENTATION", "CONTROLS"}, model_.source, model_.ignore);
    const std::string& name = keyword.required("ELSET", model_.source);
    const Material& material =
        material_named(keyword.required("MATERIAL", model_.source), card.origin());
    const std::vector<int32_t>& elements = model_.sets.elements(use, name, card.origin());
    const int32_t n_cells = model_.numbering.cells();
    if (elements.empty() || elements.front() >= n_cells) return;  // only ignored elements
    if (model_.refusals.has_lost(folded(material.name))) throw FollowUp();
    if (material.constants.empty()) {
      model_.source.fail(card.origin(), fmt::format("material {} has no *ELASTIC", material.name));
    }
    if (material.of_sheets)
      model_.source.fail(card.origin(), fmt::format("material {} is a LAMINA, of shells, expected "
                                                    "ENGINEERING CONSTANTS of a solid",
                                                    material.name));
    const int32_t region = new_region(use, name, card.origin());
    model_.deck.regions.back().material = material.name;
    if (const std::string* orientation = keyword.find("ORIENTATION")) {
      model_.deck.regions.back().system = system_named(model_, use, *orientation, card.origin());
    }
    for (const int32_t element : elements) {
      if (element >= n_cells) break;
      int32_t& at = region_[element];
      if (at != kNoRegion) {
        model_.source.fail(card.origin(),
                           fmt::format("element {} has a section already: {}", id_of(element),
                                       model_.deck.regions[at].where));
      }
      at = region;
    }
  }

  // Only entire regions rotate and have a density: the part of one that is among `elements`
  // becomes a region of its own.
  void split(const std::vector<int32_t>& elements, std::string_view set, Origin origin) {
    std::vector<bool> turns(region_.size(), false);
    for (const int32_t element : elements) {
      if (element < model_.numbering.cells()) turns[element] = true;
    }
    std::vector<bool> stays(model_.deck.regions.size(), false);
    for (size_t cell = 0; cell < region_.size(); ++cell) {
      if (!turns[cell] && region_[cell] != kNoRegion) stays[region_[cell]] = true;
    }
    std::map<int32_t, int32_t> part;  // of a region that is divided
    for (size_t cell = 0; cell < region_.size(); ++cell) {
      const int32_t parent = region_[cell];
      if (!turns[cell] || parent == kNoRegion || !stays[parent]) continue;
      const auto [at, is_new] = part.emplace(parent, 0);
      if (is_new) {
        const Region region = model_.deck.regions[parent];
        const std::string name = model_.deck.mesh.regions[parent];
        at->second =
            new_region(model_.numbering.main_use(), fmt::format("{}_{}", name, set), origin);
        model_.deck.regions.back() = region;
      }
      region_[cell] = at->second;
    }
  }

  const Material& material_named(const std::string& name, Origin origin) const {
    const auto known = model_.material_names.find(folded(name));
    if (known != model_.material_names.end()) return model_.deck.materials.at(known->second);
    if (model_.refusals.has_lost(folded(name))) throw FollowUp();
    model_.source.fail(origin, fmt::format("found no material {}", shown(name)));
  }

  // Without any section: each set of *ELEMENT, ELSET= is a region, the rest is "solid". With
  // `rest_only` all cells without a section are "solid".
  void by_element_sets(bool rest_only) {
    std::map<std::pair<size_t, Origin>, const IdSet*> sets;  // in the order of the deck
    for (size_t u = 0; u < model_.numbering.uses().size(); ++u) {
      for (const auto& [key, set] : model_.numbering.uses()[u].scope->element_sets) {
        for (const SetChunk& chunk : set.chunks) {
          if (chunk.row_begin == chunk.row_end) continue;
          sets.emplace(std::pair(u, chunk.origin), &set);
          break;
        }
      }
    }
    if (rest_only) sets.clear();
    std::vector<int32_t> block(region_.size(), kNoRegion);  // which set of *ELEMENT
    int32_t blocks = 0;
    for (const auto& [key, set] : sets) {
      for (const SetChunk& chunk : set->chunks) fill(key.first, chunk, blocks, block);
      ++blocks;
    }
    std::vector<int32_t> region_of(static_cast<size_t>(blocks), kNoRegion);
    if (!rest_only) name_unions(block, region_of);
    size_t number = 0;
    for (const auto& [key, set] : sets) {
      int32_t& region = region_of[number++];
      if (region == kNoRegion) region = new_region(key.first, set->name, key.second);
    }
    for (size_t cell = 0; cell < block.size(); ++cell) {
      if (block[cell] != kNoRegion) region_[cell] = region_of[block[cell]];
    }
    if (std::find(region_.begin(), region_.end(), kNoRegion) == region_.end()) return;
    const int32_t rest = new_region(model_.numbering.main_use(), "solid", 0);
    std::replace(region_.begin(), region_.end(), kNoRegion, rest);
  }

  // Gmsh writes each volume as a set of *ELEMENT and then groups of volumes as *ELSET: a set of
  // complete blocks is a region with its name, the smaller one where two of them share a block.
  void name_unions(const std::vector<int32_t>& block, std::vector<int32_t>& region_of) {
    struct Union {
      size_t use;
      const IdSet* set;
      std::vector<int32_t> blocks;
    };
    std::vector<int64_t> size(region_of.size(), 0);
    for (const int32_t b : block) {
      if (b != kNoRegion) ++size[b];
    }
    std::vector<Union> unions;
    for (size_t u = 0; u < model_.numbering.uses().size(); ++u) {
      for (const auto& [key, set] : model_.numbering.uses()[u].scope->element_sets) {
        const auto reads_rows = [](const SetChunk& chunk) {
          return chunk.row_begin != chunk.row_end;
        };
        if (std::any_of(set.chunks.begin(), set.chunks.end(), reads_rows)) continue;
        std::map<int32_t, int64_t> found;
        for (const int32_t element : model_.sets.elements(u, set.name, set.chunks.front().origin)) {
          if (element < model_.numbering.cells()) ++found[block[element]];
        }
        Union one{u, &set, {}};
        bool complete = !found.empty();
        for (const auto& [b, count] : found) {
          complete = complete && b != kNoRegion && count == size[b];
          one.blocks.push_back(b);
        }
        if (complete) unions.push_back(std::move(one));
      }
    }
    std::stable_sort(unions.begin(), unions.end(), [](const Union& a, const Union& b) {
      return std::pair(a.blocks.size(), a.set->chunks.front().origin) <
             std::pair(b.blocks.size(), b.set->chunks.front().origin);
    });
    for (const Union& one : unions) {
      const auto taken = [&](int32_t b) { return region_of[b] != kNoRegion; };
      if (std::any_of(one.blocks.begin(), one.blocks.end(), taken)) continue;
      const int32_t region = new_region(one.use, one.set->name, one.set->chunks.front().origin);
      for (const int32_t b : one.blocks) region_of[b] = region;
    }
  }

  void fill(size_t use, const SetChunk& chunk, int32_t value, std::vector<int32_t>& of_cells) {
    if (chunk.row_begin == chunk.row_end) return;
    const auto table = static_cast<size_t>(model_.numbering.uses()[use].first_table + chunk.table);
    const int32_t first = model_.numbering.tables()[table].first;
    std::fill(of_cells.begin() + first + chunk.row_begin, of_cells.begin() + first + chunk.row_end,
              value);
  }

  int32_t id_of(int32_t cell) const {
    const FlatTable& table = model_.numbering.table_of(cell);
    return table.ids[cell - table.first];
  }

  void add_formulation(int32_t cell) {
    const FlatTable& table = model_.numbering.table_of(cell);
    const Origin origin = table.origins[cell - table.first];
    const int32_t region = region_[cell];
    if (region == kNoRegion) {
      model_.source.fail(origin, fmt::format("element {} has no *SOLID SECTION", id_of(cell)));
    }
    if (table.formulation == Formulation::kDefault) return;
    const auto [at, is_new] =
        model_.deck.regions[region].formulation.emplace(table.type, table.formulation);
    if (at->second != table.formulation) {
      model_.source.fail(origin,
                         fmt::format("element {} is a {}, but others of its section {} "
                                     "are integrated differently: give them sections of "
                                     "their own",
                                     id_of(cell), table.name, model_.deck.mesh.regions[region]));
    }
  }

  Model& model_;
  std::vector<int32_t> region_;
  std::set<std::string> names_;
};

}  // namespace

void build_regions(Model& model) { model.region_of_cell = Sections(model).run(); }

}  // namespace clatter::mesh::deck::abaqus
