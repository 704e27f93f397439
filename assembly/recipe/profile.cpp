// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/recipe/profile.hpp"

#include <algorithm>

namespace clatter::assembly {

double Profile::operator()(const Eigen::Vector3d& x) const {
  if (value.size() == 1) return value[0];
  const double s = direction.dot(x);
  const auto above = std::upper_bound(at.begin(), at.end(), s);
  if (above == at.begin()) return value.front();
  if (above == at.end()) return value.back();
  const auto k = static_cast<size_t>(above - at.begin());
  const double share = (s - at[k - 1]) / (at[k] - at[k - 1]);
  return (1.0 - share) * value[k - 1] + share * value[k];
}

fe::SurfaceValue on_surface(const Profile& profile) {
  if (profile.nodal.size() > 0) return profile.nodal;
  return profile;
}

}  // namespace clatter::assembly
