// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Impulses of rigid contacts that touch at the same instant.
#include <Eigen/Core>
#include <vector>

namespace clatter::dynamics {

struct ImpactLaw {
  double restitution = 0.0;  // e, 0 to 1
  double friction = 0.0;     // mu of the impulses
  /// Something else holds it: it takes part only where the impact of another closes it faster.
  bool held = false;
};

/// Impulses of n contacts [N s], 3 n: along the normal and two tangents of each.
///
/// Contacts that close at the same instant are solved together, those that close because of these
/// impulses next, until none closes (generalized reflections, Smith et al. 2012). So an impact
/// travels through a row of bodies, symmetric bodies stay symmetric, and the order of the contacts
/// has no influence. A contact without restitution takes part from the beginning. The impulses L of
/// a round, and the velocities u- before and u+ after it, obey Moreau's rule (1988):
///
///   0 <= L_n  perpendicular to  u+_n + e u-_n >= 0,   |L_t| <= mu L_n,
///
/// with L_t against u+_t and at its limit where u+_t is not zero. Where contacts are redundant,
/// impulses are the smallest ones. Energy never grows: unequal restitutions, or friction, can gain
/// in this rule; then all impulses of the round move towards those of e = 0 until it does not.
///
/// @param mobility G, 3 n x 3 n, symmetric: change of the contacts' velocities by unit impulses
///   [1/kg]. @param velocity u before, 3 n [m/s], normal below 0 where a contact closes.
Eigen::VectorXd impact_impulses(const Eigen::MatrixXd& mobility, const Eigen::VectorXd& velocity,
                                const std::vector<ImpactLaw>& laws);

}  // namespace clatter::dynamics
