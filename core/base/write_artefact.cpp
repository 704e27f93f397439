// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/write_artefact.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <string_view>

#include "core/base/changed_inputs.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/whole_file.hpp"

namespace clatter {
namespace {

/// An artefact of content that an input no longer has gets a time before that of the input, so that
/// make remakes it (hard case P5).
void date_before_changed_inputs(const std::filesystem::path& output,
                                const std::vector<std::filesystem::path>& inputs) {
  std::error_code ignored;
  auto date = std::filesystem::last_write_time(output, ignored);
  for (const auto& input : inputs) {
    if (!changed_since_planned(input)) continue;
    warn(fmt::format("{} changed while it was in use: {} is of its older content, make remakes it",
                     input.string(), output.string()));
    const auto changed = std::filesystem::last_write_time(input, ignored);
    if (!ignored) date = std::min(date, changed - std::chrono::seconds(1));
    std::filesystem::last_write_time(output, date, ignored);
  }
}

/// A path as a prerequisite in a makefile, or as a target: signs with a meaning there are quoted.
std::string make_word(const std::filesystem::path& path, bool target) {
  std::string word;
  for (const char sign : path.string()) {
    if (sign == '\n')
      throw InputError(fmt::format("--depfile: found a line end in {}, which no make rule can name",
                                   json_text(path.string())));
    if (sign == '$') word += '$';
    if (std::string_view(target ? " \t#:%" : " \t#:").find(sign) != std::string_view::npos)
      word += '\\';
    word += sign;
  }
  return word;
}

/// Does `before`, then `finish`: a process that is killed between the two must not leave files that
/// make takes for complete (hard case P2). A failure of `before` must not cost them: its error
/// comes after `finish`.
void finish_after(const std::function<void()>& before, const std::function<void()>& finish) {
  std::exception_ptr failure;
  try {
    before();
  } catch (...) {
    failure = std::current_exception();
  }
  finish();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace

void write_artefact(const std::filesystem::path& output, const Provenance& provenance,
                    const StepClock& clock, const CommonOptions& common,
                    const std::function<void(H5File&)>& content,
                    const std::function<void()>& companions) {
  H5File file = H5File::create(output);
  content(file);
  finish_artefact(file, output, provenance, clock, common, companions);
}

void finish_artefact(H5File& file, const std::filesystem::path& output,
                     const Provenance& provenance, const StepClock& clock,
                     const CommonOptions& common, const std::function<void()>& companions) {
  write_provenance(file, provenance);
  write_timing(file, clock);
  file.complete();
  const auto before = [&] {
    write_depfile(common.depfile, output, provenance.inputs);
    companions();
  };
  finish_after(before, [&] {
    file.commit(output);
    date_before_changed_inputs(output, provenance.inputs);
  });
}

void print_json_result(const std::filesystem::path& output, const JsonMembers& members,
                       const StepClock& clock, const CommonOptions& common) {
  if (!common.json) return;
  JsonMembers all = {{"output", json_text(output.string())}};
  all.insert(all.end(), members.begin(), members.end());
  all.emplace_back("seconds", json_number(clock.total_seconds()));
  print_json(all);
}

void write_exports(const ExportedFiles& exported, const CommonOptions& common,
                   const std::function<std::string()>& write) {
  std::vector<std::string> files;
  for (const auto& file : exported.files) files.push_back(json_text(file.string()));
  finish_after([&] { write_depfile(common.depfile, exported.target, exported.inputs); },
               [&] {
                 const std::string what = write();
                 print_result(fmt::format("{} to {}", what, fmt::join(files, ", ")));
               });
  if (common.json) print_json({{"files", fmt::format("[{}]", fmt::join(files, ", "))}});
}

void write_depfile(const std::filesystem::path& depfile, const std::filesystem::path& target,
                   const std::vector<std::filesystem::path>& inputs) {
  if (depfile.empty()) return;
  WholeFile file(depfile);
  std::ostream& stream = file.stream();
  stream << make_word(target, true) << ":";
  for (const auto& input : inputs) stream << " " << make_word(input, false);
  stream << "\n";
  // A deleted input must not stop make: each is also a target without a recipe.
  for (const auto& input : inputs) stream << make_word(input, true) << ":\n";
  file.commit();
}

}  // namespace clatter
