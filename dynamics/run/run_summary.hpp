// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The end of a run: its files, complete or not, and what the user reads.
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/json_line.hpp"
#include "dynamics/component/effects.hpp"
#include "dynamics/run/simulate.hpp"

namespace clatter::dynamics {

/// Registers the files that a run may leave beside its output (core/base/planned_files.hpp):
/// checkpoint, stem.run.failed.h5, stem.run.interrupted.h5, stem.run.refused.h5.
void plan_run_files(const std::filesystem::path& output);

/// Whether the run reached its end and its certificate is not refused.
bool is_finished(const RunResult& result);

/// The path of the results: only a finished run gets the requested name, which make and recover
/// treat as finished.
std::filesystem::path written_file(const std::filesystem::path& output, const RunResult& result);

/// NumericsError when the run failed, was interrupted or has a certificate that is refused, with
/// the path of the results; warnings of numbers that are not good.
void require_finished(const RunResult& result, const std::filesystem::path& output);

/// Removes the checkpoint and the files of runs that were interrupted or refused, after a finished
/// one.
void remove_unfinished(const std::filesystem::path& output);

/// Who reads the lines: of a terminal's effects those that are off are one line.
enum class Reader { kFile, kTerminal };

/// The effects of a scene as lines of text, with or without the seconds of their elements.
std::vector<std::string> effect_rows(const EffectTable& effects, bool with_cost, Reader reader);

/// Summary lines for the user: effects, steps, seconds, periodicity, energy residue.
/// @param seconds of the entire program
std::vector<std::string> describe(const RunResult& result, double seconds,
                                  Reader reader = Reader::kFile);

/// For --json: steps, energy_residue.
JsonMembers json_of(const RunResult& result);

}  // namespace clatter::dynamics
