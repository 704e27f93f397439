// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The timing drive of the reference, as a scene: crank, arm, intake, exhaust, guide.
#include <string>

namespace clatter::dynamics::testing {

struct TimingDrive {
  double rpm = 0.0;             // of the crank, clockwise
  double gap_deg = -20.94;      // of a tooth gap of the crank that is wrapped
  std::string first = "outer";  // link from there in running direction
  int links = 130;              // of 8 mm
  double finer = 1.0;           // as many times these links and teeth, of a pitch as much smaller
  double joint_n_m = 1e7;       // of those of 8 mm
  double joint_clearance_um = 0.0;
  double plunger_n_m = 2000.0;   // rate of the tensioner, softening outwards
  double plunger_back_mm = 0.0;  // by which its force is that of a plunger farther back
  std::string tensioner;         // keys of a hydraulic one in place of the spring
  double bearing_n_m = 1e10;     // of wheels and arm
  double friction = 0.0;         // in all contacts
  double slip_speed_m_s = 0.02;  // of all friction
  double start_turns = 0.0;      // of the crank and the cams at the start
  double exhaust_spin = 0.0;     // of that cam more than the chain's, against running [rad/s]
  bool mirrored = false;         // about the y axis: left is right
  double end_s = 1e-3;
  double tolerance = 1e-3;
  double output_us = 20.0;
  std::string chain_keys;  // further keys of [[chain]]
  std::string more;        // further tables

  /// The scene's text.
  std::string scene() const;
};

}  // namespace clatter::dynamics::testing
