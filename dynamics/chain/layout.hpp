// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where a chain is assembled.
#include <vector>

#include "dynamics/chain/chain_spec.hpp"

namespace clatter::dynamics {

/// A pin in a tooth gap; gap 0 is the one that a layout names, others follow counter-clockwise.
struct SeatedPin {
  int pin = 0, gap = 0;
};

/// A chain on its sprockets before it is in equilibrium: its pins are on the taut belt around pitch
/// circles and guides, on sprockets at the pitch of their teeth, elsewhere with the pitches all
/// stretched or compressed alike.
struct ChainLayout {
  Belt belt;
  std::vector<Eigen::Vector2d> pins;   // n: the rear pin of each link, its place [m]
  std::vector<Eigen::Vector2d> along;  // n: unit vectors in running direction there
  std::vector<double> gaps;            // per over: polar angle of a tooth gap [rad]; guides: 0
  std::vector<SeatedPin> seated;       // per over: in the middle of a sprocket's wrap
  double stretch = 0.0;                // of the belt over the chain's length, minus 1
};

/// The first sprocket has a tooth gap at its `gap`, or in the middle of its wrap; the rear pin of
/// link 0 is in that gap, or in the one nearest to it that is wrapped. The others have a gap at the
/// pin nearest to the middle of their wraps, if they name none. InputError naming the chain where
/// its parts overlap and where its length, from that without play to that at the end of the play of
/// all joints, differs from the belt's by more than 3 %.
ChainLayout lay_out(const ChainSpec& chain);

/// "between crank and arm", "on intake": where a link is on its belt.
std::string place_on_belt(const ChainSpec& chain, const ChainLayout& layout, int link);

}  // namespace clatter::dynamics
