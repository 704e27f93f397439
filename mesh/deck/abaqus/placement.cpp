// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/placement.hpp"

#include <numbers>

namespace clatter::mesh::deck::abaqus {

void Placement::read(const Fields& fields, int line) {
  if (line == 0) {
    fields.at_most(3, "translation");
    for (int k = 0; k < 3; ++k) {
      shift[k] = fields.number_or(static_cast<size_t>(k), "translation", 0.0);
    }
    return;
  }
  if (line > 1) fields.fail("expected at most two lines: translation, axis and angle");
  fields.at_most(7, "axis and angle");
  Eigen::Vector3d a, b;
  for (int k = 0; k < 3; ++k) {
    a[k] = fields.number(static_cast<size_t>(k), "first point of the axis");
    b[k] = fields.number(static_cast<size_t>(3 + k), "second point of the axis");
  }
  const double length = (b - a).norm();
  if (!(length > 0.0)) fields.fail("expected two different points of the axis");
  const double angle = fields.number(6, "angle in degrees") * std::numbers::pi / 180.0;
  rotation = Eigen::AngleAxisd(angle, (b - a) / length).toRotationMatrix();
  shift = rotation * (shift - a) + a;
}

Eigen::Affine3d Placement::affine() const {
  Eigen::Affine3d out = Eigen::Affine3d::Identity();
  out.linear() = rotation;
  out.translation() = shift;
  return out;
}

}  // namespace clatter::mesh::deck::abaqus
