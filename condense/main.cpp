// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-condense: reduces an assembled part to boundary coordinates and modes.
//
// Sample runs:
//   clatter-condense block.fe.h5 -c block.rom.toml -o block.rom.h5
//   clatter-condense piston.fe.h5 -c piston.rom.toml -o piston.rom.h5 --json
//   clatter-condense piston.rom.h5 --export piston.mtx
//   clatter-condense block.fe.h5 --add-rows block.rom.h5 --surface liner_2_bore -o block2.rom.h5
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "condense/add_rows.hpp"
#include "condense/certify/verify.hpp"
#include "condense/condense.hpp"
#include "condense/export/export.hpp"
#include "core/base/artefact.hpp"
#include "core/base/blas_kernel.hpp"
#include "core/base/command_line.hpp"
#include "core/base/error.hpp"
#include "core/base/json_line.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/log.hpp"
#include "core/base/planned_files.hpp"
#include "core/fe/fe_model.hpp"

namespace {

using namespace clatter;

struct Paths {
  std::filesystem::path model, config, output, add_rows;
  std::vector<std::filesystem::path> exports;
};

/// A reduced model's file; the first of `inputs` is the full model.
void write(const std::filesystem::path& output, const rom::ReducedModel& reduced,
           const Provenance& provenance, const std::string& request, const StepClock& clock) {
  H5File file = H5File::create(output);
  rom::write_reduced_model(file, reduced);
  condense::write_request(file, request);
  write_provenance(file, provenance);
  write_timing(file, clock);
  file.commit();
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void print_summary(const Paths& paths, const rom::ReducedModel& reduced, const StepClock& clock) {
  const auto& c = reduced.certificate;
  print_json({{"output", json_text(paths.output.string())},
              {"method", json_text(reduced.method)},
              {"boundary", json_number(reduced.n_boundary)},
              {"size", json_number(reduced.size())},
              {"valid_to_hz", json_number(reduced.valid_to_hz)},
              {"count_proved", json_number(c.count_proved.value())},
              {"rigid_modes", json_number(c.rigid_modes.value_or(std::nan("")))},
              {"certified", json_number(c.certified.value())},
              {"seconds", json_number(clock.total_seconds())}});
}

int write_exports(const Paths& paths, const CommonOptions& common) {
  if (!paths.config.empty() || !paths.output.empty())
    throw InputError("command line: --export takes a reduced model alone, without -c and -o");
  for (const std::filesystem::path& path : paths.exports)
    for (const std::filesystem::path& file : condense::exported_files(path))
      if (file != path) will_write("--export", file);
  const rom::ReducedModel reduced = rom::read_reduced_model(paths.model, false);
  std::vector<std::string> files;
  for (const std::filesystem::path& path : paths.exports)
    for (const std::filesystem::path& file : condense::export_reduced(reduced, path))
      files.push_back(json_text(file.string()));
  print_result(fmt::format("{}: {} coordinates to {}", reduced.name, reduced.size(),
                           fmt::join(files, ", ")));
  write_depfile(common.depfile, paths.exports.front(), {paths.model});
  if (common.json) print_json({{"files", fmt::format("[{}]", fmt::join(files, ", "))}});
  return 0;
}

/// Rejects a model from which the reduced part was not condensed.
void check_same_model(const Paths& paths, const condense::StoredRequest& stored) {
  const std::string found = sha256_of_file(paths.model);
  if (found == stored.model_sha256) return;
  throw InputError(
      fmt::format("{}: found sha256 {:.12}..., expected {:.12}...: {} was condensed from "
                  "another {}",
                  paths.model.string(), found, stored.model_sha256, paths.add_rows.string(),
                  stored.model_path));
}

int add_rows(const Paths& paths, const condense::RowRequest& request, const CommonOptions& common) {
  if (paths.output.empty() || !paths.config.empty() || !paths.exports.empty())
    throw InputError("command line: --add-rows expects -o new.rom.h5, without -c and --export");
  if (request.surfaces.empty() && request.sets.empty())
    throw InputError("command line: --add-rows expects --surface or --set, any number");
  StepClock clock;
  const condense::StoredRequest stored = condense::read_request(paths.add_rows);
  check_same_model(paths, stored);
  const rom::ReducedModel reduced = rom::read_reduced_model(paths.add_rows);
  condense::CondenseOptions options = condense::read_condense_options(
      Config::parse(stored.text, paths.add_rows.string() + ": request"));
  options.order = rom::read_elimination_order(paths.add_rows);
  const fe::FeModel model = fe::read_fe_model(paths.model);
  fe::require_unknowns(model, "a reduction");
  clock.lap(fmt::format("read {} DoF", model.size()));
  const rom::ReducedModel with_rows = condense::add_rows(model, reduced, options, request, clock);
  const double error = with_rows.certificate.rows_added_error.value();
  print_result(fmt::format(
      "{}: {} skin nodes, {} sets besides the boundary; the basis solved for again "
      "differs by {:.1e} from the stored one",
      with_rows.name, with_rows.skin.nodes.rows(), with_rows.recovered_sets.size(), error));
  const std::string resolved = H5File::open(paths.add_rows).get_string("/", "config");
  write(paths.output, with_rows, {rom::kRomSchema, resolved, {paths.model, paths.add_rows}},
        stored.text, clock);
  write_depfile(common.depfile, paths.output, {paths.model, paths.add_rows});
  if (common.json)
    print_json(
        {{"output", json_text(paths.output.string())},
         {"skin_nodes", json_number(static_cast<double>(with_rows.skin.nodes.rows()))},
         {"recovered_sets", json_number(static_cast<double>(with_rows.recovered_sets.size()))},
         {"rows_added_error", json_number(error)},
         {"seconds", json_number(clock.total_seconds())}});
  return 0;
}

int run(int argc, char** argv) {
  Paths paths;
  CommandLine line("clatter-condense",
                   "Reduces an assembled part by Craig-Bampton, Craig-Chang or Guyan and certifies "
                   "the result; --export writes a reduced part for other programs, --add-rows "
                   "makes the displacement of more surfaces and sets recoverable.",
                   "samples: clatter-condense block.fe.h5 -c block.rom.toml -o block.rom.h5\n"
                   "         clatter-condense block.rom.h5 --export block.mtx\n"
                   "         clatter-condense block.fe.h5 --add-rows block.rom.h5 --surface "
                   "liner_2_bore --set sensor_x -o block2.rom.h5");
  line.positional("model", paths.model, "assembled part (.fe.h5); with --export reduced (.rom.h5)");
  line.option("-c,--config", paths.config, "what to retain (.rom.toml)");
  line.output("-o,--output", paths.output, "reduced model (.rom.h5)");
  line.output("--export", paths.exports,
              "write a reduced part, any number: part.mtx (Matrix Market), part.inp (CalculiX), "
              "part.pch (Nastran DMIG), part.fem (MBDyn)");
  condense::RowRequest rows;
  line.option("--add-rows", paths.add_rows,
              "a reduced part (.rom.h5) of this model, to be written again with rows for more "
              "surfaces and sets; its basis is solved for again and checked");
  line.option("--surface", rows.surfaces,
              "with --add-rows: surface that joins the skin, any number");
  line.option("--set", rows.sets, "with --add-rows: set whose displacement is kept, any number");
  bool uncertified = false;
  line.flag("--no-certificate", uncertified,
            "omit costly checks: the count of modes, the spectrum and condition of the reduced "
            "matrices; the file records this");
  double verify_hz = std::nan("");
  line.option("--verify", verify_hz,
              "compare with modes of the full model up to this frequency [Hz] and put the largest "
              "error and the smallest MAC into the certificate; 0: up to accurate_to_hz");
  line.blas();
  line.memory_limit();
  if (!line.parse(argc, argv)) return line.exit_code();
  if (!paths.add_rows.empty()) return add_rows(paths, rows, line.common());
  if (!rows.surfaces.empty() || !rows.sets.empty())
    throw InputError("command line: --surface and --set expect --add-rows part.rom.h5");
  if (!paths.exports.empty()) return write_exports(paths, line.common());
  if (paths.config.empty() || paths.output.empty())
    throw InputError("command line: expected -c part.rom.toml and -o part.rom.h5, or --export");

  if (verify_hz < 0.0)
    throw InputError(
        fmt::format("command line: --verify: found {}, expected 0 or more", verify_hz));

  StepClock clock;
  const Config config = Config::load(paths.config);
  condense::CondenseOptions options = condense::read_condense_options(config);
  if (uncertified)
    options.certificate = options.modes.prove_count = options.modes.estimate_error = false;
  options.order = rom::read_elimination_order(paths.output);
  const fe::FeModel model = fe::read_fe_model(paths.model);
  fe::require_unknowns(model, "a reduction");
  clock.lap(fmt::format("read {} DoF", model.size()));
  rom::ReducedModel reduced = condense::condense(model, options, clock);
  for (const std::string& text : condense::describe(reduced)) print_result(text);
  if (!std::isnan(verify_hz)) {
    const auto compared = condense::verify(reduced, model, verify_hz);
    clock.lap("verification by the full model");
    if (!compared.modes.empty()) print_result(modes::table_of(compared).back());
  }
  write(paths.output, reduced, {rom::kRomSchema, config.resolved(), {paths.model, paths.config}},
        text_of(paths.config), clock);
  write_depfile(line.common().depfile, paths.output, {paths.model, paths.config});
  if (line.common().json) print_summary(paths, reduced, clock);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  clatter::ensure_fast_blas(argv);
  clatter::keep_freed_memory();
  return clatter::run_guarded("clatter-condense", [&] { return run(argc, argv); });
}
