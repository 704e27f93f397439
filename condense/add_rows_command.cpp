// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/add_rows_command.hpp"

#include <fmt/format.h>

#include "condense/add_rows.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/write_artefact.hpp"

namespace clatter::condense {
namespace {

struct AddRowsArguments {
  std::filesystem::path model, reduced, output;
  RowRequest rows;
};

/// Rejects a model from which the reduced part was not condensed.
void check_same_model(const AddRowsArguments& a, const StoredRequest& stored) {
  const std::string found = sha256_of_file(a.model);
  if (found == stored.model_sha256) return;
  throw InputError(fmt::format(
      "{}: found sha256 {:.12}..., expected {:.12}...: {} was condensed from "
      "another {}",
      a.model.string(), found, stored.model_sha256, a.reduced.string(), stored.model_path));
}

void add_rows_to_part(const AddRowsArguments& a, const CommonOptions& common) {
  if (a.rows.surfaces.empty() && a.rows.sets.empty())
    throw InputError("command line: add-rows expects --surface or --set, any number");
  StepClock clock;
  const StoredRequest stored = read_request(a.reduced);
  check_same_model(a, stored);
  const rom::ReducedModel reduced = rom::read_reduced_model(a.reduced);
  CondenseOptions options =
      condense_keys().read(Config::parse(stored.text, a.reduced.string() + ": request"));
  options.order = rom::read_elimination_order(a.reduced);
  const fe::FeModel model = fe::read_fe_model(a.model);
  fe::require_unknowns(model, "a reduction");
  clock.lap(fmt::format("read {} DoF", model.size()));
  const rom::ReducedModel with_rows = add_rows(model, reduced, options, a.rows, clock);
  print_result(describe_added_rows(with_rows));
  const std::string resolved = H5File::open(a.reduced).get_string("/", "config");
  write_artefact(a.output, {rom::kRomSchema, resolved, {a.model, a.reduced}}, clock, common,
                 [&](H5File& file) {
                   rom::write_reduced_model(file, with_rows);
                   write_request(file, stored.text);
                 });
  print_json_result(a.output, json_of_added_rows(with_rows), clock, common);
}

}  // namespace

void declare_add_rows(CommandLine& program) {
  CommandLine& line = program.command(
      "add-rows",
      "Makes the displacement of more surfaces and sets of a condensed part recoverable; its basis "
      "is solved for again and checked.",
      "samples: clatter-condense add-rows block.fe.h5 --of block.rom.h5 --surface liner_2_bore "
      "--set sensor_x -o block2.rom.h5");
  const auto a = std::make_shared<AddRowsArguments>();
  line.positional("model", a->model, "assembled part (.fe.h5)");
  line.option("--of", a->reduced, "the reduced part (.rom.h5) that was condensed from it", true);
  line.output("-o,--output", a->output, "reduced model with the rows (.rom.h5)", true);
  line.option("--surface", a->rows.surfaces, "surface that joins the skin, any number");
  line.option("--set", a->rows.sets, "set whose displacement is kept, any number");
  line.blas();
  line.memory_limit();
  line.action([a](const CommonOptions& common) { add_rows_to_part(*a, common); });
}

}  // namespace clatter::condense
