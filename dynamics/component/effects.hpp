// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The table of effects: which are simulated, why, and their cost.
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"

namespace clatter::dynamics {

/// One physical effect of a scene.
struct Effect {
  std::string name;
  bool on = false;
  std::string why;      // the key that decides, or the reason
  std::string element;  // whose seconds are counted here, also of "element 1", ...; empty: none
  double seconds = 0.0;
};

class EffectTable {
 public:
  void add(const std::string& name, bool on, const std::string& why,
           const std::string& element = "");
  /// Adds seconds of an element to its effect.
  void charge(const std::string& element, double seconds);
  const std::vector<Effect>& effects() const { return effects_; }
  /// The table as lines of text.
  std::vector<std::string> lines(bool with_cost) const;
  /// Group `effects`: name, state ("on", "off"), why, seconds.
  void write(H5File& file) const;

 private:
  std::vector<Effect> effects_;
};

}  // namespace clatter::dynamics
