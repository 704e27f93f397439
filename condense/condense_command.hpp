// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-condense part.fe.h5 -c part.rom.toml -o part.rom.h5
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "condense/condense.hpp"
#include "core/base/command_line.hpp"

namespace clatter::condense {

/// Where a program gets the part from: by default a file that this process reads alone.
struct PartSource {
  /// None where another process reduces the part alone.
  std::function<std::optional<fe::FeModel>(const std::filesystem::path& path,
                                           const CommonOptions& common)>
      read = [](const std::filesystem::path& path, const CommonOptions&) {
        fe::FeModel model = fe::read_fe_model(path);
        fe::require_unknowns(model, "a reduction");
        return model;
      };
  /// @param model from read(); must outlive the result.
  std::function<std::unique_ptr<const PartitionedModel>(
      const std::filesystem::path& path, const fe::FeModel& model, const CondenseOptions& options)>
      partition = [](const std::filesystem::path&, const fe::FeModel& model,
                     const CondenseOptions& options) {
        return std::make_unique<LocalPart>(model, options.boundary, options.order);
      };
  std::string memory_advice =
      "or share the part among processes: mpirun -n 4 clatter-condense-mpi (docs/cluster.md)";
  bool writes = true;  // this process prints the results and writes the file
};

/// Declares what the program does without a command: the reduction of an assembled part.
void declare_condense(CommandLine& program, const PartSource& source = {});

}  // namespace clatter::condense
