// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts of links with profiles: nanoseconds of one force, with and without its tangent.
//   mattress_contact
#include "dynamics/profile/mattress.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "bench/median.hpp"
#include "dynamics/profile/tooth_gap.hpp"

namespace {

using namespace clatter::dynamics;
using Eigen::Vector2d;

constexpr int kContacts = 60;  // of a timing drive

/// Poses at which an outline penetrates a profile by `depth` between two arc lengths.
std::vector<PlanarPose> poses(const Profile& profile, const LinkOutline& outline, double from,
                              double to, double depth) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(from, to), tilt(-2e-3, 2e-3);
  std::vector<PlanarPose> result;
  for (int i = 0; i < kContacts; ++i) {
    const ProfilePoint at = profile.at(along(random));
    const double angle = std::atan2(-at.tangent.y(), -at.tangent.x()) + tilt(random);
    const Vector2d axis(std::cos(angle), std::sin(angle));
    const double x = axis.dot(at.normal) > 0.0 ? outline.from : outline.to;
    const Vector2d origin = at.position + (outline.radius - depth) * at.normal - x * axis;
    result.push_back({origin, axis.x(), axis.y()});
  }
  return result;
}

double nanoseconds(const MattressContact& contact, const std::vector<PlanarPose>& at, bool tangent,
                   int repeats) {
  const PlanarRate rate{{0.05, -0.1}, 20.0};
  std::vector<ContactHint> hints(at.size());
  MattressForce force;
  double sum = 0.0;
  const double us = median_us(repeats, 0, [&] {
    for (size_t i = 0; i < at.size(); ++i) {
      contact.evaluate(at[i], rate, tangent, hints[i], force);
      sum += force.wrench.x();
    }
  });
  if (!std::isfinite(sum)) std::puts("not finite");
  return 1e3 * us / static_cast<double>(at.size());
}

void report(const char* name, const Profile& profile, const LinkOutline& outline, double from,
            double to, double depth) {
  const MattressLaw law{5e12, 4.6e-3, 0.5, 0.1};
  const MattressContact contact(profile, outline, law);
  const std::vector<PlanarPose> at = poses(profile, outline, from, to, depth);
  const int repeats = 2001;
  std::printf("%-24s %8.1f %8.1f\n", name, nanoseconds(contact, at, false, repeats),
              nanoseconds(contact, at, true, repeats));
}

PointsSegment ellipse(int count) {
  PointsSegment result;
  result.closed = true;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    result.points.emplace_back(0.03 * std::cos(angle), 0.02 * std::sin(angle));
  }
  return result;
}

}  // namespace

int main() {
  const Profile wheel = sprocket(iso606_gap(8e-3, 5e-3, 20));
  const Profile guide({ArcSegment{{0.0, -0.28}, 0.28, 1.4, 0.35}});
  const Profile curve({ellipse(60)}, {.closed = true});
  const LinkOutline bush = LinkOutline::circle(-4e-3, 2.5e-3);
  const LinkOutline plate = LinkOutline::plate(-4e-3, 4e-3, 3.6e-3);
  const auto& cells = wheel.cells();
  const double seat = cells[2].start, flank = cells[3].start;
  std::printf("%-24s %8s %8s\n", "ns a contact", "force", "tangent");
  report("bush in the seat", wheel, bush, seat + 1e-3, flank - 1e-3, 1e-5);
  report("bush at their border", wheel, bush, flank - 1e-4, flank + 1e-4, 1e-5);
  report("bush on the flank", wheel, bush, flank + 3e-4, cells[4].start - 3e-4, 1e-5);
  report("plate on a guide", guide, plate, 1e-2, guide.length() - 1e-2, 3e-6);
  report("bush on a spline", curve, bush, 0.0, curve.length(), 1e-5);
  report("plate on a spline", curve, plate, 0.0, curve.length(), 1e-5);
  report("plate without contact", guide, plate, 1e-2, guide.length() - 1e-2, -1e-4);
}
