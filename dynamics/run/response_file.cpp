// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/response_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/run/run_layout.hpp"
#include "dynamics/run/periodic_response.hpp"
#include "dynamics/run/run_file.hpp"

namespace clatter::dynamics {
namespace {

struct RecordedForce {
  std::string body, name;
};

/// The only force of that name, of any name where it is empty, on that body.
RecordedForce find_force(const H5File& run, const std::string& force, const std::string& body) {
  std::vector<RecordedForce> found;
  std::vector<std::string> all;
  if (run.has(run::kForces))
    for (const std::string& name : run.list(run::kForces))
      for (const std::string& recorded : run.list(run::path(run::kForces, name))) {
        all.push_back(fmt::format("\"{}\" on {}", recorded, name));
        if ((force.empty() || recorded == force) && (body.empty() || body == name))
          found.push_back({name, recorded});
      }
  if (found.size() == 1) return found.front();
  const std::string where = run.path().string();
  if (all.empty())
    throw InputError(fmt::format(
        "{}: forces: found none, expected forces recorded by [[recorded_force]] of the scene",
        where));
  throw InputError(fmt::format(
      "{}: forces: found {}, expected {}", where, fmt::join(all, ", "),
      found.empty() ? fmt::format("\"{}\"", force) : "--force and --body that name one of them"));
}

LoadedBody body_of(const H5File& run, const std::string& name) {
  const std::string group = run::path(run::kBodies, name);
  BodySpec spec;
  spec.name = name;
  spec.rom = run.get_string(group, run::kRom);
  if (spec.rom.is_relative()) spec.rom = (run.path().parent_path() / spec.rom).lexically_normal();
  spec.elastic = run.get_string(group, "model") == "elastic";
  LoadedBody body = load_body(spec);
  if (body.sha256 != run.get_string(group, run::kRomHash))
    throw InputError(fmt::format(
        "{}: found another reduced model than that of {}, expected the same: run it again",
        spec.rom.string(), run.path().string()));
  return body;
}

/// Root mean square of the velocity over a cycle, the last sample being the first of the next one.
double rms(const RowMatrix& v, const LoadedBody& body, bool without_mean) {
  RowMatrix cycle = v.topRows(v.rows() - 1);
  if (without_mean) cycle.rowwise() -= Eigen::RowVectorXd(cycle.colwise().mean());
  const double energy = (cycle * body.model.M_rr).cwiseProduct(cycle).sum();
  return std::sqrt(energy / static_cast<double>(cycle.rows()) / body.modal.mass);
}

}  // namespace

ResponseSummary write_response(const std::filesystem::path& path, const std::string& force_name,
                               const std::string& body_name, H5File& file) {
  const H5File run = open_artefact(path, run::kSchema);
  const auto [name, force] = find_force(run, force_name, body_name);
  const LoadedBody body = body_of(run, name);
  const std::string times = run::path(run::kOutput, run::kTime);
  const std::vector<double> time = run.read_doubles(times);
  const RowMatrix forces = run.read_rows(run::path(run::path(run::kForces, name), force));
  if (forces.rows() != std::ssize(time) || forces.rows() < 3 || forces.cols() != body.model.size())
    throw InputError(fmt::format("{}: forces/{}/{}: found {} x {}, expected {} samples x {}",
                                 path.string(), name, force, forces.rows(), forces.cols(),
                                 time.size(), body.model.size()));
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  const PeriodicMotion motion = periodic_response(forces * body.modal.shapes, step,
                                                  body.modal.omega_squared, body.modal.damping);

  file.write(times, time);
  file.set(times, "unit", "s");
  if (const std::string angles = run::path(run::kOutput, run::kCrankAngle); run.has(angles)) {
    file.write(angles, run.read_doubles(angles));
    file.set(angles, "unit", "deg");
    if (run.has_attribute("/", run::kAngleZero))
      file.set("/", run::kAngleZero, run.get_string("/", run::kAngleZero));
  }
  const std::string group = run::path(run::kBodies, name);
  const RowMatrix v = motion.v * body.sampled.transpose();
  file.write(run::path(group, run::kPosition), RowMatrix(motion.eta * body.sampled.transpose()));
  file.write(run::path(group, run::kVelocity), v);
  file.write(run::path(group, run::kAcceleration), RowMatrix(motion.a * body.sampled.transpose()));
  write_body(file, body);
  file.set("/", "title", fmt::format("{}: {} alone", run.get_string("/", "title"), force));
  file.set("/", "force", force);
  file.set("/", run::kComplete, static_cast<int64_t>(run.get_int("/", run::kComplete)));

  ResponseSummary summary{name, force, body.spec.rom, forces.rows(), 0.0, 0.0};
  summary.rms_velocity = rms(v, body, false);
  summary.run_velocity = rms(run.read_rows(run::path(group, run::kVelocity)), body, true);
  return summary;
}

}  // namespace clatter::dynamics
