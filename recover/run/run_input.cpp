// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/run/run_input.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/planned_files.hpp"
#include "core/rom/certificate_warning.hpp"
#include "recover/run/resample.hpp"

namespace clatter::recover {
namespace {

const std::string kTimes = run::path(run::kOutput, run::kTime);
const std::string kAngles = run::path(run::kOutput, run::kCrankAngle);

namespace fs = std::filesystem;

RunClock read_clock(const H5File& file) {
  const std::string origin = file.path().string();
  RunClock clock;
  clock.time = file.read_vector(kTimes);
  const Eigen::Index n = clock.time.size();
  if (n < 4)
    throw InputError(
        fmt::format("{}: {}: found {} samples, expected at least 4", origin, kTimes, n));
  clock.step_s = (clock.time[n - 1] - clock.time[0]) / static_cast<double>(n - 1);
  if (!clock.time.allFinite() || !(clock.step_s > 0.0))
    throw InputError(origin + ": " + kTimes + ": expected finite, ascending times");
  const Eigen::VectorXd steps = clock.time.tail(n - 1) - clock.time.head(n - 1);
  // Nonuniform sampling would smear every line of a transform; 1e-4 of a step keeps the phase error
  // at the Nyquist frequency below 0.02 degrees.
  if ((steps.array() - clock.step_s).abs().maxCoeff() > 1e-4 * clock.step_s)
    throw InputError(fmt::format("{}: {}: steps from {:.9g} s to {:.9g} s, expected one step",
                                 origin, kTimes, steps.minCoeff(), steps.maxCoeff()));
  if (!file.has(kAngles)) return clock;

  Eigen::VectorXd angle = file.read_vector(kAngles);
  if (angle.size() != n || !angle.allFinite())
    throw InputError(fmt::format("{}: {}: found {} values, expected {} finite ones", origin,
                                 kAngles, angle.size(), n));
  for (Eigen::Index i = 1; i < n; ++i)  // a wrapped angle is unwrapped
    angle[i] += 720.0 * std::round((angle[i - 1] - angle[i]) / 720.0);
  if (angle[n - 1] - angle[0] <= 0.0) return clock;  // at rest
  if ((angle.tail(n - 1) - angle.head(n - 1)).minCoeff() <= 0.0)
    throw InputError(origin + ": " + kAngles +
                     ": found descending values, expected an ascending angle");
  clock.angle_deg = angle;
  clock.angle_zero = file.has_attribute("/", run::kAngleZero)
                         ? file.get_string("/", run::kAngleZero)
                         : "firing TDC";
  return clock;
}

}  // namespace

double RunClock::speed_deg_s() const {
  if (!has_crank()) return 0.0;
  const Eigen::Index last = time.size() - 1;
  return (angle_deg[last] - angle_deg[0]) / (time[last] - time[0]);
}

bool RunClock::steady() const {
  if (!has_crank()) return true;
  const double speed = speed_deg_s();
  const Eigen::ArrayXd linear = angle_deg[0] + speed * (time.array() - time[0]);
  return (angle_deg.array() - linear).abs().maxCoeff() <= 1e-3 * speed * step_s;
}

double RunClock::time_at(double angle) const {
  if (steady()) return time[0] + (angle - angle_deg[0]) / speed_deg_s();
  const Eigen::Index last = time.size() - 1;
  // Outside the run at the speed at its end, where a polynomial would leave the curve.
  if (angle < angle_deg[0])
    return time[0] + (angle - angle_deg[0]) / (angle_deg[1] - angle_deg[0]) * step_s;
  if (angle > angle_deg[last])
    return time[last] +
           (angle - angle_deg[last]) / (angle_deg[last] - angle_deg[last - 1]) * step_s;
  return interpolate(angle_deg, time, angle);
}

double RunClock::angle_at(double time_s) const {
  if (steady()) return angle_deg[0] + speed_deg_s() * (time_s - time[0]);
  return interpolate(time, angle_deg, std::clamp(time_s, time[0], time[time.size() - 1]));
}

RunBody::RunBody(const fs::path& run, const std::string& body)
    : file_(open_artefact(run, run::kSchema)) {
  pick_body(body);
  clock_ = read_clock(file_);
  const std::string group = run::path(run::kBodies, name_);
  rom_sha256_ = file_.get_string(group, run::kRomHash);
  rom_path_ = file_.get_string(group, run::kRom);
  if (rom_path_.is_relative()) rom_path_ = (run.parent_path() / rom_path_).lexically_normal();
  will_read(rom_path_, fmt::format("{}: {}: rom", run.string(), group));
  check_shapes();
}

void RunBody::pick_body(const std::string& requested) {
  std::vector<std::string> with_rom;
  for (const std::string& name : file_.list(run::kBodies))
    if (const std::string group = run::path(run::kBodies, name);
        file_.has_attribute(group, run::kRom) && file_.has(run::path(group, run::kPosition)))
      with_rom.push_back(name);
  const auto is_available = [&](const std::string& name) {
    return std::find(with_rom.begin(), with_rom.end(), name) != with_rom.end();
  };
  if (!requested.empty() && is_available(requested))
    name_ = requested;
  else if (requested.empty() && is_available("block"))
    name_ = "block";
  else if (requested.empty() && with_rom.size() == 1)
    name_ = with_rom.front();
  else
    throw InputError(
        fmt::format("{}: bodies: found [{}] with a reduced model, expected {}",
                    file_.path().string(), fmt::join(with_rom, ", "),
                    requested.empty() ? "one, or `body` in the configuration" : requested));
}

void RunBody::check_shapes() const {
  const int64_t n_t = clock_.time.size();
  const std::vector<int64_t> q = file_.shape(dataset(run::kPosition));
  for (const char* member : {run::kPosition, run::kVelocity, run::kAcceleration}) {
    const std::vector<int64_t> shape = file_.shape(dataset(member));
    if (shape.size() != 2 || shape[0] != n_t || shape != q)
      throw InputError(
          fmt::format("{}: {}: found shape ({}), expected {} rows and as many columns as q",
                      file_.path().string(), dataset(member), fmt::join(shape, ", "), n_t));
  }
}

rom::ReducedModel RunBody::read_model() const {
  const std::string found = sha256_of_file(rom_path_);
  if (found != rom_sha256_)
    throw InputError(fmt::format(
        "{}: sha256: found {}..., expected {}... as in {}: the run used another reduced model, run "
        "it again",
        rom_path_.string(), found.substr(0, 12), rom_sha256_.substr(0, 12), file_.path().string()));
  rom::ReducedModel model = rom::read_reduced_model(rom_path_, false);
  model.skin = rom::read_skin_geometry(rom_path_);
  const std::string warning = rom::certificate_warning(model);
  if (!warning.empty()) warn(fmt::format("{}: {}", rom_path_.string(), warning));
  const int64_t columns = file_.shape(dataset(run::kPosition))[1];
  if (columns != model.size())
    throw InputError(fmt::format("{}: {}: found {} columns, expected {} as in {}",
                                 file_.path().string(), dataset(run::kPosition), columns,
                                 model.size(), rom_path_.string()));
  if (model.skin.triangles.rows() == 0)
    throw InputError(rom_path_.string() +
                     ": skin: found none, expected a skin (condense with one)");
  return model;
}

bool RunBody::complete() const {
  return !file_.has_attribute("/", run::kComplete) || file_.get_int("/", run::kComplete) != 0;
}

RowMatrix RunBody::samples(const std::string& quantity, int64_t first, int64_t count) const {
  RowMatrix rows = file_.read_rows(dataset(quantity), first, count);
  if (!rows.allFinite())
    throw InputError(fmt::format("{}: {}: found NaN or infinity, expected finite values",
                                 file_.path().string(), dataset(quantity)));
  return rows;
}

}  // namespace clatter::recover
