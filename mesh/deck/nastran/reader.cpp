// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/reader.hpp"

#include <memory>

#include "mesh/deck/nastran/model.hpp"
#include "mesh/deck/nastran/parser.hpp"

namespace clatter::mesh::deck {
namespace nastran {
namespace {

Deck read(Source& source, const std::string& name, const ReadOptions& options) {
  Ignore ignore(options, capitals);
  Refusals refusals(options.contents);
  RawDeck raw = parse(source, ignore, refusals);
  std::vector<std::string> notes = std::move(raw.notes);
  std::unique_ptr<Model> model_owner;
  refusals.require(
      [&] { model_owner = std::make_unique<Model>(source, std::move(raw), refusals); });
  Model& model = *model_owner;
  model.deck.mesh.name = name;
  model.deck.notes = std::move(notes);
  refusals.require([&] { leave_out_fluids(model, ignore); });
  refusals.require([&] { build_mesh(model, ignore); });
  refusals.attempt([&] { build_shells(model); });
  refusals.attempt([&] { build_skins(model, ignore); });
  build_couplings(model);
  build_links(model);
  build_masses(model);
  build_equations(model);
  build_springs(model);
  build_bushes(model);
  build_fasteners(model);
  build_bars(model);
  build_matrices(model);
  refusals.attempt([&] { build_supports(model); });
  build_sets(model);
  build_surfaces(model);
  build_glue(model);
  build_initial_temperature(model);
  build_steps(model);
  drop_loose(model, ignore);
  refuse_hinges(model.deck, model.hinges, refusals);
  refusals.raise();
  model.deck.ignored = ignore.counted();
  count_unused(model);
  note_solution(model);
  choose_mass(model);
  pass_damping(model);
  take_damping(model);
  model.deck.passed = refusals.contents().passed_line();
  model.deck.files = source.files();
  return std::move(model.deck);
}

}  // namespace
}  // namespace nastran

Deck read_nastran(const std::filesystem::path& path, const ReadOptions& options) {
  nastran::Source source(path);
  return nastran::read(source, path.stem().string(), options);
}

Deck read_nastran_text(const std::string& name, std::string_view text, const ReadOptions& options) {
  nastran::Source source(name, text);
  return nastran::read(source, name, options);
}

}  // namespace clatter::mesh::deck
