// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How often, when and how far something was open that should be closed.
#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.hpp"

namespace clatter::dynamics {

class ContactWatch {
 public:
  /// At an accepted step: open or not, by how much [m], at what angle of the cam [rad].
  void look(double time, bool is_open, double gap, double angle) {
    if (is_open && !open_) {
      if (count_ == 0.0) {
        first_time_ = time;
        first_angle_ = angle;
      }
      count_ += 1.0;
    }
    open_ = is_open;
    if (is_open) largest_ = std::max(largest_, gap);
    last_ = is_open ? time : last_;
  }
  bool is_open() const { return open_; }
  int count() const { return static_cast<int>(count_); }
  double first_time() const { return first_time_; }    // [s]
  double first_angle() const { return first_angle_; }  // [rad]
  double last_time() const { return last_; }           // it was still open [s]
  double largest() const { return largest_; }          // [m]

  std::vector<double> save() const {
    return {open_ ? 1.0 : 0.0, count_, first_time_, first_angle_, last_, largest_};
  }
  void restore(const std::vector<double>& state, const std::string& name) {
    if (state.size() != 6) throw InputError(name + ": the saved state belongs to another scene");
    open_ = state[0] != 0.0;
    count_ = state[1];
    first_time_ = state[2];
    first_angle_ = state[3];
    last_ = state[4];
    largest_ = state[5];
  }

 private:
  bool open_ = false;
  double count_ = 0.0, first_time_ = 0.0, first_angle_ = 0.0, last_ = 0.0, largest_ = 0.0;
};

}  // namespace clatter::dynamics
