// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "mesh/deck/abaqus/reading.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr int32_t kNoRegion = -1;

const std::string& set_name(const Reading& reading, size_t use, const std::string& name) {
  const IdSets& sets = reading.model->uses()[use].scope->element_sets;
  const auto set = sets.find(folded(name));
  return set != sets.end() ? set->second.name : name;
}

// Regions of the cells by *SOLID SECTION, or by the sets of *ELEMENT.
class Sections {
 public:
  explicit Sections(Reading* reading)
      : reading_(*reading), region_(static_cast<size_t>(reading->model->cells()), kNoRegion) {}

  std::vector<int32_t> run() {
    bool any = false;
    for_each_card(reading_, {"SOLIDSECTION"}, [&](size_t use, const Card& card) {
      any = true;
      read_section(use, card);
    });
    // A refused deck still gets a mesh, so that its steps can be checked.
    if (!any || reading_.refusals->any()) by_element_sets(any);
    for_each_card(reading_, {"DLOAD"}, [&](size_t use, const Card& card) {
      for (size_t i = 0; i < card.size(); ++i) {
        const Fields fields = card.line(i, reading_.source);
        if (folded(fields.text(1)) == "CENTRIF") split(use, fields);
      }
    });
    for (int32_t cell = 0; cell < reading_.model->cells(); ++cell) add_formulation(cell);
    return std::move(region_);
  }

 private:
  int32_t new_region(size_t use, const std::string& name, Spot spot) {
    const std::string shown = reading_.model->public_name(use, set_name(reading_, use, name));
    if (!names_.insert(shown).second) {
      reading_.source.fail(spot, fmt::format("found a second region {}", shown));
    }
    reading_.deck->mesh.regions.push_back(shown);
    reading_.deck->regions.emplace_back();
    reading_.deck->regions.back().where = reading_.source.where(spot);
    return static_cast<int32_t>(reading_.deck->regions.size()) - 1;
  }

  void read_section(size_t use, const Card& card) {
    const Keyword& keyword = card.keyword();
    keyword.allow({"ELSET", "MATERIAL", "ORIENTATION", "CONTROLS"}, reading_.source,
                  reading_.ignore);
    const std::string& name = keyword.required("ELSET", reading_.source);
    const Material& material =
        material_named(keyword.required("MATERIAL", reading_.source), card.spot());
    const std::vector<int32_t>& elements = reading_.sets->elements(use, name, card.spot());
    const int32_t n_cells = reading_.model->cells();
    if (elements.empty() || elements.front() >= n_cells) return;  // only ignored elements
    if (reading_.refusals->has_lost(folded(material.name))) throw FollowUp();
    if (material.constants.empty()) {
      reading_.source.fail(card.spot(), fmt::format("material {} has no *ELASTIC", material.name));
    }
    const int32_t region = new_region(use, name, card.spot());
    reading_.deck->regions.back().material = material.name;
    if (const std::string* orientation = keyword.find("ORIENTATION")) {
      reading_.deck->regions.back().system = system_named(reading_, use, *orientation, card.spot());
    }
    for (const int32_t element : elements) {
      if (element >= n_cells) break;
      int32_t& at = region_[static_cast<size_t>(element)];
      if (at != kNoRegion) {
        reading_.source.fail(card.spot(),
                             fmt::format("element {} has a section already: {}", id_of(element),
                                         reading_.deck->regions[static_cast<size_t>(at)].where));
      }
      at = region;
    }
  }

