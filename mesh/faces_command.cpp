// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/faces_command.hpp"

#include <fmt/format.h>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/base/json_line.hpp"
#include "core/base/log.hpp"
#include "mesh/deck/import.hpp"
#include "mesh/deck/msh/reader.hpp"
#include "mesh/geometry/bare_cad.hpp"
#include "mesh/geometry/cad_unit.hpp"
#include "mesh/part/list_faces.hpp"

namespace clatter::mesh {
namespace {

void say_unit(const std::filesystem::path& source, const std::string& unit) {
  const std::string own = cad_unit(source);
  say(fmt::format("{}: {}; lengths here are in {}", source.string(),
                  own.empty() ? "gives no unit" : fmt::format("written in {}", own), unit));
}

Config config_of(const std::filesystem::path& input) {
  if (is_cad(input)) return config_of_cad(input, 0.0);
  if (deck::is_deck(input) || is_msh(input))
    throw InputError(fmt::format(
        "{}: found a mesh, expected CAD (.step, .brep, .iges) or part.mesh.toml for --faces",
        input.string()));
  Config config = Config::load(input);
  if (config.text("kind") == "deck")
    config.fail("kind", "found 'deck', expected a part with geometry for --faces");
  return config;
}

}  // namespace

Config config_of_cad(const std::filesystem::path& source, double element_size_mm) {
  const std::filesystem::path here =
      "part.mesh.toml";  // paths in a text are relative to the working folder
  return Config::parse(cad_description(source, here, element_size_mm), source.string());
}

double default_element_size_mm(const std::filesystem::path& source, const ChildLimits& limits) {
  const Config config = config_of_cad(source, 0.0);
  return default_element_size(list_faces_in_child(config, source.string(), false, limits).list);
}

void show_faces(const std::filesystem::path& input, const std::filesystem::path& output,
                const ChildLimits& limits, const CommonOptions& common) {
  StepClock clock;
  const Config config = config_of(input);
  const ListedFaces found = list_faces_in_child(config, input.string(), true, limits);
  const bool from_cad = config.text("kind") == "cad";
  const std::filesystem::path source = from_cad ? config.table("cad").path("source") : input;
  clock.lap("faces");
  if (from_cad) say_unit(source, found.list.unit);
  std::vector<std::filesystem::path> inputs = {input};
  if (source != input) inputs.push_back(source);
  if (!output.empty()) {
    H5File file = H5File::create(output);
    write_faces(file, found.list, found.drawn, found.metres);
    write_provenance(file, {kFacesSchema, config.resolved(), inputs});
    write_timing(file, clock);
    file.commit();
    say(fmt::format("{}: `clatter plot faces {}` draws them with their numbers", output.string(),
                    output.string()));
    write_depfile(common.depfile, output, inputs);
  }
  for (const std::string& line : table_of(found.list)) print_result(line);
  if (common.json)
    print_json({{"name", json_text(found.list.name)},
                {"unit", json_text(found.list.unit)},
                {"faces", json_of(found.list)}});
}

}  // namespace clatter::mesh
