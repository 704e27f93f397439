// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/checkpoint.hpp"

#include <fmt/format.h>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"

namespace clatter::dynamics {

std::string fingerprint(const Scene& scene) {
  // Another program may store other states or step differently.
  std::string text = sha256_of_file("/proc/self/exe") + "\n" + scene.resolved;
  for (const auto& input : scene.inputs) {
    if (input.extension() == ".toml") continue;  // already in the configuration
    text += fmt::format("{} {}\n", input.filename().string(), sha256_of_file(input));
  }
  return text;
}

std::filesystem::path checkpoint_path(const std::filesystem::path& output) {
  return output.string() + ".checkpoint";
}

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& point,
                      const std::string& fingerprint) {
  H5File file = H5File::create(path);
  file.set("/", "schema", "clatter/checkpoint/1");
  file.set("/", "fingerprint", fingerprint);
  file.set("/", "cycle", point.cycle);
  file.set("/", "rung", point.rung);
  file.set("/", "time", point.state.time);
  file.set("/", "elements", static_cast<int64_t>(point.elements.size()));
  file.write("state/eta", point.state.eta);
  file.write("state/v", point.state.v);
  file.write("state/a", point.state.a);
  file.write("state/y", point.state.y);
  file.write("state/v_y", point.state.v_y);
  for (size_t e = 0; e < point.elements.size(); ++e) {
    if (!point.elements[e].empty()) file.write(fmt::format("elements/{}", e), point.elements[e]);
  }
  file.write("energy", point.energy);
  file.write("cycle/eta", point.eta);
  file.write("cycle/v", point.v);
  const StepStatistics& s = point.statistics;
  file.write("statistics", std::vector<int64_t>{s.accepted, s.rejected_error, s.rejected_newton,
                                                s.rejected_refused, s.stages, s.evaluations,
                                                s.factorizations, s.operators});
  file.write("seconds", std::vector<double>{s.smallest_step, s.largest_step, s.element_seconds,
                                            s.factor_seconds, s.operator_seconds, s.total_seconds});
  file.commit();
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path,
                                          const std::string& fingerprint) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const H5File file = open_artefact(path, "clatter/checkpoint/1");
  if (file.get_string("/", "fingerprint") != fingerprint) return std::nullopt;
  Checkpoint point;
  point.cycle = static_cast<int>(file.get_int("/", "cycle"));
  point.rung = static_cast<int>(file.get_int("/", "rung"));
  point.state.time = file.get_double("/", "time");
  point.state.eta = file.read_vector("state/eta");
  point.state.v = file.read_vector("state/v");
  point.state.a = file.read_vector("state/a");
  point.state.y = file.read_vector("state/y");
  point.state.v_y = file.read_vector("state/v_y");
  point.elements.resize(static_cast<size_t>(file.get_int("/", "elements")));
  for (size_t e = 0; e < point.elements.size(); ++e) {
    const auto name = fmt::format("elements/{}", e);
    if (file.has(name)) point.elements[e] = file.read_doubles(name);
  }
  point.energy = file.read_doubles("energy");
  point.eta = file.read_rows("cycle/eta");
  point.v = file.read_rows("cycle/v");
  StepStatistics& s = point.statistics;
  const auto counts = file.read_longs("statistics");
  const auto seconds = file.read_doubles("seconds");
  if (counts.size() != 8 || seconds.size() != 6) {
    throw InputError(fmt::format("{}: statistics: found {} and {} numbers, expected 8 and 6",
                                 path.string(), counts.size(), seconds.size()));
  }
  s.accepted = counts[0];
  s.rejected_error = counts[1];
  s.rejected_newton = counts[2];
  s.rejected_refused = counts[3];
  s.stages = counts[4];
  s.evaluations = counts[5];
  s.factorizations = counts[6];
  s.operators = counts[7];
  s.smallest_step = seconds[0];
  s.largest_step = seconds[1];
  s.element_seconds = seconds[2];
  s.factor_seconds = seconds[3];
  s.operator_seconds = seconds[4];
  s.total_seconds = seconds[5];
  return point;
}

}  // namespace clatter::dynamics
