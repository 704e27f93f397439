// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Contact of an outline with one part of a profile.
#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "dynamics/profile/contact_zones.hpp"
#include "dynamics/profile/section_sum.hpp"

namespace clatter::dynamics {

/// The sum over one part of a profile.
class PartContact {
 public:
  PartContact(const Profile& profile, const MattressLaw& law, const GaussRule& rule,
              const PlacedOutline& link)
      : profile_(profile), rule_(rule), link_(link), sum_(law, link) {}

  template <bool kTangent>
  void run() {
    ZoneSearch(profile_, link_).run([this](const ContactZone& zone) { integrate<kTangent>(zone); });
  }

  const SectionSum& sum() const { return sum_; }
  bool touches() const { return sum_.depth > 0.0; }
  bool inner_side() const { return inner_side_; }

 private:
  template <bool kTangent>
  void integrate(const ContactZone& zone) {
    const ProfileCell& cell = profile_.cells()[zone.cell];
    switch (cell.kind) {
      case ProfileCell::Kind::kLine:
        return sections<kTangent>(zone, [&](double y) { return line_point(cell, y); });
      case ProfileCell::Kind::kArc:
        return sections<kTangent>(zone, [&](double y) { return arc_point(cell, y); });
      default: {
        size_t cubic = static_cast<size_t>(cell.cubic);
        return sections<kTangent>(zone, [this, cubic](double y) mutable {
          while (y > profile_.cubics()[cubic].end) ++cubic;
          return cubic_point(profile_.cubics()[cubic], y);
        });
      }
    }
  }

  /// `curve` is called with ascending parameters.
  template <bool kTangent, class Curve>
  void sections(const ContactZone& zone, Curve curve) {
    ZoneSections z;
    z.part = zone.part;
    z.middle = 0.5 * (zone.begin.at + zone.end.at);
    z.half = 0.5 * (zone.end.at - zone.begin.at);
    z.node = Lanes::Map(rule_.node.data());
    z.weight = Lanes::Map(rule_.weight.data());
    if constexpr (kTangent) {
      Curve again = curve;
      const Eigen::Vector3d begin = end_by_pose(zone.part, zone.begin, again);
      const Eigen::Vector3d end = end_by_pose(zone.part, zone.end, again);
      z.middle_by_pose = 0.5 * (begin + end);
      z.half_by_pose = 0.5 * (end - begin);
    }
    for (int i = 0; i < Lanes::SizeAtCompileTime; ++i) {
      const CurvePoint at = curve(z.middle + z.half * z.node[i]);
      z.px[i] = at.position.x();
      z.py[i] = at.position.y();
      z.dx[i] = at.derivative.x();
      z.dy[i] = at.derivative.y();
      z.speed[i] = at.speed;
      z.stretch[i] = at.stretch;
    }
    sum_.add<kTangent>(z);
    check_side(z, rule_.size / 2);
  }

  template <class Curve>
  Eigen::Vector3d end_by_pose(OutlinePart part, const ZoneEnd& end, Curve& curve) const {
    if (end.kind == ZoneEnd::Kind::kCurveEnd) return Eigen::Vector3d::Zero();
    const CurvePoint at = curve(end.at);
    const CoreDistance<double> core(link_, part, at.position.x(), at.position.y());
    Eigen::Vector3d change(core.mx, core.my, core.lever);  // of the distance
    if (end.kind == ZoneEnd::Kind::kPartChange)            // of the coordinate along the link
      change << link_.axis, -link_.normal().dot(at.position - link_.origin);
    const double slope = change.head<2>().dot(at.derivative);
    // Ends of a contact that grazes, of no length to rounding, stay.
    if (std::abs(slope) <= 1e-10 * at.speed) return Eigen::Vector3d::Zero();
    return change / slope;
  }

  /// An end of an open profile may be hit at a right angle to its normal, and a little beyond.
  void check_side(const ZoneSections& z, int i) {
    const Eigen::Vector2d point(z.px[i], z.py[i]), away = link_.closest(point) - point;
    if (profile_.outward({z.dx[i], z.dy[i]}).dot(away) < -0.5 * z.speed[i] * away.norm())
      inner_side_ = true;
  }

  const Profile& profile_;
  const GaussRule& rule_;
  const PlacedOutline& link_;
  SectionSum sum_;
  bool inner_side_ = false;
};

}  // namespace clatter::dynamics
