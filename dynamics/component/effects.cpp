// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/effects.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clatter::dynamics {

Effect& EffectTable::add(const EffectEntry* entry, bool on, const std::string& why,
                         const std::string& element) {
  return add(entry, std::string(entry->name), on, why, element);
}

Effect& EffectTable::add(const EffectEntry* entry, const std::string& name, bool on,
                         const std::string& why, const std::string& element) {
  return effects_.emplace_back(Effect{entry, name, on, why, element});
}

bool EffectTable::charge(const std::string& element, double seconds, int64_t evaluations) {
  for (auto& effect : effects_) {
    if (effect.on && (effect.element == element ||
                      (!effect.element.empty() && element.starts_with(effect.element + " ")))) {
      effect.seconds += seconds;
      effect.evaluations += evaluations;
      return true;
    }
  }
  return false;
}

std::vector<std::string> EffectTable::lines(bool with_cost) const {
  std::vector<std::string> lines;
  size_t width = 28;
  for (const auto& effect : effects_) width = std::max(width, effect.name.size());
  for (const auto& effect : effects_) {
    const std::string cost = !with_cost               ? ""
                             : effect.element.empty() ? "         -"
                                                      : fmt::format("{:8.2f} s", effect.seconds);
    lines.push_back(fmt::format("  {:<{}} {:<4}{}  {}", effect.name, width,
                                effect.on ? "on" : "off", cost, effect.why));
  }
  return lines;
}

void EffectTable::write(H5File& file) const {
  std::vector<std::string> names, states, reasons;
  std::vector<double> seconds;
  for (const auto& effect : effects_) {
    names.push_back(effect.name);
    states.push_back(effect.on ? "on" : "off");
    reasons.push_back(effect.why);
    seconds.push_back(effect.seconds);
  }
  file.write("effects/name", names);
  file.write("effects/state", states);
  file.write("effects/why", reasons);
  file.write("effects/seconds", seconds);
}

}  // namespace clatter::dynamics
