// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/run_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/run/run_layout.hpp"

namespace clatter::dynamics {
namespace {

double degrees(const Model& model, double time) {
  return model.crank->angle(time) * 180.0 / std::numbers::pi;
}

void write_clock(H5File& file, const Model& model, const std::string& group,
                 const std::vector<double>& time) {
  file.write(run::path(group, run::kTime), time);
  file.set(run::path(group, run::kTime), "unit", "s");
  if (!model.crank) return;
  std::vector<double> angle;
  for (const double t : time) angle.push_back(degrees(model, t));
  file.write(run::path(group, run::kCrankAngle), angle);
  file.set(run::path(group, run::kCrankAngle), "unit", "deg");
}

void write_bodies(H5File& file, const LoadedBodies& bodies, const RunResult& result) {
  const auto& samples = result.recorder->samples();
  const auto folder = std::filesystem::absolute(file.path()).parent_path();
  int index = 0;
  for (const auto& body : bodies) {
    const auto at = result.model->system.mode_offset(index++), n = body.modal.modes();
    const std::string group = run::path(run::kBodies, body.spec.name);
    const auto physical = [&](const RowMatrix& modal) -> RowMatrix {
      return modal.topRows(samples.count()).middleCols(at, n) * body.modal.shapes.transpose();
    };
    file.write(run::path(group, run::kPosition), physical(samples.eta()));
    file.write(run::path(group, run::kVelocity), physical(samples.v()));
    file.write(run::path(group, run::kAcceleration), physical(samples.a()));
    const auto rom = std::filesystem::absolute(body.spec.rom);
    file.set(group, run::kRom, rom.lexically_proximate(folder).string());
    file.set(group, run::kRomHash, body.sha256);
    file.set(group, "model", body.spec.elastic ? "elastic" : "rigid");
  }
}

void write_columns(H5File& file, const std::string& group, const Columns& columns) {
  for (size_t i = 0; i < columns.names.size(); ++i) {
    const std::string name = group + "/" + columns.names[i];
    file.write(name, columns.values[i]);
    file.set(name, "unit", columns.units[i]);
  }
}

using Field = RowMatrix film::PadSnapshot::*;

void write_field(H5File& file, const std::string& name, const FilmFrames& frames, size_t pad,
                 Field field) {
  const RowMatrix& first = frames.pads.front()[pad].*field;
  if (first.size() == 0) return;
  std::vector<float> values;
  for (const auto& pads : frames.pads) {
    const RowMatrix& one = pads[pad].*field;
    for (Eigen::Index k = 0; k < one.size(); ++k) {
      values.push_back(static_cast<float>(one.data()[k]));
    }
  }
  file.write_float(name, values,
                   {static_cast<int64_t>(frames.pads.size()), first.rows(), first.cols()});
}

void write_film(H5File& file, const Model& model, const FilmFrames& frames) {
  if (frames.time.empty()) return;
  write_clock(file, model, "film", frames.time);
  const auto& pads = frames.pads.front();
  for (size_t pad = 0; pad < pads.size(); ++pad) {
    const std::string group = "film/" + pads[pad].name;
    file.write(group + "/angle_deg", Eigen::VectorXd(pads[pad].angle * (180.0 / std::numbers::pi)));
    file.write(group + "/axial", pads[pad].axial);
    write_field(file, group + "/gap", frames, pad, &film::PadSnapshot::gap);
    write_field(file, group + "/pressure", frames, pad, &film::PadSnapshot::pressure);
    write_field(file, group + "/fill", frames, pad, &film::PadSnapshot::fill);
    write_field(file, group + "/contact_pressure", frames, pad,
                &film::PadSnapshot::contact_pressure);
  }
}

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

RunCertificate run_certificate(const RunResult& result) {
  RunCertificate numbers{result.periodicity};
  numbers.energy_residue = result.energy_residue;
  numbers.energy_exchanged = result.energy_exchanged;
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

void write_run(H5File& file, const Scene& scene, const LoadedBodies& bodies,
               const RunResult& result) {
  const Model& model = *result.model;
  const Recorder& recorder = *result.recorder;
  file.set("/", "title", scene.title);
  file.set("/", run::kComplete, result.complete ? 1 : 0);
  std::vector<double> time;
  for (int i = 0; i < recorder.samples().count(); ++i) time.push_back(recorder.samples().time(i));
  write_clock(file, model, run::kOutput, time);
  write_bodies(file, bodies, result);
  write_clock(file, model, "history", recorder.time());
  write_columns(file, "history", recorder.history());
  write_clock(file, model, "energy", recorder.time());
  write_columns(file, "energy", recorder.energy());
  file.set("energy", "residue", result.energy_residue);
  write_film(file, model, recorder.film());
  model.effects.write(file);
  write_statistics(file, result.statistics);
  write_certificate(file, run_certificate(result));
}

}  // namespace clatter::dynamics
