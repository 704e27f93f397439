// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The crankshaft: one rigid body in main bearings, whose rotation may be free.
#include <string>

#include "dynamics/body/modal_body.hpp"

namespace clatter::dynamics {

/// Which motions a crankshaft has besides the rotation of the engine's clock, and its inertia about
/// its centre of mass, which lies on the axis at x = `centre`. The axis of a crank that turns
/// uniformly is the x axis of the engine.
struct CrankBody {
  static constexpr const char* kName = "crankshaft";

  bool in_bearings = false;  // displacements y, z and tilts ry, rz; else the block carries its axis
  bool is_free = false;      // the rotation from that of the clock; else the clock's is its own
  double mass = 0.0;         // [kg]
  double polar = 0.0, diametral = 0.0;  // with the flywheel, about the axis, across it [kg m2]
  double centre = 0.0;                  // x of the centre of mass [m]
  std::string where;                    // "file:line", for messages

  // DoFs of its body.
  static constexpr int kY = 0, kZ = 1, kTiltY = 2, kTiltZ = 3;  // in bearings
  int turn() const { return in_bearings ? 4 : 0; }              // rotation about +x, free
};

/// The body with the DoFs y, z [m], ry, rz [rad] in bearings and rx [rad] if free: small motions in
/// axes that do not turn but for rx, so that the mass m, m, I_d, I_d, I_p is constant
/// (Genta 2005, chapter 2). The mass of one without bearings is only a scale of the error test.
/// InputError at `where` unless the masses and moments that it has are positive.
ModalBody make_crank_body(const CrankBody& crank);

}  // namespace clatter::dynamics
