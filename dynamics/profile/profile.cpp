// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/profile/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "dynamics/profile/segment_cells.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;

constexpr double kLargestGap = 1e-9;  // between neighbouring segments [m]

/// The joint from the end of one segment to the begin of the next; numbers count from 1.
void check_joint(const CurvePoint& end, const CurvePoint& begin, size_t before, size_t after,
                 double largest_kink) {
  const double gap = (begin.position - end.position).norm();
  if (!(gap <= kLargestGap))
    throw InputError(
        fmt::format("profile: segment {} begins {:.3g} m from the end of segment {}, "
                    "expected at most {:g} m",
                    after, gap, before, kLargestGap));
  const Vector2d &a = end.derivative, &b = begin.derivative;
  const double kink = std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
  constexpr double kDegree = std::numbers::pi / 180.0;
  if (!(kink <= largest_kink))
    throw InputError(
        fmt::format("profile: a kink of {:.3g} deg between segments {} and {}, expected "
                    "at most {:.3g} deg",
                    kink / kDegree, before, after, largest_kink / kDegree));
}

SegmentCells cells_of(const std::vector<Segment>& segments) {
  if (segments.empty()) throw InputError("profile: no segments, expected at least one");
  SegmentCells result;
  for (size_t i = 0; i < segments.size(); ++i)
    with_context(fmt::format("profile: segment {}", i + 1), [&] {
      if (segments.size() > 1)
        if (const auto* spline = std::get_if<PointsSegment>(&segments[i]); spline && spline->closed)
          throw InputError("a closed curve among other segments, expected an open one");
      result.add(segments[i]);
    });
  return result;
}

void check_joints(const SegmentCells& cells, size_t count, const ProfileOptions& options,
                  const Vector2d& part_rotation) {
  for (size_t i = 1; i < count; ++i)
    check_joint(cells.end(i - 1), cells.begin(i), i, i + 1, options.largest_kink);
  if (!options.closed && options.repeats == 1) return;
  CurvePoint begin = cells.begin(0);
  if (options.repeats > 1) {
    begin.position = turned(part_rotation, begin.position);
    begin.derivative = turned(part_rotation, begin.derivative);
  }
  check_joint(cells.end(count - 1), begin, count, 1, options.largest_kink);
}

}  // namespace

Profile::Profile(const std::vector<Segment>& segments, const ProfileOptions& options)
    : side_(options.solid == ProfileOptions::Solid::kLeft ? 1.0 : -1.0),
      closed_(options.closed),
      repeats_(options.repeats) {
  if (repeats_ < 1)
    throw InputError(fmt::format("profile: {} parts, expected at least 1", repeats_));
  for (int i = 0; i < repeats_; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / repeats_;
    rotations_.emplace_back(std::cos(angle), std::sin(angle));
  }
  const double half = std::numbers::pi / repeats_;
  border_ = {std::cos(half), std::sin(half)};
  SegmentCells made = cells_of(segments);
  check_joints(made, segments.size(), options, rotations_[repeats_ > 1 ? 1 : 0]);
  cells_ = std::move(made.cells);
  cubics_ = std::move(made.cubics);
  part_length_ = cells_.back().start + cells_.back().length;
  std::vector<Circle> circles;
  for (const ProfileCell& cell : cells_) {
    circles.push_back(bounding_circle(cell, cubics_));
    reach_ = std::max(reach_, circles.back().centre.norm() + circles.back().radius);
  }
  tree_ = CircleTree(circles);
}

size_t Profile::cell_at(double arc_length) const {
  const auto after =
      std::upper_bound(cells_.begin(), cells_.end(), arc_length,
                       [](double s, const ProfileCell& cell) { return s < cell.start; });
  return static_cast<size_t>(std::max<std::ptrdiff_t>(after - cells_.begin() - 1, 0));
}

ProfilePoint Profile::describe(const ProfileCell& cell, double parameter, int part) const {
  const CurvePoint at = cell_point(cell, cubics_, parameter);
  const Vector2d& rotation = this->rotation(part);
  const Vector2d tangent = turned(rotation, Vector2d(at.derivative / at.speed));
  return {turned(rotation, at.position), tangent, outward(tangent),
          side_ * cell_curvature(cell, cubics_, parameter)};
}

ProfilePoint Profile::at(double arc_length) const {
  int part = 0;
  double s = arc_length;
  if (closed()) {
    s -= std::floor(s / length()) * length();
    part = std::min(static_cast<int>(s / part_length_), repeats_ - 1);
    s -= part * part_length_;
  }
  s = std::clamp(s, 0.0, part_length_);
  const ProfileCell& cell = cells_[cell_at(s)];
  return describe(cell, cell_parameter(cell, cubics_, s - cell.start), part);
}

}  // namespace clatter::dynamics
