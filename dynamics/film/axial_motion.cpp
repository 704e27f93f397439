// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/axial_motion.hpp"

namespace clatter::film {

AxialMotion axial_motion(int size, int pin, const Eigen::Vector2d& reaction,
                         const LinerAxial* liner) {
  AxialMotion motion;
  motion.reaction = reaction;
  motion.height = {{pin + 2, 1.0}, {pin + 3, reaction.y()}, {pin + 4, -reaction.x()}};
  motion.slide.setZero(3, size);
  motion.slide.middleCols<3>(pin + 2).setIdentity();
  if (liner == nullptr) return motion;
  motion.height.emplace_back(liner->coordinate, -1.0);
  motion.slide(0, liner->coordinate) = -1.0;
  // The liner's axial displacement at the pin's centre is that at `reaction` less the tilts'.
  auto tilts = motion.slide.middleCols<2>(liner->tilt);
  tilts.row(0) << reaction.y(), -reaction.x();
  tilts.bottomRows<2>() = -Eigen::Matrix2d::Identity();
  return motion;
}

}  // namespace clatter::film
