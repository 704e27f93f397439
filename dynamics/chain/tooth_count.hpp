// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Jumps of a chain on a sprocket.
#include <vector>

#include "dynamics/chain/belt.hpp"

namespace clatter::dynamics {

/// By how many teeth a chain has jumped on a sprocket. Neighbouring links lie in neighbouring gaps,
/// so the gap of a link less its place along the chain is the same for all links on the sprocket
/// and for ever, until the chain jumps.
class ToothCount {
 public:
  /// @param links of the closed chain. @param turn of the chain around the sprocket.
  ToothCount(int links, int teeth, Turn turn);

  /// Gaps as they are at `time` [s], counted counter-clockwise; negative for links that touch none.
  void update(double time, const std::vector<int>& gap_of_link);

  /// Teeth by which the chain is ahead of where it began, in its running direction.
  int ahead() const { return ahead_; }
  /// Teeth jumped, forwards and backwards: counted as soon as all links on the sprocket have.
  int jumped() const { return jumped_; }
  /// A link has been found in another gap than its neighbours.
  bool has_jumped() const { return first_ >= 0.0; }
  /// When the first one was [s].
  double first_time() const { return first_; }

  std::vector<double> save() const;
  void restore(const std::vector<double>& state);

 private:
  int links_, teeth_, turn_;
  bool begun_ = false;
  int base_ = 0;   // gap less place at the begin, modulo the teeth
  int place_ = 0;  // of a link that was on the sprocket last; counted on beyond a loop of the chain
  int ahead_ = 0, jumped_ = 0;
  double first_ = -1.0;
};

}  // namespace clatter::dynamics
