// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The table of effects: which are simulated, why, and their cost.
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "dynamics/component/effect_entry.hpp"

namespace clatter::dynamics {

/// One physical effect of a scene.
struct Effect {
  const EffectEntry* entry;  // in the catalogue
  std::string name;          // that of the entry, or with those of its component
  bool on = false;
  std::string why;      // the key that decides, or the reason
  std::string element;  // whose seconds are counted here, also of "element 1", ...; empty: none
  double seconds = 0.0;
  int64_t unknowns = 0;     // coordinates and cells of films that it adds
  int64_t evaluations = 0;  // of all its elements
};

class EffectTable {
 public:
  /// Adds a row, here under the entry's name. The result is valid until the next one.
  Effect& add(const EffectEntry* entry, bool on, const std::string& why,
              const std::string& element = "");
  Effect& add(const EffectEntry* entry, const std::string& name, bool on, const std::string& why,
              const std::string& element = "");
  /// Adds seconds and evaluations of an element to its effect. @return false: no row is its own
  bool charge(const std::string& element, double seconds, int64_t evaluations = 0);
  /// Seconds of a row, in place of what was charged.
  void set_seconds(size_t row, double seconds) { effects_[row].seconds = seconds; }
  const std::vector<Effect>& effects() const { return effects_; }
  /// The table as lines of text.
  std::vector<std::string> lines(bool with_cost) const;
  /// Group `effects`: name, state ("on", "off"), why, seconds.
  void write(H5File& file) const;

 private:
  std::vector<Effect> effects_;
};

}  // namespace clatter::dynamics
