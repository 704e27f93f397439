// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/event_search.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {

using Eigen::VectorXd;

namespace {

constexpr int kParts = 4;
/// Bisections of a part: its length is then at rounding level.
constexpr int kHalvings = 50;
/// Sections of a part around an extreme (golden ratio): to 1e-8 of its length, below which the
/// value at an extreme does not change.
constexpr int kSections = 40;
/// Time over which the direction of a function is looked at [s].
constexpr double kMoment = 1e-9;

}  // namespace

EventSearch::EventSearch(const System& system) : system_(&system) {
  for (int e = 0; e < system.elements(); ++e)
    for (int k = 0; k < system.element(e).events(); ++k) functions_.push_back({e, k});
}

double EventSearch::value(const Function& function, double time, const VectorXd& y,
                          const VectorXd& v) const {
  const ForceElement& element = system_->element(function.element);
  gather(y, element.coordinates(), y_);
  gather(v, element.coordinates(), v_);
  return element.event_function(function.index, time, y_, v_);
}

double EventSearch::value_between(const Function& function, const StageState& from,
                                  const StageState& to, double t) const {
  const ForceElement& element = system_->element(function.element);
  const std::vector<int>& at = element.coordinates();
  const double h = to.time - from.time;
  y_.resize(static_cast<Eigen::Index>(at.size()));
  v_.resize(y_.size());
  for (size_t i = 0; i < at.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double y_0 = from.y(at[i]), v_0 = from.v_y(at[i]), y_1 = to.y(at[i]), v_1 = to.v_y(at[i]);
    y_(k) = hermite(y_0, v_0, y_1, v_1, h, t);
    v_(k) = hermite_rate(y_0, v_0, y_1, v_1, h, t);
  }
  return element.event_function(function.index, from.time + t * h, y_, v_);
}

double EventSearch::direction(const Function& function, const StageState& state) const {
  const double change = value(function, state.time + kMoment, state.y + kMoment * state.v_y,
                              state.v_y + kMoment * interface_acceleration(state)) -
                        value(function, state.time, state.y, state.v_y);
  return change < 0.0 ? -1.0 : 1.0;
}

void EventSearch::start(const StageState& state) {
  for (Function& function : functions_) {
    const double now = value(function, state.time, state.y, state.v_y);
    function.side = is_one_sided(function) ? 1.0
                    : now == 0.0           ? direction(function, state)
                                           : std::copysign(1.0, now);
  }
}

void EventSearch::passed(const Event& event, const StageState& state) {
  for (Function& function : functions_)
    if (function.element == event.element && function.index == event.index)
      function.side = is_one_sided(function) ? 1.0 : direction(function, state);
}

bool EventSearch::is_one_sided(const Function& function) const {
  return system_->element(function.element).is_one_sided(function.index);
}

Eigen::VectorXd EventSearch::interface_acceleration(const StageState& state) const {
  return system_->interface(state.a);
}

std::optional<double> EventSearch::root(const Function& function, const StageState& from,
                                        const StageState& to) const {
  // Positive on the side where the function is.
  const auto g = [&](double t) {
    if (t >= 1.0) return function.side * value(function, to.time, to.y, to.v_y);
    return function.side * value_between(function, from, to, t);
  };
  const auto bisect = [&](double low, double high) {
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (g(middle) < 0.0 ? high : low) = middle;
    }
    return high;
  };
  double previous = std::max(g(0.0), 0.0), at = 0.0;
  for (int part = 1; part <= kParts; ++part) {
    const double end = static_cast<double>(part) / kParts, last = g(end);
    if (last < 0.0) return bisect(at, end);
    // Falling at the beginning and rising at the end: a smallest value between.
    const double small = 1e-3 / kParts;
    if (g(at + small) < previous && g(end - small) < last) {
      constexpr double kGolden = 0.6180339887498949;
      double low = at, high = end;
      for (int i = 0; i < kSections; ++i) {
        const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
        (g(left) < g(right) ? high : low) = g(left) < g(right) ? right : left;
      }
      const double least = 0.5 * (low + high);
      if (g(least) < 0.0) return bisect(at, least);
    }
    previous = last;
    at = end;
  }
  return std::nullopt;
}

std::optional<Event> EventSearch::first(const StageState& from, const StageState& to) const {
  std::optional<Event> found;
  for (const Function& function : functions_) {
    const auto t = root(function, from, to);
    if (!t) continue;
    const double time = from.time + *t * (to.time - from.time);
    if (!found || time < found->time) found = Event{time, function.element, function.index};
  }
  return found;
}

}  // namespace clatter::dynamics
