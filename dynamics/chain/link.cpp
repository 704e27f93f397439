// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/chain/link.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace clatter::dynamics {

double ChainMake::length() const { return std::accumulate(pitches.begin(), pitches.end(), 0.0); }

double ChainMake::mass_per_length() const {
  double sum = 0.0;
  for (int j = 0; j < links(); ++j) sum += mass(j).mass;
  return sum / length();
}

std::vector<LinkPlace> links_between(const std::vector<Eigen::Vector2d>& pins, bool closed) {
  std::vector<LinkPlace> links;
  const size_t count = closed ? pins.size() : pins.size() - 1;
  for (size_t j = 0; j < count; ++j) {
    const Eigen::Vector2d& rear = pins[j];
    const Eigen::Vector2d& front = pins[(j + 1) % pins.size()];
    const Eigen::Vector2d along = front - rear;
    double angle = std::atan2(along.y(), along.x());
    if (!links.empty())
      angle =
          links.back().angle + std::remainder(angle - links.back().angle, 2.0 * std::numbers::pi);
    links.push_back({0.5 * (rear + front), angle});
  }
  return links;
}

}  // namespace clatter::dynamics
