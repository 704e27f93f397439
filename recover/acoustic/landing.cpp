// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/acoustic/landing.hpp"

#include <Eigen/Geometry>
#include <limits>

namespace clatter::recover {
namespace {

constexpr double kFarAway = std::numeric_limits<double>::infinity();

/// Moves a point outside of a face to its border, nearly the nearest one.
Eigen::Vector3d clamped(const Eigen::Vector3d& shape) {
  const Eigen::Vector3d positive = shape.cwiseMax(0.0);
  return positive / positive.sum();
}

}  // namespace

LandingSearch::LandingSearch(const sound::Surface& acoustic)
    : acoustic_(acoustic), radius_(Eigen::VectorXd::Zero(acoustic.face_count())) {
  for (Eigen::Index f = 0; f < acoustic.face_count(); ++f)
    for (int a = 0; a < 3; ++a)
      radius_[f] = std::max(
          radius_[f],
          (acoustic.nodes.row(acoustic.triangles(f, a)) - acoustic.face_centre.row(f)).norm());
}

Eigen::Vector3d LandingSearch::barycentric(int32_t face, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d normal = acoustic_.face_normal.row(face);
  Eigen::Vector3d shape;
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector3d from = acoustic_.nodes.row(acoustic_.triangles(face, (a + 1) % 3));
    const Eigen::Vector3d to = acoustic_.nodes.row(acoustic_.triangles(face, (a + 2) % 3));
    shape[a] = 0.5 * normal.dot((to - from).cross(point - from)) / acoustic_.face_area[face];
  }
  return shape;
}

Landing LandingSearch::nearest(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                               double least_cosine) const {
  double best = kFarAway;
  Landing landing{-1, {}};
  for (int32_t f = 0; f < acoustic_.face_count(); ++f) {
    if ((acoustic_.face_centre.row(f).transpose() - point).norm() - radius_[f] >= best) continue;
    if (acoustic_.face_normal.row(f).dot(normal) < least_cosine) continue;
    const double distance = sound::distance_to_face(acoustic_, f, point);
    if (distance >= best) continue;
    best = distance;
    landing = {f, clamped(barycentric(f, point))};
  }
  return landing;
}

Landing LandingSearch::land(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
  double first = kFarAway;
  Landing landing{-1, {}};
  for (int32_t f = 0; f < acoustic_.face_count(); ++f) {
    const Eigen::Vector3d to = acoustic_.face_centre.row(f).transpose() - point;
    const double along = to.dot(normal);
    if (to.squaredNorm() - along * along > radius_[f] * radius_[f]) continue;
    const double cosine = acoustic_.face_normal.row(f).dot(normal);
    if (cosine < 0.1) continue;
    const double t = acoustic_.face_normal.row(f).dot(to) / cosine;
    if (t >= first || t < -acoustic_.mean_edge / 3.0) continue;
    const Eigen::Vector3d shape = barycentric(f, point + t * normal);
    if (shape.minCoeff() < -1e-9) continue;  // rays through an edge must not pass between faces
    first = t;
    landing = {f, clamped(shape)};
  }
  if (landing.face < 0) landing = nearest(point, normal, 0.35);
  return landing.face < 0 ? nearest(point, normal, -2.0) : landing;
}

}  // namespace clatter::recover
