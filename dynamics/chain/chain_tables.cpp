// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of [[chain]].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/chain/chain_spec.hpp"
#include "dynamics/chain/guide_shape.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/given/csv_table.hpp"
#include "dynamics/profile/tooth_gap.hpp"

namespace clatter::dynamics {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

const Range kLength = Range::between(1e-3, 1e5);  // [mm]

[[noreturn]] void refuse(const std::filesystem::path& path, int line, const std::string& text) {
  throw InputError(fmt::format("{}:{}: {}", path.string(), line, text));
}

/// A row per link, 0, 1, ...: what its pitch is more than the chain's [m].
std::vector<double> read_pitch_table(const ChainSpec& chain, const std::string& column) {
  CsvColumns table = read_csv(chain.pitch_table, column);
  if (table.unit != "m")
    refuse(chain.pitch_table, 1,
           fmt::format("{}: found [{}], expected a length", table.name, table.unit));
  const auto links = static_cast<size_t>(chain.make.links());
  for (size_t j = 0; j < std::min(links, table.x.size()); ++j)
    if (table.x[j] != static_cast<double>(j))
      refuse(chain.pitch_table, table.lines[j],
             fmt::format("found link {:g}, expected {}: a row for each link from 0 on", table.x[j],
                         j));
  if (table.x.size() != links)
    refuse(chain.pitch_table, table.lines.back(),
           fmt::format("found {} rows, expected {}, a row for each link", table.x.size(), links));
  return table.y;
}

/// What the pitches of the links in turn are more than the chain's [m].
std::vector<double> read_pitch_errors(const Config& table, ChainSpec& chain) {
  if (table.has("pitch_table")) {
    if (table.has("pitch_errors_um"))
      table.fail("pitch_errors_um", "found with pitch_table, expected one of both");
    chain.pitch_table = table.path("pitch_table");
    return read_pitch_table(chain, table.text_or("pitch_column", ""));
  }
  std::vector<double> errors = table.numbers_or("pitch_errors_um", {});
  for (double& error : errors) error *= 1e-6;
  return errors;
}

/// The pitches of all links: the chain's, errors of the links in turn, wear of inner or outer ones.
std::vector<double> read_pitches(const Config& table, ChainSpec& chain, double pitch) {
  const Range part = Range::between(-2e3, 2e3);
  const double inner = table.number_or("inner_wear_um", 0.0, part) * 1e-6,
               outer = table.number_or("outer_wear_um", 0.0, part) * 1e-6;
  const std::vector<double> errors = read_pitch_errors(table, chain);
  std::vector<double> pitches;
  for (int j = 0; j < chain.make.links(); ++j) {
    const auto at = static_cast<size_t>(j);
    const double wear = chain.make.kinds[at] == LinkKind::kInner ? inner : outer;
    const double error = errors.empty() ? 0.0 : errors[at % errors.size()];
    if (!(std::abs(error) < 0.25 * pitch))
      table.fail(
          chain.pitch_table.empty() ? "pitch_errors_um" : "pitch_table",
          fmt::format("found {:g} um, expected less than a quarter of the pitch", error * 1e6));
    pitches.push_back(pitch + wear + error);
  }
  return pitches;
}

LinkMass read_mass(const Config& table) {
  return {table.number("mass_kg", Range::between(1e-9, 1e3)),
          table.number("inertia_kg_m2", Range::between(1e-15, 1e3))};
}

void read_links(const Config& table, ChainSpec& chain) {
  const int64_t links = table.integer("links", Range::between(4, 100000));
  if (links % 2 != 0)
    table.fail("links", fmt::format("found {}, expected an even number: inner and outer links "
                                    "alternate",
                                    links));
  const bool inner_first = table.choice("first", {"inner", "outer"}) == "inner";
  for (int64_t j = 0; j < links; ++j)
    chain.make.kinds.push_back((j % 2 == 0) == inner_first ? LinkKind::kInner : LinkKind::kOuter);
  chain.make.inner = read_mass(table.table("inner"));
  chain.make.outer = read_mass(table.table("outer"));
}

JointLaw read_joint(const Config& table) {
  JointLaw law;
  law.stiffness = table.number("stiffness_n_m", Range::between(1.0, 1e15));
  law.clearance = table.number_or("clearance_um", 0.0, Range::between(0.0, 1e4)) * 1e-6;
  law.damping = table.number_or("damping_n_s_m", 0.0, Range::between(0.0, 1e9));
  law.friction = table.number_or("friction", 0.0, Range::between(0.0, 10.0));
  if (law.friction > 0.0) {
    law.radius = 0.5 * table.number("pin_mm", kLength) * kMilli;
    law.slip_speed = table.number_or("slip_speed_m_s", 0.02, Range::between(1e-9, 1e3));
  } else {
    static_cast<void>(table.number_or("pin_mm", 2e3 * law.radius, kLength));
  }
  return law;
}

MattressLaw read_contact(const Config& table) {
  MattressLaw law{};
  law.stiffness = table.number("bed_n_m3", Range::between(1.0, 1e20));
  law.width = table.number("width_mm", kLength) * kMilli;
  law.damping = table.number_or("damping_s_m", 0.0, Range::between(0.0, 1e6));
  law.friction = table.number_or("friction", 0.0, Range::between(0.0, 10.0));
  law.slip_speed = table.number_or("slip_speed_m_s", 0.02, Range::between(1e-9, 1e3));
  law.sections = static_cast<int>(table.integer_or("sections", 7, Range::between(2, 8)));
  return law;
}

GapForm form_of(const std::string& name) {
  if (name == "minimum") return GapForm::kMinimum;
  return name == "mean" ? GapForm::kMean : GapForm::kMaximum;
}

/// A gap as ISO 606 makes it, with the measures that the table gives in place of its own.
ToothGap read_gap(const Config& table, double pitch, double bush) {
  const auto form = form_of(table.choice("form", {"mean", "minimum", "maximum"})),
             tip = form_of(table.choice("tip_form", {"mean", "minimum", "maximum"}));
  const int64_t teeth = table.integer("teeth", Range::between(5, 10000));
  ToothGap gap = with_context(table.where("teeth"), [&] {
    return iso606_gap(pitch, bush, static_cast<int>(teeth), form, tip);
  });
  const auto take = [&](const char* key, double& value, double unit) {
    if (table.has(key)) value = table.number(key, Range::between(1e-6, 1e6)) * unit;
  };
  take("seat_radius_mm", gap.seat_radius, kMilli);
  take("flank_radius_mm", gap.flank_radius, kMilli);
  take("seat_angle_deg", gap.seat_half_angle, 0.5 * kDegree);
  take("tip_diameter_mm", gap.tip_diameter, kMilli);
  return gap;
}

void read_sprocket(const Config& table, const ChainSpec& chain, double pitch, ChainOver& over) {
  const ToothGap gap = read_gap(table, pitch, 2.0 * chain.bush_radius);
  over.teeth = gap.teeth;
  over.pitch_radius = 0.5 * gap.pitch_diameter;
  over.profile = with_context(table.where("teeth"),
                              [&] { return std::make_shared<const Profile>(sprocket(gap)); });
  if (!over.on.at) table.fail("on", "found no at_mm, expected the centre of the sprocket");
  if (table.has("gap_deg")) over.gap = table.number("gap_deg", Range::between(-1e6, 1e6)) * kDegree;
  over.belt = {{chain.in_plane(*over.on.at), over.pitch_radius, over.turn, 0,
                over.teeth * pitch / (2.0 * std::numbers::pi), false}};
}

ChainOver read_over(const Config& table, const ChainSpec& chain, double pitch) {
  ChainOver over;
  over.where = table.where();
  const bool is_sprocket = table.has("sprocket"), is_guide = table.has("guide");
  if (is_sprocket == is_guide)
    throw InputError(over.where + ": found " +
                     (is_guide ? "sprocket and guide" : "neither of them") +
                     ", expected one of the keys sprocket and guide, its name");
  over.name = table.text(is_sprocket ? "sprocket" : "guide");
  over.on = read_point(table, "on");
  over.turn = table.choice("turn", {"clockwise", "counter-clockwise"}) == "clockwise"
                  ? Turn::kClockwise
                  : Turn::kCounterClockwise;
  over.law = read_contact(table.table("contact"));
  if (is_sprocket) {
    read_sprocket(table, chain, pitch, over);
  } else {
    read_guide(table, chain.half_height, over);
    if (!over.on.at && over.on.set.empty()) over.on.at = Vector3d::Zero();
  }
  return over;
}

/// Between the instants at which the shape is recorded.
void read_shapes(const Config& table, ChainSpec& chain) {
  const Range none_or_more = Range::between(0.0, 1e9);
  if (table.has("shape_every_us"))
    chain.shape_every = table.number("shape_every_us", none_or_more) * kMicro;
  if (!table.has("shape_every_deg")) return;
  if (chain.shape_every)
    table.fail("shape_every_deg", "found shape_every_us too, expected one of them");
  chain.shape_every_deg = table.number("shape_every_deg", none_or_more);
}

ChainSpec read_chain(const Config& table) {
  ChainSpec chain;
  chain.name = read_name(table);
  chain.where = table.where();
  const std::string plane = table.choice("plane", {"xy", "yz", "zx"});
  chain.normal = plane == "xy" ? 2 : plane == "yz" ? 0 : 1;
  const double pitch = table.number("pitch_mm", kLength) * kMilli;
  read_links(table, chain);
  chain.make.pitches = read_pitches(table, chain, pitch);
  chain.joint = read_joint(table.table("joint"));
  chain.bush_radius = 0.5 * table.number("bush_mm", Range::between(1e-3, 999.0 * pitch)) * kMilli;
  chain.half_height = table.number("plate_half_height_mm", kLength) * kMilli;
  for (const Config& one : table.tables("over")) {
    ChainOver over = read_over(one, chain, pitch);
    const char* const key = over.teeth > 0 ? "sprocket" : "guide";
    if (over.name.empty() || over.name == "." || over.name.find('/') != std::string::npos)
      one.fail(key, fmt::format("found \"{}\", expected a name without /", over.name));
    for (const ChainOver& before : chain.over)
      if (before.name == over.name)
        one.fail(key, fmt::format("found \"{}\" for the second time", over.name));
    chain.over.push_back(std::move(over));
    for (BeltCircle& circle : chain.over.back().belt)
      circle.owner = static_cast<int>(chain.over.size()) - 1;
  }
  read_shapes(table, chain);
  if (chain.over.empty() || chain.over.front().teeth == 0)
    throw InputError(chain.where + ": found " +
                     (chain.over.empty() ? "no over" : "a guide as the first over") +
                     ", expected [[chain.over]] tables, a sprocket first");
  return chain;
}

}  // namespace

std::vector<std::string> ChainSpec::over_names() const {
  std::vector<std::string> names;
  for (const ChainOver& one : over) names.push_back(one.name);
  return names;
}

PlaneAxes ChainSpec::plane() const {
  return {Vector3d::Zero(), Vector3d::Unit((normal + 1) % 3), Vector3d::Unit((normal + 2) % 3)};
}

Vector2d ChainSpec::in_plane(const Vector3d& vector) const {
  return {vector((normal + 1) % 3), vector((normal + 2) % 3)};
}

std::vector<ChainSpec> read_chain_specs(const Config& root) {
  std::vector<ChainSpec> chains;
  for (const Config& table : root.tables("chain")) chains.push_back(read_chain(table));
  return chains;
}

}  // namespace clatter::dynamics
