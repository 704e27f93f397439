// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/reader.hpp"

#include <memory>

#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/abaqus/parser.hpp"

namespace clatter::mesh::deck {
namespace abaqus {
namespace {

Deck read(Source& source, const std::string& name, const ReadOptions& options) {
  Ignore ignore(options, folded_keyword);
  Refusals refusals(options.contents);
  RawDeck raw = parse(source, ignore, refusals);
  std::vector<std::string> notes = std::move(raw.notes);
  std::vector<Damping> damping = std::move(raw.damping);
  const bool marked_shells = raw.marked_shells, is_calculix = raw.is_calculix;
  std::unique_ptr<Model> model_owner;
  refusals.require(
      [&] { model_owner = std::make_unique<Model>(source, std::move(raw), ignore, refusals); });
  Model& model = *model_owner;
  model.deck.mesh.name = name;
  model.deck.notes = std::move(notes);
  model.deck.damping = std::move(damping);
  model.shells.are_marked = marked_shells;
  model.is_calculix = is_calculix;
  build_materials(model);
  build_systems(model);
  refusals.require([&] { build_mesh(model); });
  build_nonstructural_mass(model);
  refusals.attempt([&] { build_thin(model); });
  build_surfaces(model);
  build_bolts(model);
  build_transforms(model);
  build_initial_temperature(model);
  build_couplings(model);
  build_distributing(model);
  build_ties(model);
  build_contacts(model);
  build_masses(model);
  build_springs(model);
  build_connectors(model);
  build_equations(model);
  finish_couplings(model);
  build_steps(model);
  finish_bolts(model);
  build_sets(model);
  build_cyclic(model);
  refuse_hinges(model.deck, model.shells.hinges, refusals);
  refusals.raise();
  model.deck.ignored = ignore.counted();
  model.deck.passed = refusals.contents().passed_line();
  model.deck.files = source.files();
  return std::move(model.deck);
}

}  // namespace
}  // namespace abaqus

Deck read_abaqus(const std::filesystem::path& path, const ReadOptions& options) {
  abaqus::Source source(path);
  return abaqus::read(source, path.stem().string(), options);
}

Deck read_abaqus_text(const std::string& name, std::string_view text, const ReadOptions& options) {
  abaqus::Source source(name, text);
  return abaqus::read(source, std::filesystem::path(name).stem().string(), options);
}

}  // namespace clatter::mesh::deck
