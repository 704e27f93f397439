// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-condense part.fe.h5 -c part.rom.toml -o part.rom.h5
#include <filesystem>
#include <functional>

#include "condense/condense.hpp"
#include "core/base/command_line.hpp"

namespace clatter::condense {

/// How a program reads and reduces a part: by one process, or by several.
struct Reducer {
  /// @param verify_hz as --verify; not a number: no verification.
  std::function<rom::ReducedModel(const std::filesystem::path& model,
                                  const CondenseOptions& options, double verify_hz,
                                  const CommonOptions& common, StepClock& clock)>
      reduce;
  bool writes = true;  // this process prints the results and writes the file
};

/// By this process alone.
Reducer one_process_reducer();

/// Declares what the program does without a command: the reduction of an assembled part.
void declare_condense(CommandLine& program, const Reducer& reducer = one_process_reducer());

}  // namespace clatter::condense
