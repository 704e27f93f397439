// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-modal: modes of a part, with a proof that none is missing; comparison of a reduced model
// with the full one; static solution of load cases.
//
// Sample runs:
//   clatter-modal block.fe.h5 --fmax-hz 2000 -o block.modes.h5
//   clatter-modal block.rom.h5 --count 40 -o block_rom.modes.h5
//   clatter-modal --compare block.fe.h5 block.rom.h5
//   clatter-modal block.fe.h5 --static -o block.static.h5
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "core/base/artefact.hpp"
#include "core/base/blas_kernel.hpp"
#include "core/base/command_line.hpp"
#include "core/base/error.hpp"
#include "core/base/json_line.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/log.hpp"
#include "core/modes/compare.hpp"
#include "modal/first_frequency.hpp"
#include "modal/modes_file.hpp"
#include "modal/result_export.hpp"
#include "modal/static_json.hpp"
#include "modal/statics.hpp"

namespace {

using namespace clatter;
using Path = std::filesystem::path;

struct Arguments {
  std::vector<Path> inputs;
  Path config, output;
  int count = 0;
  double fmax_hz = 0.0;
  bool compare = false;
  bool statics = false;
  std::vector<Path> exports;           // of modes and statics, for ParaView
  std::vector<std::string> cases;      // of --static
  std::vector<std::string> stress_at;  // of --static
};

std::string number(double value) { return json_number(value); }

std::string list_of(const Eigen::VectorXd& values) {
  return fmt::format("[{}]", fmt::join(values.data(), values.data() + values.size(), ", "));
}

modes::ModesOptions choose_options(const Arguments& arguments, std::string& resolved) {
  modes::ModesOptions options;
  if (!arguments.config.empty()) {
    const Config config = Config::load(arguments.config);
    options = modes::read_modes_options(config);
    resolved = config.resolved();
  }
  if (arguments.count != 0 || arguments.fmax_hz != 0.0) {
    options.count = arguments.count;
    options.fmax_hz = arguments.fmax_hz;
    resolved += fmt::format("count = {}\nfmax_hz = {}\n", options.count, options.fmax_hz);
  }
  return options;
}

int compute(const Arguments& arguments, const CommonOptions& common) {
  if (arguments.inputs.size() != 1 || arguments.output.empty()) {
    throw InputError("command line: expected one model and -o output.modes.h5");
  }
  StepClock clock;
  const Path& input = arguments.inputs.front();
  std::string resolved;
  const modes::ModesOptions options = choose_options(arguments, resolved);
  const std::string schema = H5File::open(input).get_string("/", "schema");
  modes::PartModes part;
  rom::ReducedModel reduced;
  fe::FeModel full;
  if (schema == rom::kRomSchema) {
    reduced = rom::read_reduced_model(input);
    part = modes::analyse(reduced, options);
  } else {
    full = fe::read_fe_model(input);
    clock.lap(fmt::format("read {} DoF", full.size()));
    part = modes::analyse(full, options);
  }
  clock.lap("modes");
  for (const std::string& line : modes::describe(part)) print_result(line);
  modal::warn_of_first_frequency(part);

  std::vector<Path> read{input};
  if (!arguments.config.empty()) read.push_back(arguments.config);
  H5File file = H5File::create(arguments.output);
  modal::write_modes(file, part);
  write_provenance(file, {modal::kModesSchema, resolved, read});
  write_timing(file, clock);
  file.commit();
  const bool has_cells = !full.cells.blocks.empty();
  modal::export_results(arguments.output, has_cells ? input : Path(), arguments.exports);
  write_depfile(common.depfile, arguments.output, read);
  if (common.json) {
    print_json({{"output", json_text(arguments.output.string())},
                {"modes", number(part.modes.size())},
                {"frequency_hz", list_of(part.modes.frequencies_hz())},
                {"rigid", number(part.modes.rigid)},
                {"count_proved", number(part.modes.proof.proved ? 1.0 : 0.0)},
                {"seconds", number(clock.total_seconds())}});
  }
  return 0;
}

int solve_static(const Arguments& arguments, const CommonOptions& common) {
  if (arguments.inputs.size() != 1 || arguments.output.empty()) {
    throw InputError("command line: --static expects one model and -o output.static.h5");
  }
  StepClock clock;
  const Path& input = arguments.inputs.front();
  const fe::FeModel model = fe::read_fe_model(input);
  clock.lap(fmt::format("read {} DoF", model.size()));
  const std::vector<int32_t> stress_nodes = modal::nodes_at(model, arguments.stress_at);
  const modal::StaticSolution solution = modal::solve_static(model, arguments.cases);
  clock.lap(fmt::format("{} cases", solution.cases.size()));
  for (const std::string& line : modal::describe(model, solution)) print_result(line);
  for (const int32_t node : stress_nodes)
    for (const modal::StaticCase& solved : solution.cases)
      for (const std::string& line : modal::describe_stress(model, solved, node))
        print_result(line);
  H5File file = H5File::create(arguments.output);
  modal::write_static(file, model, solution);
  write_provenance(file, {modal::kStaticSchema, "", {input}});
  write_timing(file, clock);
  file.commit();
  modal::export_results(arguments.output, model.cells.blocks.empty() ? Path() : input,
                        arguments.exports);
  write_depfile(common.depfile, arguments.output, {input});
  if (common.json) {
    print_json({{"output", json_text(arguments.output.string())},
                {"cases", number(static_cast<double>(solution.cases.size()))},
                {"results", modal::json_of(model, solution)},
                {"seconds", number(clock.total_seconds())}});
  }
  return 0;
}

/// Exports existing results to ParaView.
int export_only(const Arguments& arguments, const CommonOptions& common) {
  if (arguments.inputs.size() > 2 || !arguments.output.empty() || arguments.exports.empty())
    throw InputError(
        "command line: results (.modes.h5, .static.h5) require --export (repeatable), "
        "without -o; a second file, .fe.h5 or .mesh.h5, provides the cells");
  const Path cells = arguments.inputs.size() == 2 ? arguments.inputs[1] : Path();
  modal::export_results(arguments.inputs.front(), cells, arguments.exports);
  write_depfile(common.depfile, arguments.exports.front(), arguments.inputs);
  return 0;
}

int compare(const Arguments& arguments, const CommonOptions& common) {
  if (arguments.inputs.size() != 2) {
    throw InputError("command line: --compare expects full.fe.h5 and reduced.rom.h5");
  }
  const fe::FeModel full = fe::read_fe_model(arguments.inputs[0]);
  fe::require_unknowns(full, "modes");
  const rom::ReducedModel reduced = rom::read_reduced_model(arguments.inputs[1]);
  const modes::Comparison result =
      modes::compare(full, reduced, {arguments.fmax_hz, arguments.count});
  if (common.json) {
    const modes::Comparison stated = result.with_stated_error();
    print_json({{"modes", modes::json_of(result)},
                {"rigid", number(result.rigid_full)},
                {"largest_error", number(result.largest_error())},
                {"smallest_mac", number(result.smallest_mac())},
                {"accurate_to_hz", number(result.accurate_to_hz)},
                {"modes_up_to_it", number(static_cast<double>(stated.modes.size()))},
                {"largest_error_up_to_it",
                 number(stated.modes.empty() ? std::nan("") : stated.largest_error())},
                {"smallest_mac_up_to_it",
                 number(stated.modes.empty() ? std::nan("") : stated.smallest_mac())}});
  } else {
    for (const std::string& line : modes::table_of(result)) print_result(line);
  }
  return 0;
}

int run(int argc, char** argv) {
  Arguments arguments;
  CommandLine line("clatter-modal",
                   "Modes of an assembled or reduced part, with a proof that none is missing; "
                   "--compare compares a reduced with the full model; --static solves load "
                   "cases for displacements, stresses and reactions.",
                   "samples: clatter-modal block.fe.h5 --fmax-hz 2000 -o block.modes.h5\n"
                   "         clatter-modal --compare block.fe.h5 block.rom.h5\n"
                   "         clatter-modal block.fe.h5 -o block.modes.h5 --export shapes.vtu\n"
                   "         clatter-modal block.modes.h5 block.fe.h5 --export shapes.pvd\n"
                   "         clatter-modal block.fe.h5 --static --case weight -o block.static.h5\n"
                   "         clatter-modal block.fe.h5 --static --stress-at 0.1,0,0.25 -o "
                   "block.static.h5");
  line.positional("model", arguments.inputs, "assembled (.fe.h5) or reduced (.rom.h5) part");
  line.option("-c,--config", arguments.config, "what to compute (.modes.toml)");
  line.output("-o,--output", arguments.output, "modes (.modes.h5)");
  line.option("--count", arguments.count, "the lowest modes, this many (default 20)");
  line.option("--fmax-hz", arguments.fmax_hz, "all modes below this frequency");
  line.flag("--compare", arguments.compare, "compare a full and a reduced model");
  line.flag("--static", arguments.statics, "solve the load cases of an assembled part");
  line.output("--export", arguments.exports,
              "also write shapes or static fields for ParaView (repeatable): all in one .vtu, or a "
              "series .pvd; also from existing results, with the model or mesh as second file");
  line.option("--case", arguments.cases, "load or case to solve (repeatable); default: all");
  line.option("--stress-at", arguments.stress_at,
              "print stresses of --static here (repeatable): node number, x,y,z in metres, or a "
              "sensor's name");
  line.blas();
  line.memory_limit();
  if (!line.parse(argc, argv)) return line.exit_code();
  modal::check_result_exports(arguments.exports);
  if (!arguments.inputs.empty() && modal::is_results(arguments.inputs.front()))
    return export_only(arguments, line.common());
  if (arguments.statics) return solve_static(arguments, line.common());
  if (arguments.count < 0 || arguments.fmax_hz < 0.0) {
    throw InputError(
        fmt::format("command line: found --count {} --fmax-hz {}, expected positive "
                    "numbers",
                    arguments.count, arguments.fmax_hz));
  }
  return arguments.compare ? compare(arguments, line.common()) : compute(arguments, line.common());
}

}  // namespace

int main(int argc, char** argv) {
  clatter::ensure_fast_blas(argv);
  clatter::keep_freed_memory();
  return clatter::run_guarded("clatter-modal", [&] { return run(argc, argv); });
}
