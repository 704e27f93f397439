// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Links of a chain as rigid bodies in a plane.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/body/modal_body.hpp"

namespace clatter::dynamics {

/// Mass [kg] and moment of inertia about the centre of mass [kg m2], which is midway between the
/// pins.
struct LinkMass {
  double mass = 0.0, inertia = 0.0;
};

/// Which plates and pins a link has: a bush belongs to an inner link.
enum class LinkKind : char { kInner, kOuter };

/// The chain as made: links 0 .. n - 1 in running direction. Link j has its rear pin at
/// (-p_j / 2, 0) and its front pin at (p_j / 2, 0) of its own axes; joint j is that of the front
/// pin of link j with the rear pin of link j + 1, of a closed chain that of the last link with the
/// first one too.
struct ChainMake {
  std::vector<LinkKind> kinds;  // n
  std::vector<double> pitches;  // p_j, with errors and wear [m]
  LinkMass inner, outer;
  bool closed = true;

  int joints() const { return closed ? links() : links() - 1; }
  int links() const { return static_cast<int>(kinds.size()); }
  const LinkMass& mass(int link) const { return kinds[link] == LinkKind::kInner ? inner : outer; }
  double half(int link) const { return 0.5 * pitches[link]; }
  /// Sum of all pitches [m].
  double length() const;
  /// Mean mass of the chain per length [kg/m].
  double mass_per_length() const;
};

/// Where a link is in the plane of its chain.
struct LinkPlace {
  Eigen::Vector2d centre;  // [m]
  double angle = 0.0;      // of the line from its rear to its front pin [rad]
};

/// The links that join pins at the given places: pin j is the rear pin of link j; of an open chain
/// there is one pin more than links. Angles are continuous from one link to the next.
std::vector<LinkPlace> links_between(const std::vector<Eigen::Vector2d>& pins, bool closed = true);

}  // namespace clatter::dynamics
