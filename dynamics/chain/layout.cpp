// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/chain/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::dynamics {

using Eigen::Vector2d;

namespace {

constexpr double kMostStretch = 0.03;

double polar(const Vector2d& vector) { return std::atan2(vector.y(), vector.x()); }

/// The wrap of a sprocket.
const BeltPart& wrap_of(const Belt& belt, int owner) {
  return *std::find_if(belt.parts.begin(), belt.parts.end(),
                       [&](const BeltPart& part) { return !part.straight && part.owner == owner; });
}

double pitch_angle(const ChainOver& sprocket) { return 2.0 * std::numbers::pi / sprocket.teeth; }

/// A tooth gap of the first sprocket that is wrapped: the nearest to the one given [rad].
double first_gap(const ChainOver& sprocket, const BeltPart& wrap) {
  const double begin = polar(wrap.from - wrap.centre);
  if (!sprocket.gap) return begin + 0.5 * wrap.angle;
  const double turn = static_cast<double>(sprocket.turn), size = std::abs(wrap.angle);
  double after = turn * (*sprocket.gap - begin);  // from the beginning of the wrap
  after -= 2.0 * std::numbers::pi * std::floor(after / (2.0 * std::numbers::pi));
  if (after > size) {
    const double pitch = pitch_angle(sprocket), over = after - size,
                 under = 2.0 * std::numbers::pi - after;
    after += over <= under ? -pitch * std::ceil(over / pitch)
                           : pitch * std::ceil(under / pitch) - 2.0 * std::numbers::pi;
  }
  return begin + turn * after;
}

}  // namespace

ChainLayout lay_out(const ChainSpec& chain) {
  ChainLayout layout;
  std::vector<BeltCircle> circles;
  for (const ChainOver& one : chain.over)
    circles.insert(circles.end(), one.belt.begin(), one.belt.end());
  const std::vector<std::string> names = chain.over_names();
  layout.belt = with_context(chain.where, [&] { return taut_belt(circles, names); });
  const Belt& belt = layout.belt;
  const double length = chain.make.length();
  layout.stretch = belt.length / length - 1.0;
  if (!(std::abs(layout.stretch) <= kMostStretch)) {
    const double pitch = length / chain.make.links();
    throw InputError(
        fmt::format("{}: the way around {} is {:.6g} mm long, the chain {:.6g} mm, expected within "
                    "3 %: {} links "
                    "are nearest",
                    chain.where, fmt::join(names, ", "), belt.length * 1e3, length * 1e3,
                    2 * std::lround(0.5 * belt.length / pitch)));
  }
  const BeltPart& first = wrap_of(belt, 0);
  const double gap = first_gap(chain.over.front(), first);
  const double share = (gap - polar(first.from - first.centre)) / first.angle;
  double s = first.begin + share * first.length;
  constexpr double kNear = 1e-7;  // [m]
  for (const double pitch : chain.make.pitches) {
    layout.pins.push_back(belt.at(s));
    layout.along.push_back((belt.at(s + kNear) - belt.at(s - kNear)).normalized());
    s += pitch * (1.0 + layout.stretch);
  }
  for (size_t i = 0; i < chain.over.size(); ++i) {
    const ChainOver& over = chain.over[i];
    layout.gaps.push_back(0.0);
    if (over.teeth == 0) continue;
    layout.gaps.back() = i == 0 ? gap : over.gap.value_or(0.0);
    if (i == 0 || over.gap) continue;
    const BeltPart& wrap = wrap_of(belt, static_cast<int>(i));
    const Vector2d middle = belt.at(wrap.begin + 0.5 * wrap.length);
    const auto nearest = std::min_element(
        layout.pins.begin(), layout.pins.end(), [&](const Vector2d& a, const Vector2d& b) {
          return (a - middle).squaredNorm() < (b - middle).squaredNorm();
        });
    layout.gaps.back() = polar(*nearest - wrap.centre);
  }
  return layout;
}

std::string place_on_belt(const ChainSpec& chain, const ChainLayout& layout, int link) {
  const auto at = static_cast<size_t>(link);
  const Vector2d centre = 0.5 * (layout.pins[at] + layout.pins[(at + 1) % layout.pins.size()]);
  const BeltPart* nearest = nullptr;
  double least = 0.0;
  for (const BeltPart& part : layout.belt.parts) {
    for (double share = 0.0; share <= 1.0; share += 0.02) {
      const double distance = (layout.belt.at(part.begin + share * part.length) - centre).norm();
      if (nearest != nullptr && distance >= least) continue;
      nearest = &part;
      least = distance;
    }
  }
  const auto name = [&](int owner) { return chain.over[static_cast<size_t>(owner)].name; };
  if (nearest->straight && nearest->owner != nearest->next)
    return "between " + name(nearest->owner) + " and " + name(nearest->next);
  return "on " + name(nearest->owner);
}

}  // namespace clatter::dynamics
