// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Jumps of a chain on a sprocket.
#include <vector>

#include "dynamics/chain/belt.hpp"

namespace clatter::dynamics {

/// By how many teeth a chain has jumped on a sprocket. Neighbouring pins lie in neighbouring gaps,
/// so the gap of a pin less its place along the chain is the same for all pins on the sprocket and
/// for ever, until the chain jumps. Links are counted by their rear pins.
class ToothCount {
 public:
  /// Of what has no teeth.
  ToothCount() = default;
  /// @param links of the closed chain. @param turn of the chain around the sprocket. @param link
  /// one whose rear pin is in the gap `gap` at the start; gaps are counted counter-clockwise.
  ToothCount(int links, int teeth, Turn turn, int link, int gap);

  /// Gaps of the links' rear pins at `time` [s]; negative for links that do not touch.
  void update(double time, const std::vector<int>& gap_of_link);

  /// Teeth by which the chain is ahead of where it began, in its running direction.
  int ahead() const { return ahead_; }
  /// Teeth jumped, forwards and backwards: counted as soon as all links on the sprocket have.
  int jumped() const { return jumped_; }
  /// When a link was in another gap for the first time before they all were [s].
  double first_time() const { return first_; }
  int turn() const { return turn_; }

  std::vector<double> save() const;
  void restore(const std::vector<double>& state);

 private:
  int links_ = 0, teeth_ = 1, turn_ = 1;
  int base_ = 0;   // gap less place at the start
  int place_ = 0;  // of a link that was on the sprocket last; counted on beyond a loop of the chain
  int ahead_ = 0, jumped_ = 0;
  double since_ = -1.0;  // a link is in another gap [s]; negative: none is
  double first_ = -1.0;
};

}  // namespace clatter::dynamics
