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
    if (next_ == entries_.size()) entries_.emplace_back();
    Entry& entry = entries_[next_++];
    if (!is_named(entry, name)) entry = {prefix_ + name, unit, value};
    entry.value = value;
  }
  /// Begins the names of what is put from now on: those of one of several cylinders.
  void set_prefix(const std::string& prefix) { prefix_ = prefix; }
  const std::vector<Entry>& entries() const { return entries_; }
  /// Begins the next instant, whose names are the same: they keep their memory.
  void clear() { next_ = 0; }

 private:
  bool is_named(const Entry& entry, const std::string& name) const {
    return entry.name.size() == prefix_.size() + name.size() && entry.name.starts_with(prefix_) &&
           entry.name.ends_with(name);
  }
  std::vector<Entry> entries_;
  std::string prefix_;
  size_t next_ = 0;  // entry of the next put
};

}  // namespace clatter::dynamics
