// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/chain/tooth_count.hpp"

#include <cmath>
#include <cstdlib>

namespace clatter::dynamics {
namespace {

/// The number nearest to 0 that is `value` modulo `period`.
int nearest(int value, int period) {
  const int rest = ((value % period) + period) % period;
  return 2 * rest > period ? rest - period : rest;
}

}  // namespace

ToothCount::ToothCount(int links, int teeth, Turn turn)
    : links_(links), teeth_(teeth), turn_(static_cast<int>(turn)) {}

void ToothCount::update(double time, const std::vector<int>& gap_of_link) {
  bool any = false, agree = true;
  int found = 0, last = place_;
  for (int j = 0; j < links_; ++j) {
    const int gap = gap_of_link[static_cast<size_t>(j)];
    if (gap < 0) continue;
    // The link's place on the loop of the chain that is nearest to the last one on the sprocket.
    if (!begun_ && !any) last = j;
    const int place = last + nearest(j - last, links_);
    if (!begun_) {
      base_ = nearest(turn_ * gap - place, teeth_);
      begun_ = true;
    }
    const int ahead = ahead_ + nearest(turn_ * gap - place - base_ - ahead_, teeth_);
    agree = agree && (!any || ahead == found);
    found = ahead;
    any = true;
    place_ = place;
    if (ahead != ahead_ && first_ < 0.0) first_ = time;
  }
  if (!any || !agree || found == ahead_) return;
  jumped_ += std::abs(found - ahead_);
  ahead_ = found;
}

std::vector<double> ToothCount::save() const {
  return {begun_ ? 1.0 : 0.0,          static_cast<double>(base_),   static_cast<double>(place_),
          static_cast<double>(ahead_), static_cast<double>(jumped_), first_};
}

void ToothCount::restore(const std::vector<double>& state) {
  begun_ = state[0] != 0.0;
  base_ = static_cast<int>(state[1]);
  place_ = static_cast<int>(state[2]);
  ahead_ = static_cast<int>(state[3]);
  jumped_ = static_cast<int>(state[4]);
  first_ = state[5];
}

}  // namespace clatter::dynamics
