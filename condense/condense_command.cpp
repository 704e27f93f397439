// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/condense_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "condense/add_rows.hpp"
#include "condense/certify/verify.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/whole_file.hpp"
#include "core/base/write_artefact.hpp"

namespace clatter::condense {
namespace {

struct CondenseArguments {
  std::filesystem::path model, config, output;
  bool uncertified = false;
  double verify_hz = std::nan("");  // not a number: as the request says
};

/// clatter-condense-mpi does it too.
bool several_processes_could(const CondenseOptions& options) {
  return options.modes.method != sparse::EigenMethod::kAmls;
}

/// A sensor of the part that the reduced model does not have cannot be observed later.
void report_lost_sensors(const fe::FeModel& model, const CondenseOptions& options) {
  std::vector<std::string> lost;
  const auto is_kept = [&](const std::string& name) {
    return std::ranges::count(options.boundary, name) + std::ranges::count(options.rows, name) > 0;
  };
  for (const auto& [name, set] : model.sets)
    if (set.kind == "sensor" && !is_kept(name)) lost.push_back(name);
  if (!lost.empty())
    warn(
        fmt::format("sensors of the part that are neither in boundary nor in rows are lost: {} "
                    "(clatter-condense add-rows brings them back)",
                    fmt::join(lost, ", ")));
}

rom::ReducedModel reduce(const PartitionedModel& part, const CondenseOptions& options,
                         StepClock& clock) {
  rom::ReducedModel reduced = condense(part, options, clock);
  for (const std::string& text : describe(reduced)) print_result(text);
  if (!options.verify_hz) return reduced;
  const modes::Comparison compared = verify(reduced, part, *options.verify_hz);
  clock.lap("verification by the full model");
  if (!compared.modes.empty()) print_result(modes::table_of(compared).back());
  return reduced;
}

void condense_part(const CondenseArguments& a, const PartSource& source,
                   const CommonOptions& common) {
  if (a.verify_hz < 0.0)
    throw InputError(
        fmt::format("command line: --verify: found {}, expected 0 or more", a.verify_hz));
  StepClock clock;
  const Config config = Config::load(a.config);
  const std::string request = read_whole_file(a.config);
  CondenseOptions options = condense_keys().read(config);
  if (a.uncertified)
    options.certificate = options.modes.prove_count = options.modes.estimate_error = false;
  if (!std::isnan(a.verify_hz)) options.verify_hz = a.verify_hz;
  options.order = rom::read_elimination_order(a.output);
  const std::optional<fe::FeModel> model = source.read(a.model, common);
  if (!model) return;
  report_lost_sensors(*model, options);
  clock.lap(fmt::format("read {} DoF", model->size()));
  const rom::ReducedModel reduced =
      with_memory_advice(several_processes_could(options) ? source.memory_advice : "", [&] {
        const auto part = source.partition(a.model, *model, options);
        clock.lap("partition");
        return reduce(*part, options, clock);
      });
  if (!source.writes) return;
  write_artefact(a.output, {rom::kRomSchema, config.resolved(), {a.model, a.config}}, clock, common,
                 [&](H5File& file) {
                   rom::write_reduced_model(file, reduced);
                   write_request(file, request);
                 });
  print_json_result(a.output, json_of(reduced), clock, common);
}

}  // namespace

void declare_condense(CommandLine& line, const PartSource& source) {
  const auto a = std::make_shared<CondenseArguments>();
  line.positional("model", a->model, "assembled part (.fe.h5)");
  line.option("-c,--config", a->config, "what to retain (.rom.toml)", true);
  line.output("-o,--output", a->output, "reduced model (.rom.h5)", true);
  line.flag("--no-certificate", a->uncertified,
            "omit costly checks: the count of modes, the spectrum and condition of the reduced "
            "matrices; the file records this");
  line.option(
      "--verify", a->verify_hz,
      "compare with modes of the full model up to this frequency [Hz] and put the "
      "largest error and the smallest MAC into the certificate; 0: up to accurate_to_hz; in "
      "place of verify_hz of the request");
  line.blas();
  line.memory_limit();
  line.action([a, source](const CommonOptions& common) { condense_part(*a, source, common); });
}

}  // namespace clatter::condense
