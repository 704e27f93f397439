#pragma once
// All that a run needs to go on from the end of a cycle.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/integrate/dirk.hpp"
#include "dynamics/integrate/statistics.hpp"
#include "dynamics/scene.hpp"

namespace clatter::dynamics {

/// Every cycle begins from one of these with elements built anew, whether the run was interrupted
/// or not: so both give the same bits.
struct Checkpoint {
  int cycle = 0;  // cycles that are done
  StageState state;
  int rung = 0;
  std::vector<std::vector<double>> elements;  // internal states, per element
  std::vector<double> energy;                 // EnergyBalance::save()
  RowMatrix eta, v;  // uniform samples of the cycle before, for periodicity
  StepStatistics statistics;
};

/// Text that must agree between a checkpoint and the run that resumes from it: the program itself,
/// configuration and hashes of all inputs.
std::string fingerprint(const Scene& scene);

std::filesystem::path checkpoint_path(const std::filesystem::path& output);
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& point,
                      const std::string& fingerprint);
/// Nothing when there is no such file or it belongs to another scene, other inputs or another
/// program; InputError when it cannot be read.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path,
                                          const std::string& fingerprint);

}  // namespace clatter::dynamics
