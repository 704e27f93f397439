// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Normal velocity of the acoustic skin from the motion of the exposed faces of a body.
#include <vector>

#include "core/rom/reduced_model.hpp"
#include "core/sound/surface.hpp"
#include "recover/acoustic/flow_map.hpp"
#include "recover/skin/exposure.hpp"
#include "recover/skin/skin.hpp"

namespace clatter::recover {

/// Motion of lids: the faces of the acoustic skin that close openings.
enum class LidMotion {
  kRest,     // rigid and at rest
  kNearest,  // with the nearest point of an exposed face
};

/// What the map loses, measured with the six rigid motions of the body: the acoustic skin would
/// move with n . u exactly.
struct MapErrors {
  double flux = 0.0;  // |flux out of the acoustic skin less that of the exposed faces|, over the
                      // sum of |flux|, the largest of the six
  double velocity = 0.0;  // RMS of the means over faces without lids, relative
};

/// v_n = map * (nodal velocities), linear on each face of the acoustic skin, with flux and first
/// moments of the points x_p that land on it:
///
///   int N_b v_n dS = sum_p N_b(landing of x_p) w_p n_p . v(x_p),   b: corners of the face
///
/// On lids v_n is constant on each face, with the flux kept.
struct VelocityMap {
  SparseRows map;             // 3 n_c x 3 n_s: row 3 c + b is corner b of face c
  Eigen::VectorXd covered;    // n_c: share of each face in front of exposed faces, about 0 to 1
  std::vector<int32_t> lids;  // faces that are covered to less than a half, ascending
  double lid_area = 0.0;      // [m2]
  MapErrors errors;           // before lids move
  FlowMap flow;               // int N_n v_n dS of the same motion at nodes, by faces of the body
};

/// Builds the map; exposed faces are sampled at points a fifth of an acoustic edge apart.
/// @throws InputError when no face is exposed
VelocityMap velocity_map(const rom::Skin& skin, const Exposure& exposed,
                         const sound::Surface& acoustic, LidMotion lids);

}  // namespace clatter::recover