  // Only entire regions rotate: the part that a load rotates becomes a region of its own.
  void split(size_t use, const Fields& fields) {
    std::vector<bool> turns(region_.size(), false);
    for (const int32_t element : reading_.sets->elements_at(fields, 0, use)) {
      if (element < reading_.model->cells()) turns[static_cast<size_t>(element)] = true;
    }
    std::vector<bool> stays(reading_.deck->regions.size(), false);
    for (size_t cell = 0; cell < region_.size(); ++cell) {
      if (!turns[cell] && region_[cell] != kNoRegion)
        stays[static_cast<size_t>(region_[cell])] = true;
    }
    std::map<int32_t, int32_t> part;  // of a region that does not rotate entirely
    for (size_t cell = 0; cell < region_.size(); ++cell) {
      const int32_t parent = region_[cell];
      if (!turns[cell] || parent == kNoRegion || !stays[static_cast<size_t>(parent)]) continue;
      const auto [at, is_new] = part.emplace(parent, 0);
      if (is_new) {
        const Region region = reading_.deck->regions[static_cast<size_t>(parent)];
        const std::string name = reading_.deck->mesh.regions[static_cast<size_t>(parent)];
        at->second = new_region(reading_.model->main_use(),
                                fmt::format("{}_{}", name, fields.text(0)), fields.spot());
        reading_.deck->regions.back() = region;
      }
      region_[cell] = at->second;
    }
  }

  const Material& material_named(const std::string& name, Spot spot) const {
    const auto known = reading_.material_names.find(folded(name));
    if (known != reading_.material_names.end()) return reading_.deck->materials.at(known->second);
    if (reading_.refusals->has_lost(folded(name))) throw FollowUp();
    reading_.source.fail(spot, fmt::format("there is no material '{}'", name));
  }

  // Without any section: each set of *ELEMENT, ELSET= is a region, the rest is "solid". With
  // `rest_only` all cells without a section are "solid".
  void by_element_sets(bool rest_only) {
    std::map<std::pair<size_t, Spot>, const IdSet*> sets;  // in the order of the deck
    for (size_t u = 0; u < reading_.model->uses().size(); ++u) {
      for (const auto& [key, set] : reading_.model->uses()[u].scope->element_sets) {
        for (const SetChunk& chunk : set.chunks) {
          if (chunk.row_begin == chunk.row_end) continue;
          sets.emplace(std::pair(u, chunk.spot), &set);
          break;
        }
      }
    }
    if (rest_only) sets.clear();
    for (const auto& [key, set] : sets) {
      const int32_t region = new_region(key.first, set->name, key.second);
      for (const SetChunk& chunk : set->chunks) fill(key.first, chunk, region);
    }
    if (std::find(region_.begin(), region_.end(), kNoRegion) == region_.end()) return;
    const int32_t rest = new_region(reading_.model->main_use(), "solid", 0);
    std::replace(region_.begin(), region_.end(), kNoRegion, rest);
  }

  void fill(size_t use, const SetChunk& chunk, int32_t region) {
    if (chunk.row_begin == chunk.row_end) return;
    const auto table = static_cast<size_t>(reading_.model->uses()[use].first_table + chunk.table);
    const int32_t first = reading_.model->tables()[table].first;
    std::fill(region_.begin() + first + chunk.row_begin, region_.begin() + first + chunk.row_end,
              region);
  }

  int32_t id_of(int32_t cell) const {
    const FlatTable& table = reading_.model->table_of(cell);
    return table.ids[static_cast<size_t>(cell - table.first)];
  }

  void add_formulation(int32_t cell) {
    const FlatTable& table = reading_.model->table_of(cell);
    const Spot spot = table.spots[static_cast<size_t>(cell - table.first)];
    const int32_t region = region_[static_cast<size_t>(cell)];
    if (region == kNoRegion) {
      reading_.source.fail(spot, fmt::format("element {} has no *SOLID SECTION", id_of(cell)));
    }
    if (table.formulation == Formulation::kDefault) return;
    const auto [at, is_new] =
        reading_.deck->regions[static_cast<size_t>(region)].formulation.emplace(table.type,
                                                                                table.formulation);
    if (at->second != table.formulation) {
      reading_.source.fail(spot,
                           fmt::format("element {} is a {}, but others of its section {} "
                                       "are integrated differently: give them sections of "
                                       "their own",
                                       id_of(cell), table.name,
                                       reading_.deck->mesh.regions[static_cast<size_t>(region)]));
    }
  }

  Reading& reading_;
  std::vector<int32_t> region_;
  std::set<std::string> names_;
};

