// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where an outline and a profile overlap.
#include <cstddef>

#include "dynamics/profile/section_sum.hpp"

namespace clatter::dynamics {

/// An end of a zone: an end of the curve, or the edge of the outline, or where its closest part
/// changes. The last two move with the link.
struct ZoneEnd {
  enum class Kind { kCurveEnd, kEdge, kPartChange };

  double at;  // parameter of the curve
  Kind kind;
};

/// A smooth part of an overlap: one curve of the profile against one part of the outline.
struct ContactZone {
  std::size_t cell;  // of `begin`; a zone of cubics may reach into later cells of the same curve
  OutlinePart part;
  ZoneEnd begin, end;
};

/// Finds the zones of one cell after the other and joins those that continue each other.
///
/// Ends are roots: of quadratics in the parameter on lines and arcs; on cubics by Newton's method
/// in brackets from the ends and the extremum of the distance in each cell, whose curve hardly
/// turns. A zone's end is found to about 1e-10 of the cell; forces see the square of its error.
class ZoneSearch {
 public:
  ZoneSearch(const Profile& profile, const PlacedOutline& link)
      : profile_(&profile), link_(&link) {}

  /// Calls `found(zone)` for all zones of the first part of the profile.
  template <class Found>
  void run(const Found& found);

 private:
  /// In ascending order: the ends of a cell and where its zones may change.
  struct Breaks {
    static constexpr int kMost = 14;  // two of each of six quadratics, and the ends
    ZoneEnd at[kMost];
    int size;
  };

  bool reaches(const Circle& circle) const;
  bool reaches(const ProfileCell& cell) const;
  Breaks breaks(const ProfileCell& cell) const;
  void cubic_breaks(const ProfileCell& cell, Breaks& breaks) const;
  /// Whether the middle between two breaks is inside the outline, and next to which part.
  bool inside(const ProfileCell& cell, double at, OutlinePart& part) const;

  const Profile* profile_;
  const PlacedOutline* link_;
};

template <class Found>
void ZoneSearch::run(const Found& found) {
  const auto& nodes = profile_->tree().nodes();
  const auto& cells = profile_->cells();
  ContactZone zone{};
  bool open = false;
  const int count = static_cast<int>(nodes.size());
  for (int i = 0; i < count;) {
    const CircleTree::Node& node = nodes[static_cast<std::size_t>(i)];
    if (!reaches(node.circle)) {
      i = node.next;
      continue;
    }
    ++i;
    if (node.cell < 0) continue;
    const auto index = static_cast<std::size_t>(node.cell);
    const ProfileCell& cell = cells[index];
    if (!reaches(cell)) continue;
    const Breaks at = breaks(cell);
    for (int k = 0; k + 1 < at.size; ++k) {
      OutlinePart part;
      if (!inside(cell, 0.5 * (at.at[k].at + at.at[k + 1].at), part)) continue;
      const bool continues = open && zone.part == part && zone.end.at == at.at[k].at &&
                             cells[zone.cell].curve == cell.curve;
      if (!continues) {
        if (open) found(zone);
        zone = {index, part, at.at[k], {}};
        open = true;
      }
      zone.end = at.at[k + 1];
    }
  }
  if (open) found(zone);
}

/// A lower bound of the distance between outline and the first part of the profile [m]; 0 where it
/// is not known.
double least_clearance(const Profile& profile, const PlacedOutline& link);

}  // namespace clatter::dynamics
