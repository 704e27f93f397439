// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/local_system.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr double kParallel = 1e-9;  // sine of an angle: coordinates have few digits

Eigen::Vector3d point_from(const Fields& fields, size_t first) {
  Eigen::Vector3d x;
  for (size_t k = 0; k < 3; ++k) {
    x[static_cast<int>(k)] = fields.number_or(first + k, "coordinate", 0.0);
  }
  return x;
}

}  // namespace

LocalSystem local_system(const Card& card, const Source& source) {
  LocalSystem out;
  if (card.size() == 0) return out;
  const Fields first = card.line(0, source);
  first.at_most(6, "the origin and a point of the x axis");
  out.origin = point_from(first, 0);
  if (first.size() <= 3) return out;
  const Eigen::Vector3d x = point_from(first, 3) - out.origin;
  Eigen::Vector3d in_plane = Eigen::Vector3d::UnitZ().cross(x);
  if (card.size() > 1) {
    const Fields second = card.line(1, source);
    second.at_most(3, "a point of the xy plane");
    in_plane = point_from(second, 0) - out.origin;
  }
  const Eigen::Vector3d z = x.cross(in_plane);
  if (!(z.norm() > kParallel * x.norm() * in_plane.norm())) {
    source.fail(card.origin(), "*SYSTEM: expected three points that are not on one line");
  }
  out.axes.col(0) = x.normalized();
  out.axes.col(2) = z.normalized();
  out.axes.col(1) = out.axes.col(2).cross(out.axes.col(0));
  return out;
}

char coordinates_of(const Keyword& keyword, const Source& source) {
  const std::string kind = keyword.choice("SYSTEM", "R");
  if (kind == "R" || kind == "RC") return 'R';
  if (kind == "C" || kind == "S") return kind.front();
  source.fail(keyword.origin, fmt::format("{}: found SYSTEM={}, expected R, C or S", keyword.name,
                                          *keyword.find("SYSTEM")));
}

Eigen::Vector3d cartesian(char kind, const Eigen::Vector3d& x) {
  if (kind == 'R') return x;
  const double theta = x[1] * std::numbers::pi / 180.0;
  const double phi = kind == 'S' ? x[2] * std::numbers::pi / 180.0 : 0.0;
  const double radius = x[0] * std::cos(phi);
  return {radius * std::cos(theta), radius * std::sin(theta),
          kind == 'S' ? x[0] * std::sin(phi) : x[2]};
}

}  // namespace clatter::mesh::deck::abaqus
