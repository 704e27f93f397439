// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "mesh/deck/abaqus/parser.hpp"
#include "mesh/deck/abaqus/reading.hpp"

namespace clatter::mesh::deck {
namespace abaqus {

// Sets of the deck and surfaces of nodes. A set that contains points is in Deck::sets with all its
// node indices; its mesh nodes, if any, are in Mesh::node_sets as well.
void read_node_sets(Reading* reading) {
  const Model& model = *reading->model;
  const auto add = [&](const std::string& name, const std::vector<int32_t>& rows, Spot spot) {
    if (reading->deck->mesh.node_sets.contains(name) || reading->deck->sets.contains(name)) {
      reading->source.fail(spot, fmt::format("found a second node set {}", name));
    }
    std::vector<NodeIndex> nodes, all;
    for (const int32_t row : rows) {
      const int32_t node = reading->node_map->mesh_node(row);
      const NodeIndex node_index = reading->node_map->find(row);
      if (node != NodeMap::kNone) nodes.push_back(node);
      if (node != NodeMap::kNone || node_index != NodeMap::kNone) {
        all.push_back(node != NodeMap::kNone ? node : node_index);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    if (all.size() > nodes.size()) reading->deck->sets[name] = all;
    if (!nodes.empty() || rows.empty()) reading->deck->mesh.node_sets[name] = std::move(nodes);
  };
  // Sets may contain others: an error in one affects those around it, so only the first is
  // reported.
  reading->refusals->attempt([&] {
    for (size_t use = 0; use < model.uses().size(); ++use) {
      for (const auto& [key, set] : model.uses()[use].scope->node_sets) {
        const Spot spot = set.chunks.front().spot;
        add(model.public_name(use, set.name), reading->sets->nodes(use, set.name, spot), spot);
      }
    }
  });
  for_each_card(*reading, {"SURFACE"}, [&](size_t use, const Card& card) {
    if (!card.keyword().has("NAME")) throw FollowUp();  // refused by read_surfaces()
    const std::string& name = *card.keyword().find("NAME");
    const std::string shown = model.public_name(use, name);
    const auto* rows = node_surface(*reading, use, name);
    const bool is_new = !reading->deck->mesh.node_sets.contains(shown);
    if (rows != nullptr && is_new) add(shown, *rows, card.spot());
  });
}

namespace {

Deck read(Source* source, const std::string& name, const ReadOptions& options) {
  Ignore ignore(options);
  Refusals refusals;
  RawDeck raw = parse(source, &ignore, &refusals);
  Deck deck;
  deck.notes = std::move(raw.notes);
  std::unique_ptr<const Model> model_owner;
  refusals.require([&] { model_owner = std::make_unique<const Model>(std::move(raw), *source); });
  const Model& model = *model_owner;
  Sets sets(&model);
  deck.mesh.name = name;
  Reading reading{.source = *source,
                  .ignore = &ignore,
                  .refusals = &refusals,
                  .model = &model,
                  .sets = &sets,
                  .deck = &deck,
                  .node_map = nullptr,
                  .initial = {},
                  .surface_names = {},
                  .node_surfaces = {},
                  .dependents = {},
                  .material_names = {},
                  .system_names = {},
                  .amplitudes = {},
                  .region_of_cell = {}};
  read_materials(&reading);
  read_orientations(&reading);
  std::vector<int32_t> mesh_node;
  refusals.require([&] { mesh_node = build_mesh(&reading); });
  NodeMap node_map(&model, &deck, std::move(mesh_node));
  reading.node_map = &node_map;
  read_surfaces(&reading);
  read_transforms(&reading);
  read_initial_conditions(&reading);
  read_rigid(&reading);
  read_distributing(&reading);
  read_ties(&reading);
  read_masses(&reading);
  read_springs(&reading);
  read_equations(&reading);
  finish_rigid(&reading);
  read_steps(&reading);
  read_node_sets(&reading);
  read_cyclic(&reading);
  refusals.raise();
  deck.files = source->files();
  deck.ignored = ignore.counted();
  std::erase_if(deck.ignored, [](const auto& entry) { return entry.second == 0; });
  return deck;
}

}  // namespace
}  // namespace abaqus

Deck read_abaqus(const std::filesystem::path& path, const ReadOptions& options) {
  abaqus::Source source(path);
  return abaqus::read(&source, path.stem().string(), options);
}

Deck read_abaqus_text(std::string_view text, const std::string& name, const ReadOptions& options) {
  abaqus::Source source(text, name);
  return abaqus::read(&source, std::filesystem::path(name).stem().string(), options);
}

}  // namespace clatter::mesh::deck
