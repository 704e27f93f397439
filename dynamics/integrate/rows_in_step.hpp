// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The rows of a table within one step.
#include <algorithm>

namespace clatter::dynamics {

/// The rows of a table within a step, its ends excluded. `Table`: a force over time, value(t), and
/// when its rows are, next_row(t).
template <class Table>
class RowsInStep {
 public:
  RowsInStep(const Table& table, double begin, double end)
      : table_(table), begin_(begin), end_(end) {
    double row = begin;
    while (count_ < kHiddenRows && (row = table.next_row(row)) < end) ++count_;
  }
  /// Whether they enclose an interval of which perhaps no stage sees anything.
  bool hide_something() const { return count_ >= kHiddenRows; }
  /// Of the force over the step, by Simpson's rule from row to row: exact for linear and cubic
  /// tables over time.
  double integral() const {
    double sum = 0.0, from = begin_, value = table_.value(begin_);
    while (from < end_) {
      const double to = std::min(table_.next_row(from), end_), next = table_.value(to);
      sum += (to - from) / 6.0 * (value + 4.0 * table_.value(0.5 * (from + to)) + next);
      from = to;
      value = next;
    }
    return sum;
  }

 private:
  static constexpr int kHiddenRows = 2;
  const Table& table_;
  double begin_, end_;
  int count_ = 0;
};

}  // namespace clatter::dynamics
