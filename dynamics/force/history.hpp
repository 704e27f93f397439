// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Named scalars of one instant, reported by elements and bodies.
#include <string>
#include <vector>

namespace clatter::dynamics {

/// Collects (name, unit, value) of one instant. Every instant of a run must have the same names in
/// the same order; the run file stores them as `history/<name>` with attribute `unit`.
class History {
 public:
  struct Entry {
    std::string name;
    std::string unit;  // SI, "m", "N", "rad"; "1" for a pure number
    double value;
  };

  void put(const std::string& name, const std::string& unit, double value) {
    entries_.push_back({name, unit, value});
  }
  const std::vector<Entry>& entries() const { return entries_; }
  void clear() { entries_.clear(); }

 private:
  std::vector<Entry> entries_;
};

}  // namespace clatter::dynamics
