// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where the flux of a point of a body passes through its acoustic skin.
#include <Eigen/Core>

#include "core/sound/surface.hpp"

namespace clatter::recover {

/// A point of the acoustic skin.
struct Landing {
  int32_t face = 0;
  Eigen::Vector3d shape{0, 0, 0};  // barycentric coordinates in the face
};

/// Finds landings on a surface; safe to be used by several threads.
class LandingSearch {
 public:
  explicit LandingSearch(const sound::Surface& acoustic);

  /// Where the ray from a point of an exposed face along its normal leaves the surface, which may
  /// pass a third of an edge below the point at rounded edges. Without such a face: the nearest
  /// face whose normal is within 70 degrees, and without one the nearest of all.
  Landing land(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

 private:
  Landing nearest(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                  double least_cosine) const;
  Eigen::Vector3d barycentric(int32_t face, const Eigen::Vector3d& point) const;

  const sound::Surface& acoustic_;
  Eigen::VectorXd radius_;  // n_f [m], of the faces about their centres
};

}  // namespace clatter::recover
