// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The part of a run file (clatter/run/1) that recovery needs, and the reduced model of the body.
#include <filesystem>
#include <string>

#include "core/base/h5_file.hpp"
#include "core/rom/reduced_model.hpp"
#include "core/rom/skin_rows.hpp"
#include "core/run/run_layout.hpp"

namespace clatter::recover {

/// The times of the samples of a run.
struct RunClock {
  Eigen::VectorXd time;       // n_t [s], uniform steps
  Eigen::VectorXd angle_deg;  // n_t, ascending through all cycles; empty without a crank
  double step_s = 0.0;
  std::string angle_zero{};  // what crank angle 0 is: "firing TDC"; empty without a crank

  bool has_crank() const { return angle_deg.size() > 0; }
  /// Mean speed of the entire run [deg/s].
  double speed_deg_s() const;
  /// Whether the angle follows the mean speed to a thousandth of a step at every sample.
  bool steady() const;
  /// Run time at which the crank is at `angle` [deg]: linear when steady, else interpolated with an
  /// error of order six in the step (resample.hpp).
  double time_at(double angle) const;
  /// Crank angle [deg] at a run time [s], likewise.
  double angle_at(double time_s) const;
};

/// One body of a run: its clock and its reduced coordinates, read piece by piece.
class RunBody {
 public:
  /// Opens the run and picks a body: the named one; with an empty name "block", or else the only
  /// body that has a reduced model.
  /// @throws InputError for a wrong schema, uneven time steps, an unknown body
  RunBody(const std::filesystem::path& run, const std::string& body);

  const std::string& name() const { return name_; }
  const std::filesystem::path& path() const { return file_.path(); }
  const RunClock& clock() const { return clock_; }
  const std::filesystem::path& rom_path() const { return rom_path_; }
  /// The hash of the reduced model that the run used.
  const std::string& rom_sha256() const { return rom_sha256_; }

  /// Reads the reduced model beside the run, checks its hash and its size. Of the skin, T stays
  /// empty: skin_rows() has it.
  rom::ReducedModel read_model() const;

  /// The recovery rows of the reduced model's skin, on disk when they are large.
  rom::SkinRows skin_rows() const { return rom::SkinRows(rom_path_); }

  /// False for a run that was interrupted inside its last cycle.
  bool complete() const;

  /// Samples [first, first + count) of "q" [m], "v" [m/s] or "a" [m/s2]: count x r.
  RowMatrix samples(const std::string& quantity, int64_t first, int64_t count) const;

 private:
  void pick_body(const std::string& requested);
  void check_shapes() const;
  std::string dataset(const std::string& member) const {
    return run::path(run::path(run::kBodies, name_), member);
  }

  H5File file_;
  std::string name_, rom_sha256_;
  std::filesystem::path rom_path_;
  RunClock clock_;
};

}  // namespace clatter::recover
