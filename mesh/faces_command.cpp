// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/faces_command.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/units.hpp"
#include "core/base/write_artefact.hpp"
#include "mesh/cad_alone.hpp"
#include "mesh/deck/import.hpp"
#include "mesh/deck/msh/reader.hpp"
#include "mesh/deck/other_formats.hpp"
#include "mesh/geometry/cad_unit.hpp"
#include "mesh/limits_option.hpp"
#include "mesh/part/list_faces.hpp"

namespace clatter::mesh {
namespace {

struct FacesArguments {
  std::filesystem::path input, output;
  ChildLimits limits;
};

void say_unit(const std::filesystem::path& source, const std::string& unit) {
  const std::string own = cad_unit(source);
  say(fmt::format("{}: {}; lengths here are in {}", source.string(),
                  own.empty() ? "gives no unit" : fmt::format("written in {}", own), unit));
}

Config config_of(const std::filesystem::path& input) {
  if (is_cad(input)) return config_of_cad(input, 0.0);
  if (deck::is_deck(input) || is_mesh_file(input))
    throw InputError(fmt::format(
        "{}: found a mesh, expected CAD (.step, .brep, .iges) or part.mesh.toml", input.string()));
  deck::refuse_other_format(input);
  return Config::load(input);
}

void show_faces(const FacesArguments& a, const CommonOptions& common) {
  check_limits(a.limits);
  StepClock clock;
  const Config config = config_of(a.input);
  const PartFile part = part_keys().read(config);
  if (part.shape.kind == "deck")
    config.fail("kind", "found \"deck\", expected a part with geometry");
  const ListedFaces found = list_faces_in_child(part, a.input.string(), true, a.limits);
  const bool from_cad = part.shape.kind == "cad";
  const std::filesystem::path source = from_cad ? part.shape.cad.source : a.input;
  clock.lap("faces");
  if (from_cad) say_unit(source, found.list.unit);
  std::vector<std::filesystem::path> inputs = {a.input};
  if (source != a.input) inputs.push_back(source);
  if (!a.output.empty()) {
    write_artefact(a.output, {kFacesSchema, config.resolved(), inputs}, clock, common,
                   [&](H5File& file) { write_faces(file, found.list, found.drawn, found.metres); });
    say(fmt::format("{0}: `clatter plot faces {0}` draws them with their numbers",
                    a.output.string()));
  }
  for (const std::string& line : table_of(found.list)) print_result(line);
  if (!common.json) return;
  JsonMembers members = json_of(found.list);
  members.emplace_back("element_size_mm",
                       json_number(default_element_size(found.list) * found.metres / kMilli));
  print_json(members);
}

}  // namespace

void declare_faces(CommandLine& program) {
  CommandLine& line = program.command(
      "faces",
      "Lists the faces of CAD or a description: number, kind, radius, axis, position, area.",
      "samples: clatter-mesh faces part.step\n"
      "         clatter-mesh faces part.mesh.toml -o part.faces.h5");
  const auto a = std::make_shared<FacesArguments>();
  line.positional("part", a->input,
                  "CAD (.step, .brep, .iges) or the description of a part (.mesh.toml)");
  line.output("-o,--output", a->output, "also write them for `clatter plot faces` (.faces.h5)");
  declare_limits(line, a->limits);
  line.action([a](const CommonOptions& common) { show_faces(*a, common); });
}

}  // namespace clatter::mesh
