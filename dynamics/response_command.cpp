// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/response_command.hpp"

#include <fmt/format.h>

#include "core/base/log.hpp"
#include "core/base/write_artefact.hpp"
#include "core/run/run_layout.hpp"
#include "dynamics/run/response_file.hpp"

namespace clatter::dynamics {
namespace {

struct ResponseArguments {
  std::filesystem::path run, output;
  std::string force, body;
};

void respond(const ResponseArguments& a, const CommonOptions& common) {
  StepClock clock;
  ResponseSummary made;
  Provenance provenance{
      run::kSchema, fmt::format("force = \"{}\"\nbody = \"{}\"\n", a.force, a.body), {a.run}};
  write_artefact(a.output, provenance, clock, common, [&](H5File& file) {
    made = write_response(a.run, a.force, a.body, file);
    clock.lap("periodic response");
  });
  print_result(fmt::format(
      "{} under {} alone: {:.4g} mm/s, all forces {:.4g} mm/s (root mean square over the cycle, by "
      "mass)",
      made.body, made.force, 1e3 * made.rms_velocity, 1e3 * made.run_velocity));
  print_json_result(a.output,
                    {{"rms_velocity_m_s", fmt::format("{:.9g}", made.rms_velocity)},
                     {"run_rms_velocity_m_s", fmt::format("{:.9g}", made.run_velocity)}},
                    clock, common);
}

}  // namespace

void declare_response(CommandLine& program) {
  CommandLine& line = program.command(
      "response",
      "Computes the periodic motion of a body under one of the forces that a run recorded, as a "
      "run file for clatter-recover.",
      "The scene names the forces, as the energy balance does:\n"
      "  [[recorded_force]]\n"
      "  name = \"slap\"\n"
      "  body = \"block\"\n"
      "  of = [\"piston_liner\"]\n"
      "Samples:\n"
      "  clatter-dynamics response slap.run.h5 --force slap -o slap_only.run.h5\n"
      "  clatter-recover slap_only.run.h5 -o slap_only.field.h5");
  const auto a = std::make_shared<ResponseArguments>();
  line.positional("run", a->run, "run file, slap.run.h5");
  line.option("--force", a->force, "name of the recorded force; default: the only one");
  line.option("--body", a->body, "the body on which it acts, where several have one of this name");
  line.output("-o,--output", a->output, "run file to write", true);
  line.action([a](const CommonOptions& common) { respond(*a, common); });
}

}  // namespace clatter::dynamics
