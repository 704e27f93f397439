// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Integrals over two facets of the free field and its normal derivatives.
#include <Eigen/Core>

#include "core/sound/facet.hpp"
#include "core/sound/space.hpp"

namespace clatter::sound {

/// Of a test facet x and a source facet y, with their linear shape functions N_a, N_b:
///
///   single_ab = int int N_a(x) N_b(y) G dS dS          [m3]
///   double_ab = int int N_a(x) N_b(y) dG/dn(y) dS dS   [m2]
///   adjoint_ab = int int N_a(x) N_b(y) dG/dn(x) dS dS  [m2]
struct PairIntegrals {
  Eigen::Matrix3cd single_layer = Eigen::Matrix3cd::Zero();
  Eigen::Matrix3cd double_layer = Eigen::Matrix3cd::Zero();
  Eigen::Matrix3cd adjoint = Eigen::Matrix3cd::Zero();
};

/// Chooses the rule by the distance over the size: touching facets are transformed (Sauter and
/// Schwab 2011), near ones divided until the parts are far from each other, the others take six or
/// three points. Sharing is by node numbers; pass `same_surface` false for a mirror image.
PairIntegrals pair_integrals(double k, const PreparedFacet& x, const PreparedFacet& y,
                             bool same_surface);

}  // namespace clatter::sound
