// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where the oil of a contact is and where it went.
#include <cmath>

namespace clatter::film {

/// Volumes of oil [m3] since the start of a run:
///
///   gap + liner = first + supplied - scraped - dripped - sides - ends - grooves
struct OilBalance {
  double gap = 0.0, liner = 0.0;  // now, between the skirt and the liner, and on the free liner
  double first = 0.0;             // both at the start
  double supplied = 0.0;          // by the splash
  double scraped = 0.0;           // by the rings
  double dripped = 0.0;           // from layers thicker than the liner holds
  double sides = 0.0;             // out over the sides of the pads
  double ends = 0.0;              // out over the ends of the liner, less what was brought back
  double grooves = 0.0;           // into grooves, less what they supplied
  double moved = 0.0;             // sum of all flows without sign, those over the edges included

  double missing() const {
    return gap + liner - (first + supplied - scraped - dripped - sides - ends - grooves);
  }
  /// |missing| over what moved; 0 before anything did.
  double residue() const { return moved > 0.0 ? std::abs(missing()) / moved : 0.0; }

  OilBalance& operator+=(const OilBalance& other) {
    for (double OilBalance::*part :
         {&OilBalance::gap, &OilBalance::liner, &OilBalance::first, &OilBalance::supplied,
          &OilBalance::scraped, &OilBalance::dripped, &OilBalance::sides, &OilBalance::ends,
          &OilBalance::grooves, &OilBalance::moved})
      this->*part += other.*part;
    return *this;
  }
};

}  // namespace clatter::film
