// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/run_file.hpp"

#include "core/run/run_layout.hpp"

namespace clatter::dynamics {
namespace {

void write_statistics(H5File& file, const StepStatistics& s) {
  const auto count = [&](const char* name, long long value) {
    file.set("statistics", name, static_cast<int64_t>(value));
  };
  count("accepted", s.accepted);
  count("rejected_error", s.rejected_error);
  count("rejected_newton", s.rejected_newton);
  count("rejected_refused", s.rejected_refused);
  count("stages", s.stages);
  count("evaluations", s.evaluations);
  count("factorizations", s.factorizations);
  count("operators", s.operators);
  file.set("statistics", "smallest_step", s.smallest_step);
  file.set("statistics", "largest_step", s.largest_step);
  file.set("statistics", "element_seconds", s.element_seconds);
  file.set("statistics", "factor_seconds", s.factor_seconds);
  file.set("statistics", "operator_seconds", s.operator_seconds);
  file.set("statistics", "total_seconds", s.total_seconds);
}

}  // namespace

void write_body(H5File& file, const LoadedBody& body) {
  const std::string group = run::path(run::kBodies, body.spec.name);
  const auto folder = std::filesystem::absolute(file.path()).parent_path();
  const auto rom = std::filesystem::absolute(body.spec.rom);
  file.set(group, run::kRom, rom.lexically_proximate(folder).string());
  file.set(group, run::kRomHash, body.sha256);
  file.set(group, "model", body.spec.elastic ? "elastic" : "rigid");
  static constexpr const char* kFrames[] = {"given", "space", "drive", "rod"};
  file.set(group, "frame", kFrames[static_cast<int>(body.spec.motion)]);
}

RunCertificate run_certificate(const RunResult& result) {
  RunCertificate numbers{result.periodicity};
  numbers.energy_residue = result.energy_residue;
  numbers.energy_exchanged = result.energy_exchanged;
  numbers.energy_imbalance = result.energy_imbalance;
  if (result.oil) {
    numbers.oil_residue = result.oil->residue();
    numbers.oil_moved = result.oil->moved;
  }
  numbers.creep = result.creep;
  numbers.complete = result.complete ? 1.0 : 0.0;
  numbers.cycles = result.cycles;
  const StepStatistics& s = result.statistics;
  numbers.steps_accepted = static_cast<double>(s.accepted);
  numbers.steps_rejected =
      static_cast<double>(s.rejected_error + s.rejected_newton + s.rejected_refused);
  return numbers;
}

Provenance provenance_of(const Scene& scene) {
  return {run::kSchema, scene.resolved, scene.inputs};
}

void append_samples(H5File& file, const Model& model, const LoadedBodies& bodies,
                    const SampleBlock& block) {
  std::vector<double> time, angle;
  for (Eigen::Index i = 0; i < block.count; ++i) {
    time.push_back(block.time(i));
    if (model.clock) angle.push_back(model.clock->angle_deg(time.back()));
  }
  const auto clock = [&](const char* name, const std::vector<double>& values, const char* unit) {
    const std::string path = run::path(run::kOutput, name);
    file.append(path, values);
    if (block.first == 0) file.set(path, "unit", unit);
  };
  clock(run::kTime, time, "s");
  if (model.clock) clock(run::kCrankAngle, angle, "deg");
  int index = 0;
  for (const auto& body : bodies) {
    const auto at = model.system.mode_offset(index++) + body.first_sampled;
    const Eigen::Index n = body.sampled.cols();
    const std::string group = run::path(run::kBodies, body.spec.name);
    const auto physical = [&](const RowMatrix& modal) -> RowMatrix {
      return modal.block(0, at, block.count, n) * body.sampled.transpose();
    };
    file.append(run::path(group, run::kPosition), physical(block.eta));
    file.append(run::path(group, run::kVelocity), physical(block.v));
    file.append(run::path(group, run::kAcceleration), physical(block.a));
  }
}

void write_run(const Scene& scene, const LoadedBodies& bodies, const RunResult& result) {
  H5File& file = *result.file;
  file.set("/", "title", scene.title);
  file.set("/", run::kComplete, result.complete ? 1 : 0);
  if (scene.clock) file.set("/", run::kAngleZero, scene.angle_zero);
  for (const auto& body : bodies) write_body(file, body);
  file.set("energy", "residue", result.energy_residue);
  result.model->effects.write(file);
  write_statistics(file, result.statistics);
  store_certificate(file, run_certificate(result));
}

}  // namespace clatter::dynamics
