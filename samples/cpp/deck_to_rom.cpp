// SPDX-License-Identifier: GPL-3.0-or-later
// From a deck of Nastran, Abaqus or CalculiX to a reduced model, in one process.
//   deck_to_rom part.inp mm-t-s part.rom.h5 fmax_hz node_set ...
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "assembly/model/build.hpp"
#include "condense/condense.hpp"
#include "core/base/write_artefact.hpp"
#include "mesh/make_mesh.hpp"

int main(int argc, char** argv) {
  if (argc < 6) {
    std::fputs("usage: deck_to_rom part.inp units part.rom.h5 fmax_hz node_set ...\n", stderr);
    return 2;
  }
  try {
    using namespace clatter;
    StepClock clock;
    mesh::MeshRequest request;
    request.input = argv[1];
    request.units = argv[2];
    mesh::NewMesh deck = mesh::make_mesh(request, clock);
    // Materials, supports, couplings and loads of the deck, as a fe.toml has them; its node sets
    // become coordinates where they are named.
    recipe::File& file = deck.recipe.value().file;
    for (int i = 5; i < argc; ++i) {
      recipe::Nodes& kept = file.nodes.emplace_back();
      kept.name = kept.members.selection.node_set = argv[i];
    }
    const assembly::Recipe recipe = assembly::read_recipe(file, deck.mesh);
    const fe::FeModel model = assembly::build_fe_model(deck.mesh, recipe, clock).model;

    condense::CondenseOptions options;
    options.modes.fmax_hz = std::atof(argv[4]);
    options.boundary.assign(argv + 5, argv + argc);
    const rom::ReducedModel reduced = condense::condense(model, options, clock);
    for (const std::string& line : condense::describe(reduced)) std::puts(line.c_str());
    write_artefact(argv[3], {rom::kRomSchema, "", {argv[1]}}, clock, {},
                   [&](H5File& file) { rom::write_reduced_model(file, reduced); });
  } catch (const std::exception& error) {
    std::fprintf(stderr, "deck_to_rom: %s\n", error.what());
    return 2;
  }
}
