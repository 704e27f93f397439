// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export_command.hpp"

#include <fmt/format.h>

#include "condense/export/export.hpp"
#include "core/base/planned_files.hpp"
#include "core/base/write_artefact.hpp"

namespace clatter::condense {
namespace {

struct ExportArguments {
  std::filesystem::path model;
  std::vector<std::filesystem::path> outputs;
};

void export_part(const ExportArguments& a, const CommonOptions& common) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& path : a.outputs)
    for (const std::filesystem::path& file : exported_files(path)) {
      if (file != path) will_write("output", file);
      files.push_back(file);
    }
  const rom::ReducedModel reduced = rom::read_reduced_model(a.model, false);
  write_exports({a.outputs.front(), files, {a.model}}, common, [&] {
    for (const std::filesystem::path& path : a.outputs) export_reduced(reduced, path);
    return fmt::format("{}: {} coordinates", reduced.name, reduced.size());
  });
}

}  // namespace

void declare_export(CommandLine& program) {
  CommandLine& line = program.command("export", "Writes a reduced part for other programs.",
                                      "samples: clatter-condense export block.rom.h5 block.mtx\n"
                                      "         clatter-condense export block.rom.h5 block.inp "
                                      "block.pch block.fem");
  const auto a = std::make_shared<ExportArguments>();
  line.positional("model", a->model, "reduced part (.rom.h5)");
  line.output("output", a->outputs,
              "files to write, any number: part.mtx (Matrix Market), part.inp (CalculiX), part.pch "
              "(Nastran DMIG), part.fem (MBDyn)",
              true);
  line.action([a](const CommonOptions& common) { export_part(*a, common); });
}

}  // namespace clatter::condense
