// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/tie/clip.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::assembly {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

double signed_area(const Polygon& polygon) {
  double twice = 0.0;
  for (size_t k = 1; k + 1 < polygon.size(); ++k)
    twice += cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  return 0.5 * twice;
}

Polygon clip(const Polygon& subject, const Polygon& window) {
  Polygon inside = subject;
  for (size_t e = 0; e < window.size() && !inside.empty(); ++e) {
    const Eigen::Vector2d& from = window[e];
    const Eigen::Vector2d edge = window[(e + 1) % window.size()] - from;
    const auto height = [&](const Eigen::Vector2d& p) { return cross(edge, p - from); };
    Polygon next;
    for (size_t k = 0; k < inside.size(); ++k) {
      const Eigen::Vector2d& a = inside[k];
      const Eigen::Vector2d& b = inside[(k + 1) % inside.size()];
      const double ha = height(a), hb = height(b);
      if (ha >= 0.0) next.push_back(a);
      if ((ha > 0.0 && hb < 0.0) || (ha < 0.0 && hb > 0.0)) {
        const double share = ha / (ha - hb);
        next.push_back(a + share * (b - a));
      }
    }
    inside = std::move(next);
  }
  return inside;
}

}  // namespace clatter::assembly
