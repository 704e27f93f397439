// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The data that a run needs to resume at the end of a cycle.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/integrate/integrator.hpp"
#include "dynamics/integrate/statistics.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

/// Every cycle starts from a checkpoint with newly built elements, whether the run was interrupted
/// or not: so both give identical results.
struct Checkpoint {
  int cycle = 0;  // completed cycles
  StageState state;
  int rung = 0;
  std::vector<std::vector<double>> elements;  // internal states, per element
  std::vector<double> energy;                 // EnergyBalance::save()
  RowMatrix eta, v;  // uniform samples of the cycle before, for periodicity
  StepStatistics statistics;
};

/// Text that must agree between a checkpoint and the run that resumes from it: the hashes of the
/// program and of all inputs, and the configuration.
std::string fingerprint(const Scene& scene);

std::filesystem::path checkpoint_path(const std::filesystem::path& output);
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& point,
                      const std::string& fingerprint);
/// Empty when there is no such file or it belongs to another scene, other inputs or another
/// program; InputError when it cannot be read.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path,
                                          const std::string& fingerprint);

}  // namespace clatter::dynamics
