// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/modes_command.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/write_artefact.hpp"
#include "core/fe/part_errors.hpp"
#include "modal/first_frequency.hpp"
#include "modal/modes_file.hpp"
#include "modal/result_export.hpp"

namespace clatter::modal {
namespace {

struct ModesArguments {
  std::filesystem::path model, config, output;
  int count = 0;
  double fmax_hz = 0.0;
  std::vector<std::filesystem::path> exports;  // for ParaView
};

/// The options and their resolved text.
std::pair<modes::ModesOptions, std::string> choose_options(const ModesArguments& a) {
  if (a.count < 0 || a.fmax_hz < 0.0)
    throw InputError(
        fmt::format("command line: found --count {} --fmax-hz {}, expected positive numbers",
                    a.count, a.fmax_hz));
  modes::ModesOptions options;
  std::string resolved;
  if (!a.config.empty()) {
    const Config config = Config::load(a.config);
    options = modes::modes_keys().read(config);
    resolved = config.resolved();
  }
  if (a.count != 0 || a.fmax_hz != 0.0) {
    options.count = a.count;
    options.fmax_hz = a.fmax_hz;
    resolved += fmt::format("count = {}\nfmax_hz = {}\n", options.count, options.fmax_hz);
  }
  return {options, resolved};
}

/// Modes above what the reduced parts of a model are for.
void warn_of_parts(const modes::PartModes& part, const fe::FeParts& parts) {
  const auto above = (part.modes.frequencies_hz().array() > parts.valid_to_hz()).count();
  if (above > 0)
    warn(fmt::format("{} of {} modes lie above {:g} Hz, to which the reduced parts are valid",
                     above, part.modes.values.size(), parts.valid_to_hz()));
  fe::warn_of_unknown_errors(parts, part.name);
}

void compute_modes(const ModesArguments& a, const ModeFinder& finder, const CommonOptions& common) {
  finder.begin(common);
  check_result_exports(a.exports);
  StepClock clock;
  const auto [options, resolved] = choose_options(a);
  modes::PartModes part;
  rom::ReducedModel reduced;
  fe::FeModel full;
  if (H5File::open(a.model).get_string("/", "schema") == rom::kRomSchema) {
    if (!finder.writes) return;
    reduced = rom::read_reduced_model(a.model);
    part = modes::analyse(reduced, options);
  } else {
    part = finder.of_fe_model(a.model, options, full, clock);
  }
  if (!finder.writes) return;
  clock.lap("modes");
  for (const std::string& line : modes::describe(part)) print_result(line);
  warn_of_first_frequency(part);
  warn_of_parts(part, full.parts);

  std::vector<std::filesystem::path> read{a.model};
  if (!a.config.empty()) read.push_back(a.config);
  write_artefact(a.output, {kModesSchema, resolved, read}, clock, common,
                 [&](H5File& file) { write_modes(file, part); });
  export_results(a.output, full.cells.regions.empty() ? std::filesystem::path() : a.model,
                 a.exports);
  print_json_result(a.output, modes::json_of(part), clock, common);
}

}  // namespace

ModeFinder one_process_finder() {
  ModeFinder finder;
  finder.of_fe_model = [](const std::filesystem::path& path, const modes::ModesOptions& options,
                          fe::FeModel& model, StepClock& clock) {
    model = fe::read_fe_model(path);
    clock.lap(fmt::format("read {} DoF", model.size()));
    const bool shareable = options.method != sparse::EigenMethod::kAmls;
    return with_memory_advice(
        shareable ? "or share the part among processes: mpirun -n 4 clatter-modal-mpi "
                    "(docs/cluster.md)"
                  : "",
        [&] { return modes::analyse(model, options); });
  };
  return finder;
}

void declare_modes(CommandLine& line, const ModeFinder& finder) {
  const auto a = std::make_shared<ModesArguments>();
  line.positional("model", a->model, "assembled (.fe.h5) or reduced (.rom.h5) part");
  line.option("-c,--config", a->config, "what to compute (.modes.toml)");
  line.output("-o,--output", a->output, "modes (.modes.h5)", true);
  line.option("--count", a->count, "the lowest modes, this many (default 20)");
  line.option("--fmax-hz", a->fmax_hz, "all modes below this frequency");
  line.output("--export", a->exports,
              "also write the shapes for ParaView (repeatable): all in one .vtu, or a series .pvd");
  line.blas();
  line.memory_limit();
  line.action([a, finder](const CommonOptions& common) { compute_modes(*a, finder, common); });
}

}  // namespace clatter::modal
