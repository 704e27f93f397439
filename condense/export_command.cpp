// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export_command.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "condense/export/export.hpp"
#include "core/base/error.hpp"
#include "core/base/planned_files.hpp"
#include "core/base/write_artefact.hpp"

namespace clatter::condense {
namespace {

struct ExportArguments {
  std::filesystem::path model;
  std::vector<std::filesystem::path> outputs;
  std::string units;
  int first_grid = 0, first_spoint = 0;
  ExportOptions options;
};

/// 0: not given.
void check_number(const char* option, int number) {
  if (number < 0)
    throw InputError(fmt::format("{}: found {}, expected a number from 1", option, number));
}

ExportOptions options_of(const ExportArguments& a) {
  ExportOptions options = a.options;
  if (!a.units.empty()) options.units = unit_system_named(a.units, "--units");
  check_number("--first-grid", a.first_grid);
  check_number("--first-spoint", a.first_spoint);
  check_number("--first-element", a.options.first_element);
  if (options.superelement < 1)
    throw InputError(
        fmt::format("--extid: found {}, expected a number from 1", options.superelement));
  options.numbering = {a.first_grid, a.first_spoint};
  return options;
}

void export_part(const ExportArguments& a, const CommonOptions& common) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& path : a.outputs)
    for (const std::filesystem::path& file : exported_files(path)) {
      if (file != path) will_write("output", file);
      files.push_back(file);
    }
  const ExportOptions options = options_of(a);
  const bool skin = std::any_of(a.outputs.begin(), a.outputs.end(), exports_skin);
  const rom::ReducedModel reduced = rom::read_reduced_model(a.model, skin);
  write_exports({a.outputs.front(), files, {a.model}}, common, [&] {
    for (const std::filesystem::path& path : a.outputs) export_reduced(reduced, path, options);
    return fmt::format("{}: {} coordinates", reduced.name, reduced.size());
  });
}

}  // namespace

void declare_export(CommandLine& program) {
  CommandLine& line = program.command("export", "Writes a reduced part for other programs.",
                                      "samples: clatter-condense export block.rom.h5 block.mtx\n"
                                      "         clatter-condense export block.rom.h5 block.inp "
                                      "block.pch block.fem\n"
                                      "         clatter-condense export block.rom.h5 block.pch "
                                      "--units mm-t-s --first-spoint 900001");
  const auto a = std::make_shared<ExportArguments>();
  line.positional("model", a->model, "reduced part (.rom.h5)");
  line.output("output", a->outputs,
              "files to write, any number; the extension selects the format: " + export_formats(),
              true);
  line.option("--units", a->units,
              "units of the files, as for decks (mm-t-s); default: those of the part's deck for "
              "CalculiX and Nastran, else SI");
  line.option("--first-grid", a->first_grid,
              "number of the first node that the part's deck does not have; default: a round one "
              "after those of the deck, else 1");
  line.option("--first-spoint", a->first_spoint,
              "number of the first scalar point (modal coordinates, other directions); default: "
              "counted with the nodes");
  line.option(
      "--first-element", a->options.first_element,
      "CalculiX: number of the first element; default: a round one after those of the deck, "
      "else counted after the nodes");
  line.flag("--deck-nodes", a->options.deck_nodes,
            "Nastran: writes the GRIDs that the part's deck has as well");
  line.option("--extid", a->options.superelement, "number of the superelement in part.asm (100)");
  line.flag("--binary", a->options.binary, "OUTPUT4: binary records instead of text");
  line.option("--interface", a->options.interface,
              "OpenFAST: set of the interface's x y z rx ry rz; default: the only such set");
  line.action([a](const CommonOptions& common) { export_part(*a, common); });
}

}  // namespace clatter::condense
