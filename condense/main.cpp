// clatter-condense: reduces an assembled part to boundary coordinates and fixed-interface modes.
//
// Sample runs:
//   clatter-condense block.fe.h5 -c block.rom.toml -o block.rom.h5
//   clatter-condense piston.fe.h5 -c piston.rom.toml -o piston.rom.h5 --json
#include <fmt/format.h>

#include "assembly/fe_model.hpp"
#include "condense/condense.hpp"
#include "core/artefact.hpp"
#include "core/blas_kernel.hpp"
#include "core/command_line.hpp"
#include "core/error.hpp"
#include "core/log.hpp"

namespace {

using namespace clatter;

struct Paths {
  std::filesystem::path model, config, output;
};

void write(const Paths& paths, const ReducedModel& reduced, const std::string& resolved,
           const StepClock& clock) {
  H5File file = H5File::create(paths.output);
  write_reduced_model(file, reduced);
  write_provenance(file, {"clatter/rom/1", resolved, {paths.model, paths.config}});
  write_timing(file, clock);
  file.commit();
}

void print_summary(const Paths& paths, const ReducedModel& reduced, const StepClock& clock) {
  print_json({{"output", json_text(paths.output.string())},
              {"method", json_text(reduced.method)},
              {"boundary", json_number(reduced.n_boundary)},
              {"size", json_number(reduced.size())},
              {"valid_to_hz", json_number(reduced.valid_to_hz)},
              {"count_proved", json_number(reduced.certificate.at("count_proved"))},
              {"rigid_modes", json_number(reduced.certificate.at("rigid_modes"))},
              {"seconds", json_number(clock.total_seconds())}});
}

int run(int argc, char** argv) {
  Paths paths;
  CommandLine line(
      "clatter-condense",
      "Reduces an assembled part by Craig-Bampton (or Guyan) and certifies the result.",
      "sample: clatter-condense block.fe.h5 -c block.rom.toml -o block.rom.h5");
  line.positional("model", paths.model, "assembled part (.fe.h5)");
  line.option("-c,--config", paths.config, "what to retain (.rom.toml)", true);
  line.option("-o,--output", paths.output, "reduced model (.rom.h5)", true);
  if (!line.parse(argc, argv)) return line.exit_code();

  StepClock clock;
  const Config config = Config::load(paths.config);
  const condense::CondenseOptions options = condense::read_condense_options(config);
  const assembly::FeModel model = assembly::read_fe_model(paths.model);
  clock.lap(fmt::format("read {} DoF", model.size()));
  const ReducedModel reduced = condense::condense(model, options, clock);
  for (const std::string& text : condense::describe(reduced)) say(text);
  write(paths, reduced, config.resolved(), clock);
  write_depfile(line.common().depfile, paths.output, {paths.model, paths.config});
  if (line.common().json) print_summary(paths, reduced, clock);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  clatter::ensure_fast_blas(argv);
  return clatter::run_guarded("clatter-condense", [&] { return run(argc, argv); });
}
