// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/run_end.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/run/run_layout.hpp"

namespace clatter::dynamics {
namespace {

constexpr const char* kEnd = "end";

std::string dataset(const std::string& member) { return run::path(kEnd, member); }

std::vector<std::string> body_names(const System& system) {
  std::vector<std::string> names;
  for (const ModalBody& body : system.bodies()) names.push_back(body.name);
  return names;
}

/// "piston (6), rod (3)": bodies with their counts of modes.
std::string text_of(const std::vector<std::string>& names, const std::vector<int32_t>& modes) {
  std::string text;
  for (size_t b = 0; b < names.size() && b < modes.size(); ++b)
    text += fmt::format("{}{} ({} modes)", b > 0 ? ", " : "", names[b], modes[b]);
  return text;
}

void require_same_bodies(const H5File& file, const System& system, const LoadedBodies& bodies) {
  const std::vector<std::string> names = body_names(system);
  std::vector<int32_t> modes;
  for (const ModalBody& body : system.bodies()) modes.push_back(body.modes());
  const auto found_names = file.read_strings(dataset("bodies"));
  const auto found_modes = file.read_ints(dataset("modes"));
  if (names != found_names || modes != found_modes)
    throw InputError(fmt::format("found the end of {}, expected that of {}",
                                 text_of(found_names, found_modes), text_of(names, modes)));
  for (const LoadedBody& body : bodies) {
    const std::string group = run::path(run::kBodies, body.spec.name);
    if (file.get_string(group, run::kRomHash) != body.sha256)
      throw InputError(fmt::format("\"{}\" was another reduced model, {}, expected {} as it is now",
                                   body.spec.name, file.get_string(group, run::kRom),
                                   body.spec.rom.string()));
  }
}

void restore_elements(const H5File& file, System& system) {
  for (int e = 0; e < system.elements(); ++e) {
    ForceElement& element = system.element(e);
    if (element.save().empty()) continue;
    const std::string name = dataset("elements/" + element.name());
    if (!file.has(name))
      throw InputError(fmt::format("found no state of {}, expected one", element.name()));
    element.restore(file.read_doubles(name));
  }
}

}  // namespace

void write_end(H5File& file, const Model& model, const StageState& state) {
  const System& system = model.system;
  std::vector<int32_t> modes;
  for (const ModalBody& body : system.bodies()) modes.push_back(body.modes());
  file.write(dataset("bodies"), body_names(system));
  file.write(dataset("modes"), modes);
  file.write(dataset("eta"), state.eta);
  file.write(dataset("v"), state.v);
  for (int e = 0; e < system.elements(); ++e) {
    const std::vector<double> own = system.element(e).save();
    if (!own.empty()) file.write(dataset("elements/" + system.element(e).name()), own);
  }
}

ModalStart read_end(const std::filesystem::path& path, Model& model, const LoadedBodies& bodies) {
  const H5File file = open_artefact(path, run::kSchema);
  return with_context(path.string(), [&]() -> ModalStart {
    if (!file.has(kEnd))
      throw InputError(
          "found no state to start from, expected a complete run of an engine by this version");
    require_same_bodies(file, model.system, bodies);
    restore_elements(file, model.system);
    return {file.read_vector(dataset("eta")), file.read_vector(dataset("v"))};
  });
}

}  // namespace clatter::dynamics
