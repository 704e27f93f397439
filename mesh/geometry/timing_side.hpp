// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The timing side of a block: a front plate with the seats of the chain's guides and tensioner, and
// a cylinder head, cast on, with the bearings of two camshafts. Table [block.timing].
//
// Positions are in the front view: the observer stands before the front face (x = -half_length,
// normal -x), sees X to the right and Y up, both from the crank axis. In the engine frame
//
//     y = -X,  z = Y;   X x Y = -x points to the observer (right-handed).
//
// A crankshaft that turns clockwise in this view turns about +x, and +y is its thrust side.
//
//      -o-        -o-    cams   head_top  ____o____________o____   bulkheads with cam bearings at
//    +--------------------+               |   | open above  |  |   the main bearings' x
//    |  o arm_pivot       |               |===+=============+==|  cam_deck
//    |          bolt_2 o  |               |   | hollow, tower|  |  head_jacket
//    |  [] tensioner      |  deck_height  |===+=============+==|  fire_deck
//    |      bolt_1 o      |               :   bores    :
//    |         O crank    |  front view   :            :  side view
//    +--------------------+
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

struct BlockParameters;

/// Lengths in the part's unit; defaults in millimetres of a 1.2 litre three-cylinder engine.
struct TimingSide {
  // Centres in the front view (X, Y).
  Eigen::Vector2d cam_intake, cam_exhaust, guide_bolt_1, guide_bolt_2, arm_pivot, tensioner;
  double cam_bore = 24, cam_boss = 44, cam_bearing_width = 16;  // diameters; length along x
  // Diameters of the openings before the end bearings; default: between bore and boss.
  double cam_seal = 0, crank_seal = 0;
  double head_half_width = 0, head_wall = 7;  // default: head_wall beside the cam bosses
  double fire_deck = 14, head_jacket = 50, cam_deck = 10;  // heights of the head's decks and hollow
  double plug_tower = 28;                                  // diameter, between the two decks
  // From the pan flange to head_top; default: half a thickness beside the seats, at least a whole
  // one beside the head.
  double plate_half_width = 0, plate_thickness = 12;
  double bolt_boss = 18, pivot_boss = 24;              // diameters
  double tensioner_width = 40, tensioner_height = 36;  // of its seat
  double boss_length = 5;                              // of all seats before the front face

  /// The head ends at the lower of both camshaft axes.
  double head_top() const { return std::min(cam_intake.y(), cam_exhaust.y()); }
  std::array<Eigen::Vector2d, 2> cams() const { return {cam_intake, cam_exhaust}; }
};

/// A point of the front view in the engine frame, at x.
inline Eigen::Vector3d from_front_view(const Eigen::Vector2d& point, double x) {
  return {x, -point.x(), point.y()};
}

/// The keys of [block.timing].
const keys::Keys<TimingSide>& timing_keys();
/// Sets what follows from other dimensions; InputError when they do not fit the block or each
/// other.
void finish_timing_side(const Config& table, const BlockParameters& block, TimingSide& timing);

/// Solids that touch or overlap the block: head, plate, cam bosses and seats. `block.timing` is
/// set, here and below.
Solids timing_walls(GmshSession& session, const BlockParameters& block);
/// What is cut from block and walls: the head's hollows, cam bores and the openings before them.
Solids timing_openings(GmshSession& session, const BlockParameters& block);
/// The openings before the first and last main bearing.
Solids crank_seals(GmshSession& session, const BlockParameters& block);

/// cam_intake_k, cam_exhaust_k, guide_bolt_1, guide_bolt_2, arm_pivot, tensioner (front faces of
/// their seats), timing_face (all faces at x = -half_length).
std::vector<NamedSurface> timing_surfaces(const BlockParameters& block);
/// Boxes around faces that covers hide from the air: the chain case and the space of the camshafts.
std::vector<BoxFilter> under_timing_covers(const BlockParameters& block);

}  // namespace clatter::mesh
