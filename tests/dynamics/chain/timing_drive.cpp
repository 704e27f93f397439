// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/chain/timing_drive.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace clatter::dynamics::testing {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// A scene to which tables are appended, mirrored about the y axis or not.
class Text {
 public:
  explicit Text(const TimingDrive& drive) : drive_(drive), side_(drive.mirrored ? -1.0 : 1.0) {}

  void head() {
    text_ += fmt::format(R"(
[time]
end_s = {}
output_step_us = {}
largest_step_us = 20
[accuracy]
tolerance = {}
displacement_um = 10
velocity_m_s = 0.1
[[drive]]
name = "crank"
speed_rpm = {}
axis = "z"
start_deg = {}
)",
                         drive_.end_s, drive_.output_us, drive_.tolerance, -side_ * drive_.rpm,
                         -side_ * 360.0 * drive_.start_turns);
  }

  void body(const std::string& name, double x, double y, double mass, double inertia, double spin) {
    text_ += fmt::format(R"(
[[rigid_body]]
name = "{0}"
motion = "xy"
mass_kg = {3}
inertia_kg_m2 = {4}
centre_mm = [{1}, {2}, 0]
angle_deg = {7}
start_spin_rad_s = {5}
[[bushing]]
name = "{0}"
a = {{ body = "{0}", at_mm = [{1}, {2}, 0] }}
b = {{ }}
stiffness_n_m = {6}
damping_n_s_m = 1e4
)",
                         name, side_ * x, y, mass, inertia, side_ * spin, drive_.bearing_n_m,
                         spin == 0.0 ? 0.0 : -side_ * 180.0 * drive_.start_turns);
  }

  /// Pushes the arm along x with 109.635 N at its place of 0 deg, as a long spring.
  void tensioner() {
    if (drive_.hydraulic) {
      text_ += fmt::format(R"(
[[tensioner]]
name = "tensioner"
a = {{ at_mm = [{0}, 160, 0] }}
b = {{ body = "arm", at_mm = [{0}, 160, 0] }}
axis = [{1}, 0, 0]
)",
                           side_ * -55.0, side_);
      return;
    }
    const double force = 90.0 + 19.634954 - 2000e-3 * drive_.plunger_back_mm;
    text_ += fmt::format(R"(
[[spring]]
name = "tensioner"
a = {{ at_mm = [{}, 160, 0] }}
b = {{ body = "arm", at_mm = [{}, 160, 0] }}
stiffness_n_m = {}
length_mm = {:.9f}
)",
                         side_ * -1055.0, side_ * -55.0, drive_.plunger_n_m,
                         1000.0 + 1e3 * force / drive_.plunger_n_m);
  }

  void chain() {
    const double f = drive_.finer;
    text_ += fmt::format(
        R"(
[[chain]]
name = "chain"
links = {}
first = "{}"
pitch_mm = {}
bush_mm = {}
plate_half_height_mm = {}
inner = {{ mass_kg = {}, inertia_kg_m2 = {} }}
outer = {{ mass_kg = {}, inertia_kg_m2 = {} }}
joint = {{ stiffness_n_m = {}, clearance_um = {}, damping_n_s_m = 200, friction = {}, pin_mm = {}{} }}
{}
)",
        finer(drive_.links), drive_.first, 8.0 / f, 5.0 / f, 3.6 / f, 2.2e-3 / f,
        4.0e-8 / (f * f * f), 2.6e-3 / f, 4.8e-8 / (f * f * f), f * drive_.joint_n_m,
        drive_.joint_clearance_um, drive_.friction, 3.3 / f,
        drive_.friction > 0.0 ? fmt::format(", slip_speed_m_s = {}", drive_.slip_speed_m_s) : "",
        drive_.chain_keys);
  }

  void sprocket(const std::string& name, double x, double y, int teeth) {
    text_ += fmt::format(R"(
[[chain.over]]
sprocket = "{0}"
on = {{ body = "{0}", at_mm = [{1}, {2}, 0] }}
turn = "{3}"
teeth = {4}
contact = {{ bed_n_m3 = 5e12, width_mm = 4.6, damping_s_m = 0.5, friction = {5}, slip_speed_m_s = {6} }}
)",
                         name, side_ * x, y, drive_.mirrored ? "counter-clockwise" : "clockwise",
                         finer(teeth), drive_.friction, drive_.slip_speed_m_s);
    if (name != "crank") return;
    const double gap = drive_.mirrored ? 180.0 - drive_.gap_deg : drive_.gap_deg;
    text_ += fmt::format("gap_deg = {}\n", gap);
  }

  /// An arc from y = `from` to y = `to`, on the side of larger x for a centre on the left.
  void guide(const std::string& name, const std::string& on, double x, double y, double radius,
             double from, double to) {
    const auto angle = [&](double at) {
      const double rise = std::asin((at - y) / radius) * kDegrees;
      return side_ * x < 0.0 ? rise : 180.0 - rise;
    };
    text_ +=
        fmt::format(R"(
[[chain.over]]
guide = "{}"
on = {{ {} }}
turn = "{}"
contact = {{ bed_n_m3 = 5.357e11, width_mm = 2.4, damping_s_m = 0.5, friction = {}, slip_speed_m_s = {} }}
[[chain.over.segment]]
arc = {{ centre_mm = [{}, {}], radius_mm = {}, from_deg = {}, to_deg = {} }}
)",
                    name, on, drive_.mirrored ? "clockwise" : "counter-clockwise", drive_.friction,
                    drive_.slip_speed_m_s, side_ * x, y, radius, angle(from), angle(to));
  }

  std::string text() const { return text_; }

 private:
  int finer(int count) const { return static_cast<int>(std::lround(drive_.finer * count)); }

  const TimingDrive& drive_;
  double side_;
  std::string text_;
};

}  // namespace

std::string TimingDrive::scene() const {
  Text text(*this);
  const double spin = -rpm * std::numbers::pi / 60.0;
  text.head();
  text.body("intake", -60.0, 326.0, 1.0, 1.30e-3, spin);
  text.body("exhaust", 60.0, 326.0, 1.0, 1.30e-3, spin + exhaust_spin);
  // The plunger, 20 g, moves with the arm.
  text.body("arm", -85.0, 245.0, 0.2, 4.5e-4 + 0.02 * 0.085 * 0.085, 0.0);
  text.tensioner();
  text.chain();
  text.sprocket("crank", 0.0, 0.0, 20);
  text.guide("arm", "body = \"arm\", at_mm = [0, 0, 0]", -310.1, 88.9, 280.0, 20.0, 240.0);
  text.sprocket("intake", -60.0, 326.0, 40);
  text.sprocket("exhaust", 60.0, 326.0, 40);
  text.guide("guide", "", 1221.8, -152.5, 1200.0, 250.0, 60.0);
  return text.text() + more;
}

}  // namespace clatter::dynamics::testing
