// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/effect_report.hpp"

#include <fmt/format.h>

#include <limits>

namespace clatter::dynamics {
namespace {

constexpr size_t kWidth = 120, kDetail = 6;

void append(std::vector<std::string>& lines, const std::string& text, size_t indent) {
  for (const std::string& line : wrapped(text, kWidth, indent)) lines.push_back(line);
}

/// "1280 unknowns, 44275 evaluations, 29.4 s (78 %)".
std::string cost_text(const Effect& effect, double total) {
  if (!effect.on)
    return effect.entry->measured.empty()
               ? "cost not known: off"
               : fmt::format("off; where on: {}", effect.entry->measured);
  std::string text;
  if (effect.unknowns > 0) text = fmt::format("{} unknowns, ", effect.unknowns);
  if (effect.element.empty()) return text + (text.empty() ? "not counted alone" : "in the steps");
  return text + fmt::format("{} evaluations, {:.3g} s ({:.0f} %)", effect.evaluations,
                            effect.seconds, 100.0 * effect.seconds / total);
}

std::string number_or_null(bool known, double value) {
  return json_number(known ? value : std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

std::vector<std::string> wrapped(const std::string& text, size_t width, size_t indent) {
  std::vector<std::string> lines;
  std::string rest = text;
  while (rest.size() > width) {
    const size_t word = rest.find_first_not_of(' ');
    size_t cut = rest.rfind(' ', width);
    if (cut == std::string::npos || cut < word) cut = rest.find(' ', word);
    if (cut == std::string::npos) break;
    lines.push_back(rest.substr(0, cut));
    rest = std::string(indent, ' ') + rest.substr(cut + 1);
  }
  lines.push_back(rest);
  return lines;
}

std::vector<std::string> effect_lines(const RunForecast& forecast) {
  const StepStatistics& s = forecast.statistics;
  std::vector<std::string> lines;
  for (const Effect& effect : forecast.effects.effects()) {
    const EffectEntry& entry = *effect.entry;
    append(lines,
           fmt::format("{:<4}{}: {}", effect.on ? "on" : "off", effect.name,
                       cost_text(effect, s.total_seconds)),
           kDetail);
    append(lines, "    " + effect.why, kDetail);
    append(lines, fmt::format("    equation: {}", entry.equation), kDetail);
    append(lines, fmt::format("    needs: {}; switch: {}", entry.needs, entry.key), kDetail);
  }
  const double rest = s.total_seconds - s.element_seconds - s.factor_seconds - s.operator_seconds;
  lines.emplace_back("");
  lines.push_back(fmt::format("run: {} steps, {} rejected, {} evaluations, {} factorisations",
                              s.accepted, s.rejected_error + s.rejected_newton + s.rejected_refused,
                              s.evaluations, s.factorizations));
  lines.push_back(fmt::format(
      "     {:.3g} s of stepping: elements {:.3g} s ({:.2g} s of them of no effect alone), "
      "factorisations {:.3g} s,",
      s.total_seconds, s.element_seconds, forecast.other_seconds, s.factor_seconds));
  lines.push_back(
      fmt::format("     operators {:.3g} s, modes and iterations {:.3g} s; recording and writing "
                  "are not counted",
                  s.operator_seconds, rest));
  if (forecast.processor_seconds > 0.0)
    lines.push_back(
        fmt::format("     {:.3g} s of the processor, of all threads", forecast.processor_seconds));
  append(lines, "predicted by " + forecast.source, 5);
  return lines;
}

JsonMembers effects_json(const RunForecast& forecast) {
  std::string rows;
  for (const Effect& effect : forecast.effects.effects()) {
    const EffectEntry& entry = *effect.entry;
    const bool counted = effect.on && !effect.element.empty();
    const auto text = [](std::string_view view) { return json_text(std::string(view)); };
    rows += (rows.empty() ? "" : ", ") +
            json_object(
                {{"name", json_text(effect.name)},
                 {"state", json_text(effect.on ? "on" : "off")},
                 {"why", json_text(effect.why)},
                 {"entry", text(entry.name)},
                 {"equation", text(entry.equation)},
                 {"needs", text(entry.needs)},
                 {"switch", text(entry.key)},
                 {"measured", text(entry.measured)},
                 {"unknowns", json_number(static_cast<double>(effect.unknowns))},
                 {"evaluations", number_or_null(counted, static_cast<double>(effect.evaluations))},
                 {"seconds", number_or_null(counted, effect.seconds)}});
  }
  const StepStatistics& s = forecast.statistics;
  return {{"effects", "[" + rows + "]"},
          {"steps", json_number(static_cast<double>(s.accepted))},
          {"evaluations", json_number(static_cast<double>(s.evaluations))},
          {"seconds", json_number(s.total_seconds)},
          {"processor_seconds",
           number_or_null(forecast.processor_seconds > 0.0, forecast.processor_seconds)},
          {"element_seconds", json_number(s.element_seconds)},
          {"source", json_text(forecast.source)}};
}

}  // namespace clatter::dynamics
