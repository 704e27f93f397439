// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/write_artefact.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/log.hpp"
#include "core/base/whole_file.hpp"

namespace clatter {

void write_artefact(const std::filesystem::path& output, const Provenance& provenance,
                    const StepClock& clock, const CommonOptions& common,
                    const std::function<void(H5File&)>& content) {
  H5File file = H5File::create(output);
  content(file);
  finish_artefact(file, output, provenance, clock, common);
}

void finish_artefact(H5File& file, const std::filesystem::path& output,
                     const Provenance& provenance, const StepClock& clock,
                     const CommonOptions& common) {
  write_provenance(file, provenance);
  write_timing(file, clock);
  file.commit(output);
  write_depfile(common.depfile, output, provenance.inputs);
}

void print_json_result(const std::filesystem::path& output, const JsonMembers& members,
                       const StepClock& clock, const CommonOptions& common) {
  if (!common.json) return;
  JsonMembers all = {{"output", json_text(output.string())}};
  all.insert(all.end(), members.begin(), members.end());
  all.emplace_back("seconds", json_number(clock.total_seconds()));
  print_json(all);
}

void finish_exports(const ExportedFiles& exported, const CommonOptions& common) {
  std::vector<std::string> files;
  for (const auto& file : exported.files) files.push_back(json_text(file.string()));
  print_result(fmt::format("{} to {}", exported.what, fmt::join(files, ", ")));
  write_depfile(common.depfile, exported.target, exported.inputs);
  if (common.json) print_json({{"files", fmt::format("[{}]", fmt::join(files, ", "))}});
}

void write_depfile(const std::filesystem::path& depfile, const std::filesystem::path& target,
                   const std::vector<std::filesystem::path>& inputs) {
  if (depfile.empty()) return;
  WholeFile file(depfile);
  std::ostream& stream = file.stream();
  stream << target.string() << ":";
  for (const auto& input : inputs) stream << " " << input.string();
  stream << "\n";
  // A deleted input must not stop make: each is also a target without a recipe.
  for (const auto& input : inputs) stream << input.string() << ":\n";
  file.commit();
}

}  // namespace clatter
