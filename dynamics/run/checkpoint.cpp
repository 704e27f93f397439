// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/checkpoint.hpp"

#include <fmt/format.h>

#include "core/base/artefact.hpp"

namespace clatter::dynamics {
namespace {

constexpr const char* kSchema = "clatter/checkpoint/1";

Checkpoint state_in(const H5File& file) {
  Checkpoint point;
  point.cycle = static_cast<int>(file.get_int("/", "cycle"));
  point.rung = static_cast<int>(file.get_int("/", "rung"));
  point.state.time = file.get_double("/", "time");
  point.state.eta = file.read_vector("state/eta");
  point.state.v = file.read_vector("state/v");
  point.state.a = file.read_vector("state/a");
  point.state.y = file.read_vector("state/y");
  point.state.v_y = file.read_vector("state/v_y");
  point.elements.resize(file.get_int("/", "elements"));
  for (size_t e = 0; e < point.elements.size(); ++e) {
    const auto name = fmt::format("elements/{}", e);
    if (file.has(name)) point.elements[e] = file.read_doubles(name);
  }
  point.energy = file.read_doubles("energy");
  if (file.has("recorded")) point.recorded = file.read_doubles("recorded");
  StepStatistics& s = point.statistics;
  const auto counts = file.read_longs("statistics");
  const auto seconds = file.read_doubles("seconds");
  if (counts.size() != 8 || seconds.size() != 6) {
    throw InputError(fmt::format("{}: statistics: found {} and {} numbers, expected 8 and 6",
                                 file.path().string(), counts.size(), seconds.size()));
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

}  // namespace

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

void CheckpointFile::add(const SampleBlock& block) {
  if (block.count == 0) return;
  file_.append(kCycleEta, block.eta.topRows(block.count));
  file_.append(kCycleVelocity, block.v.topRows(block.count));
}

void CheckpointFile::commit(const Checkpoint& point, const std::string& fingerprint) {
  file_.set("/", "schema", kSchema);
  file_.set("/", "fingerprint", fingerprint);
  file_.set("/", "cycle", point.cycle);
  file_.set("/", "rung", point.rung);
  file_.set("/", "time", point.state.time);
  file_.set("/", "elements", static_cast<int64_t>(point.elements.size()));
  file_.write("state/eta", point.state.eta);
  file_.write("state/v", point.state.v);
  file_.write("state/a", point.state.a);
  file_.write("state/y", point.state.y);
  file_.write("state/v_y", point.state.v_y);
  for (size_t e = 0; e < point.elements.size(); ++e) {
    if (!point.elements[e].empty()) file_.write(fmt::format("elements/{}", e), point.elements[e]);
  }
  file_.write("energy", point.energy);
  if (!point.recorded.empty()) file_.write("recorded", point.recorded);
  const StepStatistics& s = point.statistics;
  file_.write("statistics", std::vector<int64_t>{s.accepted, s.rejected_error, s.rejected_newton,
                                                 s.rejected_refused, s.stages, s.evaluations,
                                                 s.factorizations, s.operators});
  file_.write("seconds",
              std::vector<double>{s.smallest_step, s.largest_step, s.element_seconds,
                                  s.factor_seconds, s.operator_seconds, s.total_seconds});
  file_.commit();
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path,
                                          const std::string& fingerprint) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  return from_checkpoint(path, [&]() -> std::optional<Checkpoint> {
    const H5File file = open_artefact(path, kSchema);
    if (file.get_string("/", "fingerprint") != fingerprint) return std::nullopt;
    return state_in(file);
  });
}

InputError damaged_checkpoint(const std::filesystem::path& path, const std::string& what) {
  const std::string name = path.string();
  return InputError(fmt::format("{}{}; delete {}, or run without --resume, to start again",
                                what.starts_with(name) ? "" : name + ": ", what, name));
}

}  // namespace clatter::dynamics
