// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/measurement_surface.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"

namespace clatter::recover {
namespace {

constexpr double kDistance = 1.0;  // d [m]

/// The axis of the plane's normal, 0 to 2; -1 when it is along none.
int axis_of(const sound::Plane& ground) {
  for (int d = 0; d < 3; ++d)
    if (std::abs(ground.normal[d]) > 1.0 - 1e-9) return d;
  return -1;
}

/// The box at `kDistance` around a body, which ends at the ground.
struct MeasurementBox {
  Eigen::Vector3d low, high;
  int up = -1;         // axis of the ground's normal, -1: none
  bool upward = true;  // the fluid is at its positive side
  double area() const {
    const Eigen::Vector3d l = high - low;
    const double six = 2.0 * (l[0] * l[1] + l[1] * l[2] + l[2] * l[0]);
    return up < 0 ? six : six - l.prod() / l[up];
  }
};

MeasurementBox box_around(const sound::Surface& acoustic,
                          const std::optional<sound::Plane>& ground) {
  MeasurementBox box{acoustic.nodes.colwise().minCoeff().array() - kDistance,
                     acoustic.nodes.colwise().maxCoeff().array() + kDistance};
  if (ground) box.up = axis_of(*ground);
  if (box.up < 0) return box;
  box.upward = ground->normal[box.up] > 0.0;
  (box.upward ? box.low : box.high)[box.up] = ground->offset * ground->normal[box.up];
  return box;
}

std::vector<Microphone> around_body(const sound::Surface& acoustic, const MeasurementBox& box) {
  const auto beside = [&](int axis, double at) {
    Eigen::Vector3d position = acoustic.middle;
    position[axis] = at;
    return position;
  };
  return {{"plus_y", beside(1, box.high[1])},
          {"minus_y", beside(1, box.low[1])},
          {"plus_x", beside(0, box.high[0])},
          {"minus_x", beside(0, box.low[0])},
          {"top", beside(2, box.high[2])}};
}

/// Centres and corners of the partial areas of one side.
struct SidePoints {
  std::vector<Eigen::Vector3d> centres, corners;
};

SidePoints side_points(const MeasurementBox& box, int axis, bool far) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto parts = [&](int d) {
    return static_cast<int>(std::ceil((box.high[d] - box.low[d]) / (3.0 * kDistance) - 1e-9));
  };
  const auto at = [&](double i, double j) {
    Eigen::Vector3d point;
    point[axis] = (far ? box.high : box.low)[axis];
    point[u] = box.low[u] + i / parts(u) * (box.high[u] - box.low[u]);
    point[v] = box.low[v] + j / parts(v) * (box.high[v] - box.low[v]);
    return point;
  };
  SidePoints out;
  for (int i = 0; i <= parts(u); ++i)
    for (int j = 0; j <= parts(v); ++j) {
      out.corners.push_back(at(i, j));
      if (i < parts(u) && j < parts(v)) out.centres.push_back(at(i + 0.5, j + 0.5));
    }
  return out;
}

std::vector<Microphone> on_parallelepiped(const MeasurementBox& box) {
  std::vector<Eigen::Vector3d> points, corners;
  const double ground = (box.upward ? box.low : box.high)[box.up];
  const auto add_corner = [&](const Eigen::Vector3d& corner) {
    if (std::abs(corner[box.up] - ground) < 1e-9) return;
    for (const Eigen::Vector3d& other : corners)
      if ((other - corner).norm() < 1e-9) return;
    corners.push_back(corner);
  };
  for (int axis = 0; axis < 3; ++axis)
    for (bool far : {true, false}) {
      if (axis == box.up && far != box.upward) continue;
      const SidePoints side = side_points(box, axis, far);
      points.insert(points.end(), side.centres.begin(), side.centres.end());
      for (const Eigen::Vector3d& corner : side.corners) add_corner(corner);
    }
  points.insert(points.end(), corners.begin(), corners.end());
  std::vector<Microphone> out;
  for (size_t i = 0; i < points.size(); ++i)
    out.push_back({fmt::format("iso_{:02d}", i + 1), points[i]});
  return out;
}

}  // namespace

const char* name_of(MicrophoneSet set) {
  switch (set) {
    case MicrophoneSet::kEngine1m:
      return "engine_1m";
    case MicrophoneSet::kIso3744:
      return "iso_3744";
    case MicrophoneSet::kNone:
      break;
  }
  return "none";
}

MeasurementSurface measurement_surface(MicrophoneSet set, const sound::Surface& acoustic,
                                       const std::optional<sound::Plane>& ground) {
  if (set == MicrophoneSet::kNone) return {};
  MeasurementBox box = box_around(acoustic, ground);
  if (set == MicrophoneSet::kIso3744) {
    if (box.up < 0)
      throw InputError(fmt::format(
          "microphones: \"iso_3744\" needs [ground]{}: the measurement surface ends at a "
          "reflecting plane",
          ground ? " with a normal along an axis" : ""));
    return {set, box.area(), on_parallelepiped(box)};
  }
  if (box.up != 2 || !box.upward) box = box_around(acoustic, std::nullopt);
  return {set, box.area(), around_body(acoustic, box)};
}

}  // namespace clatter::recover
