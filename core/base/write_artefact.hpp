// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How every program finishes its outputs: provenance, timing, the final name, make's dependencies
// and the line of --json.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/artefact.hpp"
#include "core/base/command_line.hpp"
#include "core/base/json_line.hpp"

namespace clatter {

/// Writes an artefact: what `content` writes, `provenance` and the steps of `clock`, in a file that
/// gets its name when it is complete and after the dependency file of `common`. An exception of
/// `content` leaves an older artefact unchanged. FileError when a file cannot be written; the
/// artefact is there when only the dependency file cannot, or what `companions` writes: files that
/// belong to the artefact. They are written when it is safe on the disk and before it gets its
/// name, which make takes for all of them.
void write_artefact(
    const std::filesystem::path& output, const Provenance& provenance, const StepClock& clock,
    const CommonOptions& common, const std::function<void(H5File&)>& content,
    const std::function<void()>& companions = [] {});

/// Finishes an artefact that was written during the work: adds `provenance` and the steps of
/// `clock`, writes the dependency file, then gives it its name `output` (in the folder in which it
/// was created). FileError as above.
void finish_artefact(
    H5File& file, const std::filesystem::path& output, const Provenance& provenance,
    const StepClock& clock, const CommonOptions& common,
    const std::function<void()>& companions = [] {});

/// The results of a stage for --json, in one line: {"output": ..., `members`, "seconds": ...};
/// no effect without --json.
void print_json_result(const std::filesystem::path& output, const JsonMembers& members,
                       const StepClock& clock, const CommonOptions& common);

/// Files in formats of other programs, and what they were made from.
struct ExportedFiles {
  std::filesystem::path target;               // as requested, for make
  std::vector<std::filesystem::path> files;   // written; a format may have several
  std::vector<std::filesystem::path> inputs;  // read
};

/// Does what a command that only exports does: the dependency file, the files by `write`, which
/// returns what they are for the user ("block: 395 coordinates"), the line "what to files", and
/// with
/// --json {"files": [...]}. FileError as above.
void write_exports(const ExportedFiles& exported, const CommonOptions& common,
                   const std::function<std::string()>& write);

/// Writes "target: input input ..." for make. No effect when `depfile` is empty.
void write_depfile(const std::filesystem::path& depfile, const std::filesystem::path& target,
                   const std::vector<std::filesystem::path>& inputs);

}  // namespace clatter
