// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-modal part.fe.h5 -o part.modes.h5
#include <filesystem>
#include <functional>

#include "core/base/command_line.hpp"
#include "core/base/stopwatch.hpp"
#include "core/modes/analysis.hpp"

namespace clatter::modal {

/// How a program reads an assembled part and computes its modes: by one process, or by several.
struct ModeFinder {
  std::function<void(const CommonOptions& common)> begin = [](const CommonOptions&) {};
  /// @param model receives what was read; the modes refer to it.
  std::function<modes::PartModes(const std::filesystem::path& path,
                                 const modes::ModesOptions& options, fe::FeModel& model,
                                 StepClock& clock)>
      of_fe_model;
  bool writes = true;  // this process prints the results and writes the file
};

/// By this process alone.
ModeFinder one_process_finder();

/// Declares what the program does without a command: modes of an assembled or reduced part, with a
/// proof that none is missing.
void declare_modes(CommandLine& program, const ModeFinder& finder = one_process_finder());

}  // namespace clatter::modal
