// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/run_summary.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/planned_files.hpp"
#include "dynamics/run/run_file.hpp"

namespace clatter::dynamics {
namespace {

constexpr const char *kFailed = ".failed.h5", *kInterrupted = ".interrupted.h5",
                     *kRefused = ".refused.h5";

std::filesystem::path beside(const std::filesystem::path& output, const char* ending) {
  return std::filesystem::path(output).replace_extension(ending);
}

}  // namespace

void plan_run_files(const std::filesystem::path& output) {
  will_write("--output", checkpoint_path(output));
  for (const char* ending : {kFailed, kInterrupted, kRefused})
    will_write("--output", beside(output, ending));
}

bool is_finished(const RunResult& result) {
  return result.failure.empty() && result.complete &&
         !any_refused(judged_numbers(run_certificate(result)));
}

std::filesystem::path written_file(const std::filesystem::path& output, const RunResult& result) {
  if (!result.failure.empty()) return beside(output, kFailed);
  if (!result.complete) return beside(output, kInterrupted);
  return is_finished(result) ? output : beside(output, kRefused);
}

void require_finished(const RunResult& result, const std::filesystem::path& output) {
  const std::string written = written_file(output, result).string();
  if (!result.failure.empty())
    throw NumericsError(
        fmt::format("{}; the results up to there are in {}", result.failure, written));
  if (!result.complete)
    throw NumericsError(fmt::format(
        "{}: interrupted after {} complete cycles, the results so far are in {}; continue "
        "with --resume",
        output.string(), result.cycles, written));
  require_trust(written, judged_numbers(run_certificate(result)));
}

void remove_unfinished(const std::filesystem::path& output) {
  std::filesystem::remove(checkpoint_path(output));
  std::filesystem::remove(checkpoint_path(output).string() + ".part");  // of a killed run
  for (const char* ending : {kInterrupted, kRefused})
    std::filesystem::remove(beside(output, ending));
}

std::vector<std::string> effect_rows(const EffectTable& effects, bool with_cost, Reader reader) {
  std::vector<std::string> lines = effects.lines(with_cost);
  if (reader == Reader::kFile) return lines;
  std::vector<std::string> on;
  for (size_t row = 0; row < lines.size(); ++row)
    if (effects.effects()[row].on) on.push_back(std::move(lines[row]));
  if (const size_t off = lines.size() - on.size(); off > 0)
    on.push_back(fmt::format("  {} effect{} off (--effects lists {})", off, off == 1 ? "" : "s",
                             off == 1 ? "it" : "them"));
  return on;
}

std::vector<std::string> describe(const RunResult& result, double seconds, Reader reader) {
  std::vector<std::string> lines{"effects (seconds of their elements):"};
  for (std::string& row : effect_rows(result.model->effects, true, reader))
    lines.push_back(std::move(row));
  const StepStatistics& s = result.statistics;
  lines.push_back(fmt::format(
      "steps: {} accepted, {} rejected by error, {} by Newton, {} refused; {:.3g} to {:.3g} "
      "s; {} evaluations, {} factorisations",
      s.accepted, s.rejected_error, s.rejected_newton, s.rejected_refused, s.smallest_step,
      s.largest_step, s.evaluations, s.factorizations));
  for (const auto& [kind, refusals] : s.refusals)
    lines.push_back(
        fmt::format("  refused {}x: {} (last: {})", refusals.count, kind, refusals.last));
  lines.push_back(fmt::format(
      "seconds: {:.2f} stepping, of which elements {:.2f}, factorisations {:.2f}, operators "
      "{:.2f}; {:.2f} in total",
      s.total_seconds, s.element_seconds, s.factor_seconds, s.operator_seconds, seconds));
  for (const std::string& text : periodicity_lines(result.periodicity)) lines.push_back(text);
  lines.push_back(fmt::format("energy residue: {:.2e}, {:.2g} J of {:.4g} J exchanged",
                              result.energy_residue, result.energy_imbalance,
                              result.energy_exchanged));
  return lines;
}

JsonMembers json_of(const RunResult& result) {
  return {{"steps", json_number(static_cast<double>(result.statistics.accepted))},
          {"energy_residue", json_number(result.energy_residue)}};
}

}  // namespace clatter::dynamics
