// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/statics_command.hpp"

#include <fmt/format.h>

#include "core/base/log.hpp"
#include "core/base/write_artefact.hpp"
#include "modal/result_export.hpp"
#include "modal/static_json.hpp"
#include "modal/statics.hpp"

namespace clatter::modal {
namespace {

struct StaticsArguments {
  std::filesystem::path model, output;
  std::vector<std::string> cases, stress_at;
  std::vector<std::filesystem::path> exports;  // for ParaView
};

void compute_statics(const StaticsArguments& a, const CommonOptions& common) {
  check_result_exports(a.exports);
  StepClock clock;
  const fe::FeModel model = fe::read_fe_model(a.model);
  clock.lap(fmt::format("read {} DoF", model.size()));
  const std::vector<int32_t> stress_nodes = nodes_at(model, a.stress_at);
  const StaticSolution solution = solve_static(model, a.cases);
  clock.lap(fmt::format("{} cases", solution.cases.size()));
  for (const std::string& line : describe(model, solution)) print_result(line);
  for (const int32_t node : stress_nodes)
    for (const StaticCase& solved : solution.cases)
      for (const std::string& line : describe_stress(model, solved, node)) print_result(line);

  write_artefact(a.output, {fe::kStaticSchema, "", {a.model}}, clock, common,
                 [&](H5File& file) { write_static(file, model, solution); });
  export_results(a.output, model.cells.regions.empty() ? std::filesystem::path() : a.model,
                 a.exports);
  print_json_result(a.output, json_of(model, solution), clock, common);
}

}  // namespace

void declare_statics(CommandLine& program) {
  CommandLine& line = program.command(
      "statics",
      "Solves load cases of an assembled part for displacements, stresses and reactions.",
      "samples: clatter-modal statics block.fe.h5 --case weight -o block.static.h5\n"
      "         clatter-modal statics block.fe.h5 --stress-at 0.1,0,0.25 -o block.static.h5\n"
      "         clatter-modal statics block.fe.h5 -o block.static.h5 --export block.vtu");
  const auto a = std::make_shared<StaticsArguments>();
  line.positional("model", a->model, "assembled part (.fe.h5)");
  line.output("-o,--output", a->output, "static results (.static.h5)", true);
  line.option("--case", a->cases,
              "load or case to solve (repeatable); default: all, or the cases where a gasket has a "
              "curve");
  line.option("--stress-at", a->stress_at,
              "print stresses here (repeatable): node number, x,y,z in metres, or a sensor's name");
  line.output("--export", a->exports,
              "also write the fields for ParaView (repeatable): all in one .vtu, or a series .pvd");
  line.blas();
  line.memory_limit();
  line.action([a](const CommonOptions& common) { compute_statics(*a, common); });
}

}  // namespace clatter::modal
