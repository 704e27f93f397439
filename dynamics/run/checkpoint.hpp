// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The data that a run needs to resume.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"
#include "dynamics/integrate/integrator.hpp"
#include "dynamics/integrate/statistics.hpp"
#include "dynamics/run/uniform_samples.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

/// Every cycle before the recorded ones, and the first of these, starts from a checkpoint with
/// newly built elements, whether the run was interrupted or not: so both give identical results.
/// Without cycles a run begins again, as from a checkpoint, after each kStepsBetween steps, and
/// writes the checkpoint when enough time has passed since the last one.
struct Checkpoint {
  int cycle = 0;  // completed cycles
  StageState state;
  int rung = 0;
  std::vector<std::vector<double>> elements;  // internal states, per element
  std::vector<double> energy;                 // EnergyBalance::save()
  /// Within what is recorded: an Archive of what its run file, in the checkpoint, does not have.
  std::vector<double> recorded;
  StepStatistics statistics;
};

/// Accepted steps after which a run without cycles may have a checkpoint. They do not depend on the
/// computer, so neither do results; the next step has a new Newton matrix, a small part of so many.
inline constexpr long long kStepsBetween = 500;

/// Datasets of a checkpoint with the uniform samples of the cycle that it ends, for the periodicity
/// of the next one: eta and its velocity, n_t x modes.
inline constexpr const char *kCycleEta = "cycle/eta", *kCycleVelocity = "cycle/v";

/// Group of a checkpoint within what is recorded: the run file so far.
inline constexpr const char* kRunSoFar = "run";

/// Text that must agree between a checkpoint and the run that resumes from it: the hashes of the
/// program and of all inputs, and the configuration.
std::string fingerprint(const Scene& scene);

std::filesystem::path checkpoint_path(const std::filesystem::path& output);

/// A checkpoint that is being written. At the end of a running cycle its samples are written as
/// they are taken, within what is recorded it has a copy of the run file; then the file replaces
/// the checkpoint before it.
class CheckpointFile {
 public:
  explicit CheckpointFile(const std::filesystem::path& path) : file_(H5File::create(path)) {}
  /// The next block of samples.
  void add(const SampleBlock& block);
  /// What was recorded so far.
  void copy(const H5File& run) { file_.copy(run, "/", kRunSoFar); }
  /// The samples of a cycle after which there is no checkpoint; the file gets no name.
  H5File take_samples() { return std::move(file_); }
  /// Adds the state and gives the file its name.
  void commit(const Checkpoint& point, const std::string& fingerprint);

 private:
  H5File file_;
};

/// Empty when there is no such file or it belongs to another scene, other inputs or another
/// program; InputError when it cannot be read, as of from_checkpoint().
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path,
                                          const std::string& fingerprint);

/// The InputError of a damaged checkpoint: what is wrong with it, and what to delete.
InputError damaged_checkpoint(const std::filesystem::path& path, const std::string& what);

/// Runs `body`, which uses the content of the checkpoint at `path`: its InputError becomes that of
/// a damaged checkpoint.
template <class Body>
auto from_checkpoint(const std::filesystem::path& path, const Body& body) {
  try {
    return body();
  } catch (const InputError& error) {
    throw damaged_checkpoint(path, error.what());
  }
}

}  // namespace clatter::dynamics
