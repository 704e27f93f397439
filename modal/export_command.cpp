// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/export_command.hpp"

#include "core/base/write_artefact.hpp"
#include "modal/result_export.hpp"

namespace clatter::modal {
namespace {

struct ExportArguments {
  std::filesystem::path results, cells;
  std::vector<std::filesystem::path> outputs;
};

void export_to_paraview(const ExportArguments& a, const CommonOptions& common) {
  check_result_exports(a.outputs);
  std::vector<std::filesystem::path> inputs{a.results};
  if (!a.cells.empty()) inputs.push_back(a.cells);
  write_exports({a.outputs.front(), a.outputs, inputs}, common, [&] {
    export_results(a.results, a.cells, a.outputs);
    return a.results.string();
  });
}

}  // namespace

void declare_export(CommandLine& program) {
  CommandLine& line = program.command(
      "export", "Writes shapes or static fields of existing results for ParaView.",
      "samples: clatter-modal export block.modes.h5 shapes.vtu\n"
      "         clatter-modal export block.modes.h5 shapes.pvd --cells block.fe.h5");
  const auto a = std::make_shared<ExportArguments>();
  line.positional("results", a->results, "modes (.modes.h5) or static results (.static.h5)");
  line.output("output", a->outputs,
              "files to write, any number: all results in one .vtu, or a series .pvd", true);
  line.option("--cells", a->cells,
              "model (.fe.h5) or mesh (.mesh.h5) that provides the cells; default: the surface "
              "\"skin\" of the results");
  line.action([a](const CommonOptions& common) { export_to_paraview(*a, common); });
}

}  // namespace clatter::modal
