// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/chain/tooth_count.hpp"

#include <cmath>
#include <cstdlib>

namespace clatter::dynamics {
namespace {

/// Links that must agree: one alone may ride over the teeth while the chain is off the sprocket.
constexpr int kLeast = 2;

/// The number nearest to 0 that is `value` modulo `period`.
int nearest(int value, int period) {
  const int rest = ((value % period) + period) % period;
  return 2 * rest > period ? rest - period : rest;
}

}  // namespace

ToothCount::ToothCount(int links, int teeth, Turn turn, int link, int gap)
    : links_(links),
      teeth_(teeth),
      turn_(static_cast<int>(turn)),
      base_(turn_ * gap - link),
      place_(link) {}

void ToothCount::update(double time, const std::vector<int>& gap_of_link) {
  int touching = 0;
  bool agree = true;
  int found = ahead_;
  const int last = place_;
  for (int j = 0; j < links_; ++j) {
    const int gap = gap_of_link[j];
    if (gap < 0) continue;
    // The link's place on the loop of the chain that is nearest to the last one on the sprocket.
    place_ = last + nearest(j - last, links_);
    const int ahead = ahead_ + nearest(turn_ * gap - place_ - base_ - ahead_, teeth_);
    agree = agree && (touching == 0 || ahead == found);
    ++touching;
    found = ahead;
    if (ahead != ahead_ && since_ < 0.0) since_ = time;
  }
  if (!agree || touching < kLeast) return;
  if (found != ahead_ && first_ < 0.0) first_ = since_;
  since_ = -1.0;
  jumped_ += std::abs(found - ahead_);
  ahead_ = found;
}

std::vector<double> ToothCount::save() const {
  return {static_cast<double>(place_), static_cast<double>(ahead_), static_cast<double>(jumped_),
          since_, first_};
}

void ToothCount::restore(const std::vector<double>& state) {
  place_ = static_cast<int>(state[0]);
  ahead_ = static_cast<int>(state[1]);
  jumped_ = static_cast<int>(state[2]);
  since_ = state[3];
  first_ = state[4];
}

}  // namespace clatter::dynamics