// Numbers the nodes that cells use, in the order of the deck, and copies them.
std::vector<int32_t> take_nodes(const Model& model, Mesh* mesh) {
  std::vector<int32_t> node(static_cast<size_t>(model.nodes()), NodeMap::kNone);
  for (const FlatTable& table : model.tables()) {
    for (const int32_t row : table.nodes) node[static_cast<size_t>(row)] = 0;
  }
  int32_t count = 0;
  for (int32_t& n : node) {
    if (n == 0) n = count++;
  }
  mesh->nodes.resize(count, 3);
  mesh->node_ids.resize(static_cast<size_t>(count));
  for (size_t row = 0; row < node.size(); ++row) {
    if (node[row] == NodeMap::kNone) continue;
    mesh->nodes.row(node[row]) = model.at(static_cast<int32_t>(row));
    mesh->node_ids[static_cast<size_t>(node[row])] = model.node_ids()[row];
  }
  return node;
}

// Cells of one type and region form one block, in the order of the deck.
class Blocks {
 public:
  Blocks(const Model& model, const std::vector<int32_t>& region, const std::vector<int32_t>& node,
         Mesh* mesh)
      : model_(model), region_(region), node_(node), mesh_(*mesh) {}

  void run() {
    struct Size {
      Spot spot = 0;
      int64_t cells = 0;
    };
    std::map<Key, Size> sizes;
    for_each_cell([&](const FlatTable& table, size_t cell, const Key& key) {
      Size& size = sizes[key];
      if (size.cells++ == 0) size.spot = table.spots[cell];
    });
    std::map<std::pair<Spot, Key>, int64_t> in_order;
    for (const auto& [key, size] : sizes) in_order[{size.spot, key}] = size.cells;
    mesh_.cells.reserve(in_order.size());
    std::map<Key, CellBlock*> blocks;
    for (const auto& [at, cells] : in_order) {
      CellBlock& block = mesh_.cells.emplace_back();
      block.region = at.second.first;
      block.type = at.second.second;
      block.nodes.resize(cells, traits(block.type).nodes);
      block.ids.reserve(static_cast<size_t>(cells));
      blocks[at.second] = &block;
    }
    for_each_cell([&](const FlatTable& table, size_t cell, const Key& key) {
      add(table, cell, blocks[key]);
    });
  }

 private:
  using Key = std::pair<int32_t, CellType>;

  template <class Body>
  void for_each_cell(const Body& body) const {
    for (const FlatTable& table : model_.tables()) {
      for (size_t c = 0; c < table.ids.size(); ++c) {
        body(table, c, Key{region_[static_cast<size_t>(table.first) + c], table.type});
      }
    }
  }

  void add(const FlatTable& table, size_t cell, CellBlock* block) const {
    const std::span<const int> p = traits(table.type).to_abaqus;
    const auto row = static_cast<Eigen::Index>(block->ids.size());
    for (size_t i = 0; i < p.size(); ++i) {
      const int32_t from = table.nodes[cell * p.size() + i];
      block->nodes(row, p[i]) = node_[static_cast<size_t>(from)];
    }
    block->ids.push_back(table.ids[cell]);
  }

  const Model& model_;
  const std::vector<int32_t>& region_;
  const std::vector<int32_t>& node_;
  Mesh& mesh_;
};

}  // namespace

std::vector<int32_t> build_mesh(Reading* reading) {
  if (reading->model->cells() == 0) {
    reading->refusals->raise();
    throw InputError(
        fmt::format("{}: found no solid elements, expected some of C3D4 C3D5 C3D6 "
                    "C3D8 C3D8I C3D8R C3D10 C3D15 C3D20 C3D20R",
                    reading->source.where(reading->source.spot())));
  }
  const std::vector<int32_t> region = Sections(reading).run();
  std::vector<int32_t> node = take_nodes(*reading->model, &reading->deck->mesh);
  Blocks(*reading->model, region, node, &reading->deck->mesh).run();
  reading->region_of_cell = region;
  return node;
}

}  // namespace clatter::mesh::deck::abaqus
