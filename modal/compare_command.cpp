// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/compare_command.hpp"

#include <fmt/format.h>

#include "core/base/log.hpp"
#include "core/base/whole_file.hpp"
#include "core/base/write_artefact.hpp"
#include "core/modes/compare.hpp"

namespace clatter::modal {
namespace {

struct CompareArguments {
  std::filesystem::path full, reduced, mac;
  modes::CompareOptions options;
};

void compare_models(const CompareArguments& a, const CommonOptions& common) {
  if (a.options.count < 0 || a.options.fmax_hz < 0.0)
    throw InputError(
        fmt::format("command line: found --count {} --fmax-hz {}, expected positive numbers",
                    a.options.count, a.options.fmax_hz));
  const fe::FeModel full = fe::read_fe_model(a.full);
  fe::require_unknowns(full, "modes");
  const rom::ReducedModel reduced = rom::read_reduced_model(a.reduced);
  const modes::Comparison result = modes::compare(full, reduced, a.options);
  if (!a.mac.empty()) write_whole_file(a.mac, modes::matrix_text(result));
  for (const std::string& line : modes::table_of(result)) print_result(line);
  if (common.json) print_json(modes::json_of(result));
}

}  // namespace

void declare_compare(CommandLine& program) {
  CommandLine& line = program.command(
      "compare", "Compares the modes of a reduced part with those of the full one.",
      "samples: clatter-modal compare block.fe.h5 block.rom.h5\n"
      "         clatter-modal compare block.fe.h5 block.rom.h5 --fmax-hz 3000 --json\n"
      "         clatter-modal compare block.fe.h5 block.rom.h5 --mac block.mac.csv");
  const auto a = std::make_shared<CompareArguments>();
  line.positional("full", a->full, "assembled part (.fe.h5)");
  line.positional("reduced", a->reduced, "reduced part (.rom.h5)");
  line.option("--count", a->options.count, "compare the lowest modes, this many");
  line.option("--fmax-hz", a->options.fmax_hz,
              "compare all modes below this frequency; default: up to accurate_to_hz of the "
              "reduced part's certificate");
  line.output("--mac", a->mac, "also write the MAC of each mode with each other, block.mac.csv");
  line.blas();
  line.memory_limit();
  line.action([a](const CommonOptions& common) { compare_models(*a, common); });
}

}  // namespace clatter::modal
