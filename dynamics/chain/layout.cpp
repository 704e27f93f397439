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

/// Places along the belt of the rear pins of all links, from `s` on, and of the first one again
/// behind the last. Links on sprockets have the pitch of the teeth, the others their own
/// times 1 + `stretch`.
std::vector<double> places_of_pins(const ChainSpec& chain, const Belt& belt, double s,
                                   double stretch) {
  std::vector<double> places{s};
  size_t part = 0;
  double lap = 0.0;
  const auto end = [&] { return lap + belt.parts[part].begin + belt.parts[part].length; };
  const auto go_on = [&] {
    if (++part < belt.parts.size()) return;
    part = 0;
    lap += belt.length;
  };
  for (const double own : chain.make.pitches) {
    for (double share = 1.0; share > 0.0;) {
      while (end() <= s) go_on();
      const ChainOver& over = chain.over[belt.parts[part].owner];
      const bool seated = over.teeth > 0 && !belt.parts[part].straight;
      const double pitch =
          seated ? over.belt.front().per_angle * pitch_angle(over) : own * (1.0 + stretch);
      const double rest = (end() - s) / pitch;
      s += std::min(share, rest) * pitch;
      if (rest < share) s = end();
      share -= rest;
    }
    places.push_back(s);
  }
  return places;
}

/// The stretch of the spans at which the chain is closed, by bisection.
std::vector<double> closed_places(const ChainSpec& chain, const Belt& belt, double s) {
  double least = -1.0, most = 1.0;
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (least + most);
    const bool short_of = places_of_pins(chain, belt, s, middle).back() < s + belt.length;
    (short_of ? least : most) = middle;
  }
  return places_of_pins(chain, belt, s, most);
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
  const double longest = length + chain.make.links() * chain.joint.clearance;
  layout.stretch = belt.length / length - 1.0;
  if (!(belt.length >= (1.0 - kMostStretch) * length &&
        belt.length <= (1.0 + kMostStretch) * longest)) {
    const double pitch = longest / chain.make.links();
    throw InputError(fmt::format(
        "{}: the way around {} is {:.6g} mm long, the chain {:.6g} mm{}, expected "
        "within 3 %: {} links are nearest",
        chain.where, fmt::join(names, ", "), belt.length * 1e3, length * 1e3,
        longest > length ? fmt::format(", to the end of its play {:.6g} mm", 1e3 * longest) : "",
        2 * std::lround(0.5 * belt.length / pitch)));
  }
  const BeltPart& first = wrap_of(belt, 0);
  const double gap = first_gap(chain.over.front(), first);
  const double share = (gap - polar(first.from - first.centre)) / first.angle;
  std::vector<double> places = closed_places(chain, belt, first.begin + share * first.length);
  places.pop_back();
  constexpr double kNear = 1e-7;  // [m]
  for (const double s : places) {
    layout.pins.push_back(belt.at(s));
    layout.along.push_back((belt.at(s + kNear) - belt.at(s - kNear)).normalized());
  }
  for (size_t i = 0; i < chain.over.size(); ++i) {
    const ChainOver& over = chain.over[i];
    layout.gaps.push_back(0.0);
    layout.seated.emplace_back();
    if (over.teeth == 0) continue;
    const BeltPart& wrap = wrap_of(belt, static_cast<int>(i));
    const Vector2d middle = belt.at(wrap.begin + 0.5 * wrap.length);
    const auto nearest = std::min_element(
        layout.pins.begin(), layout.pins.end(), [&](const Vector2d& a, const Vector2d& b) {
          return (a - middle).squaredNorm() < (b - middle).squaredNorm();
        });
    const double angle = polar(*nearest - wrap.centre);
    layout.gaps.back() = i == 0 ? gap : over.gap.value_or(angle);
    const double turns = std::remainder(angle - layout.gaps.back(), 2.0 * std::numbers::pi);
    layout.seated.back() = {static_cast<int>(nearest - layout.pins.begin()),
                            static_cast<int>(std::lround(turns / pitch_angle(over)))};
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
  const auto name = [&](int owner) { return chain.over[owner].name; };
  if (nearest->straight && nearest->owner != nearest->next)
    return "between " + name(nearest->owner) + " and " + name(nearest->next);
  return "on " + name(nearest->owner);
}

}  // namespace clatter::dynamics
