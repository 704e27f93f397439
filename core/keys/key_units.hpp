// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The unit of a key, which is the end of its name: `bore_mm`, `spring_rate_n_m`, `temperature_c`.
#include <string>
#include <string_view>

namespace clatter::keys {

/// What a number of a key means: SI value = number * scale + offset.
struct KeyUnit {
  std::string shown;     // "mm", "N/m"; "" for a number without one
  double scale = 1.0;    // SI per unit
  double offset = 0.0;   // in SI: of degrees Celsius
  bool of_file = false;  // a length in the unit that the file chooses, Config::metre()
};

/// The unit in which a name ends, the longest that fits: N/m for `rate_n_m`, m for `reach_m`.
KeyUnit unit_of(std::string_view name);

}  // namespace clatter::keys
