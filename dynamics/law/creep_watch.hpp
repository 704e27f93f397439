// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How far contacts creep whose friction has a slip speed.
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "dynamics/law/archive.hpp"

namespace clatter::dynamics {

/// Friction that grows with the slip up to a slip speed does not hold: below that speed a contact
/// creeps where one with Coulomb's law would stick. The watch has the longest way between two ends
/// of such a rest, of all contacts of an element: what vibrates about its place does not creep.
class CreepWatch {
 public:
  /// @param slip_speed from which friction is full [m/s].
  CreepWatch(double slip_speed, size_t contacts)
      : slip_speed_(slip_speed), ways_(contacts, Eigen::Vector2d::Zero()) {}

  void begin_step(double time) { begun_ = time; }
  /// A step ends: the slip of a contact in its plane [m/s], and whether it is pressed.
  void accept_step(size_t contact, double time, bool is_pressed, const Eigen::Vector2d& slip) {
    Eigen::Vector2d& way = ways_[contact];
    if (is_pressed && slip.norm() < slip_speed_)
      way += (time - begun_) * slip;
    else
      way.setZero();
    longest_ = std::max(longest_, way.norm());
  }
  double longest() const { return longest_; }  // so far [m]

  void archive(Archive& archive) {
    archive(longest_);
    for (Eigen::Vector2d& way : ways_) {
      archive(way.x());
      archive(way.y());
    }
  }

 private:
  double slip_speed_, begun_ = 0.0, longest_ = 0.0;
  std::vector<Eigen::Vector2d> ways_;  // of the rest under way [m]
};

}  // namespace clatter::dynamics
