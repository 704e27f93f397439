// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/reader.hpp"

#include <memory>

#include "mesh/deck/nastran/cards.hpp"
#include "mesh/deck/nastran/control.hpp"
#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck {
namespace {

using namespace nastran;

Deck read(Source& source, const std::string& name, const ReadOptions& options) {
  Ignored ignored(options.ignore);
  Refusals refusals;
  Control control = read_control(source, ignored, refusals);
  Bulk bulk = read_bulk(source, std::move(control), ignored, refusals);
  std::unique_ptr<Model> model_owner;
  refusals.require(
      [&] { model_owner = std::make_unique<Model>(source, std::move(bulk), refusals); });
  Model& model = *model_owner;
  model.deck.mesh.name = name;
  model.deck.notes = model.bulk.notes;
  refusals.require([&] { build_mesh(model); });
  build_couplings(model);
  build_springs(model);
  refusals.attempt([&] { build_supports(model); });
  build_sets(model);
  build_steps(model);
  refusals.raise();
  model.deck.ignored = ignored.counts();
  count_unused(model);
  model.deck.files = source.files();
  return std::move(model.deck);
}

}  // namespace

Deck read_nastran(const std::filesystem::path& path, const ReadOptions& options) {
  Source source(path);
  return read(source, path.stem().string(), options);
}

Deck read_nastran_text(const std::string& name, std::string_view text, const ReadOptions& options) {
  Source source(name, text);
  return read(source, name, options);
}

}  // namespace clatter::mesh::deck
