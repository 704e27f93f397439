// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/floating_frame.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace clatter::condense {

Eigen::Matrix3d FloatingFrame::moment(Eigen::Index k) const {
  Eigen::Matrix3d S;
  for (int l = 0; l < 3; ++l)
    for (int m = 0; m < 3; ++m) S(l, m) = invariants.moment[3 * l + m][k];
  return S;
}

Eigen::Matrix3d FloatingFrame::product(Eigen::Index k, Eigen::Index i) const {
  Eigen::Matrix3d P;
  for (int l = 0; l < 3; ++l)
    for (int m = 0; m < 3; ++m) P(l, m) = invariants.product[3 * l + m](k, i);
  return P;
}

FloatingFrame floating_frame(const ExportedPart& part, const PencilModes& modes,
                             const std::string& format) {
  const rom::ReducedModel& model = part.model;
  if (model.inertia.empty())
    throw InputError(
        fmt::format("{}: found no inertia invariants, expected a part condensed with "
                    "inertia_invariants = true for {}",
                    model.name, format));
  FloatingFrame frame;
  frame.invariants = model.inertia.in(modes.Phi);
  frame.mass = model.mass.mass;
  frame.centre = model.mass.centre;
  const Eigen::Matrix3d& place = frame.invariants.place;
  frame.inertia = place.trace() * Eigen::Matrix3d::Identity() - place;
  frame.first.resize(3, modes.Phi.cols());
  for (int d = 0; d < 3; ++d) frame.first.row(d) = frame.invariants.first[d].transpose();
  return frame;
}

Eigen::Matrix3d tilde(const Eigen::Vector3d& v) {
  Eigen::Matrix3d out;
  out << 0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0;
  return out;
}

Eigen::RowVector3d axial(const Eigen::Matrix3d& S) {
  return {S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0)};
}

}  // namespace clatter::condense
