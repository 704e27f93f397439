// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// CAD parts with slivers, written as STEP: near faces, cusps, steps of micrometres.
#include <gmsh.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "mesh/cad/gmsh_session.hpp"

namespace clatter::mesh::testing {

constexpr double kGap = 0.002;  // mm

/// An assembly: a body, a nose whose rim is smaller by kGap, and a fin whose outer side is tangent
/// to the body, so that it ends in a cusp on it.
inline void write_rocket(const std::filesystem::path& file) {
  GmshSession session("rocket");
  const Solid body = session.cylinder({0, 0, 0}, {60, 0, 0}, 15.0);
  gmsh::model::occ::addCone(60, 0, 0, 25, 0, 0, 15.0 - kGap, 3);
  session.cut({session.box({4, 11, 0}, {28, 15, 30})}, session.copy({body}));
  session.write_cad(file, "mm");
}

/// The centres of two bolts on a flange of radius 40.
inline Eigen::Vector3d bolt_position(int k) {
  const double angle = std::numbers::pi * k;
  return {29.0 * std::cos(angle), 29.0 * std::sin(angle), 0.0};
}

/// The flange without holes.
inline Solids flange_of(GmshSession& session) {
  return session.cut({session.cylinder({0, 0, 0}, {0, 0, 12}, 40.0)},
                     {session.cylinder({0, 0, -1}, {0, 0, 20}, 18.0)});
}

/// A flange with its bolts, an assembly: shanks have a clearance of kGap in their holes, so that
/// under each head a ring of that width lies between shank and hole.
inline void write_bolted_flange(const std::filesystem::path& file) {
  GmshSession session("flange");
  Solids flange = flange_of(session);
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d at = bolt_position(k);
    flange = session.cut(flange,
                         {session.cylinder(at - Eigen::Vector3d(0, 0, 1), {0, 0, 20}, 5.0 + kGap)});
    session.fuse({session.cylinder(at, {0, 0, 12}, 5.0)},
                 {session.cylinder(at + Eigen::Vector3d(0, 0, 12), {0, 0, 5}, 8.0)});
  }
  session.write_cad(file, "mm");
}

/// One solid: a flange with spot faces of the depth kGap around its holes.
inline void write_spot_faced_flange(const std::filesystem::path& file) {
  GmshSession session("spots");
  Solids flange = flange_of(session);
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d at = bolt_position(k);
    flange =
        session.cut(flange, {session.cylinder(at - Eigen::Vector3d(0, 0, 1), {0, 0, 20}, 4.0)});
    flange = session.cut(flange,
                         {session.cylinder(at + Eigen::Vector3d(0, 0, 12 - kGap), {0, 0, 1}, 8.0)});
  }
  session.write_cad(file, "mm");
}

}  // namespace clatter::mesh::testing
