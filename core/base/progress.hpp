// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Progress of work that takes over two seconds: a bar on a terminal, plain lines elsewhere.
#include <cstdint>
#include <string>

#include "core/base/stopwatch.hpp"

namespace clatter {

/// Silent for the first two seconds, then shows rate and time left. Silent with --quiet.
class Progress {
 public:
  Progress(std::string label, double total, std::string unit = "");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// `done` of the total so far.
  void update(double done);

 private:
  std::string label_, unit_;
  double total_;
  double shown_at_ = 0.0;
  bool terminal_;
  bool shown_ = false;
  Stopwatch clock_;
};

}  // namespace clatter
