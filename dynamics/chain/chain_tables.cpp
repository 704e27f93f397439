// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of [[chain]].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// A sprocket or a guide as its keys say.
struct OverTable : ChainOver {
  std::string sprocket, guide;
  GapForm form = GapForm::kMean, tip_form = GapForm::kMean;
  std::optional<double> seat_radius, flank_radius, seat_half_angle, tip_diameter;
  std::vector<SegmentTable> segments;
};

struct ChainTable : ChainSpec {
  double pitch = 0.0;  // [m]
  int links = 0;
  LinkKind first = LinkKind::kInner;
  double inner_wear = 0.0, outer_wear = 0.0;  // [m]
  std::vector<double> errors;                 // of the links in turn [m]
  std::string pitch_column;
  std::vector<OverTable> described;
};

/// The pitches of all links: the chain's, errors of the links in turn, wear of inner or outer ones.
void make_pitches(const Config& table, ChainTable& chain) {
  if (!chain.pitch_table.empty()) chain.errors = read_pitch_table(chain, chain.pitch_column);
  for (int j = 0; j < chain.links; ++j) {
    const auto at = static_cast<size_t>(j);
    const double wear =
        chain.make.kinds[at] == LinkKind::kInner ? chain.inner_wear : chain.outer_wear;
    const double error = chain.errors.empty() ? 0.0 : chain.errors[at % chain.errors.size()];
    if (!(std::abs(error) < 0.25 * chain.pitch))
      table.fail(
          chain.pitch_table.empty() ? "pitch_errors_um" : "pitch_table",
          fmt::format("found {:g} um, expected less than a quarter of the pitch", error * 1e6));
    chain.make.pitches.push_back(chain.pitch + wear + error);
  }
}

/// A gap as ISO 606 makes it, with the measures that the table gives in place of its own.
ToothGap gap_of(const Config& table, const OverTable& given, double pitch, double bush) {
  ToothGap gap = with_context(table.where("teeth"), [&] {
    return iso606_gap(pitch, bush, given.teeth, given.form, given.tip_form);
  });
  gap.seat_radius = given.seat_radius.value_or(gap.seat_radius);
  gap.flank_radius = given.flank_radius.value_or(gap.flank_radius);
  gap.seat_half_angle = given.seat_half_angle.value_or(gap.seat_half_angle);
  gap.tip_diameter = given.tip_diameter.value_or(gap.tip_diameter);
  return gap;
}

void make_sprocket(const Config& table, const ChainTable& chain, OverTable& over) {
  const ToothGap gap = gap_of(table, over, chain.pitch, 2.0 * chain.bush_radius);
  over.pitch_radius = 0.5 * gap.pitch_diameter;
  over.profile = with_context(table.where("teeth"),
                              [&] { return std::make_shared<const Profile>(sprocket(gap)); });
  if (!over.on.at) table.fail("on", "found no at_mm, expected the centre of the sprocket");
  over.belt = {{chain.in_plane(*over.on.at), over.pitch_radius, over.turn, 0,
                over.teeth * chain.pitch / (2.0 * std::numbers::pi), false}};
}

void make_over(const Config& table, const ChainTable& chain, OverTable& over) {
  const bool is_sprocket = over.guide.empty();
  over.name = is_sprocket ? over.sprocket : over.guide;
  if (is_sprocket) {
    make_sprocket(table, chain, over);
  } else {
    make_guide(over.segments, table.where("guide"), chain.half_height, over);
    if (!over.on.at && over.on.set.empty()) over.on.at = Vector3d::Zero();
  }
  for (BeltCircle& circle : over.belt) circle.owner = static_cast<int>(chain.over.size());
}

void make_chain(const Config& table, ChainTable& chain) {
  if (chain.links % 2 != 0)
    table.fail("links", fmt::format("found {}, expected an even number: inner and outer links "
                                    "alternate",
                                    chain.links));
  if (!(chain.bush_radius < 0.5 * chain.pitch))
    table.fail("bush_mm", fmt::format("found {:g}, expected less than pitch_mm, {:g}",
                                      2.0 * chain.bush_radius / kMilli, chain.pitch / kMilli));
  for (int j = 0; j < chain.links; ++j)
    chain.make.kinds.push_back(
        (j % 2 == 0) == (chain.first == LinkKind::kInner) ? LinkKind::kInner : LinkKind::kOuter);
  make_pitches(table, chain);
  const std::vector<Config> tables = table.tables("over");
  for (size_t k = 0; k < tables.size(); ++k) {
    OverTable& over = chain.described[k];
    make_over(tables[k], chain, over);
    for (const ChainOver& before : chain.over)
      if (before.name == over.name)
        tables[k].fail(over.teeth > 0 ? "sprocket" : "guide",
                       fmt::format("found \"{}\" for the second time", over.name));
    chain.over.push_back(over);
  }
  if (chain.over.front().teeth == 0)
    tables.front().fail("guide", "found a guide as the first over, expected a sprocket first");
}

const Keys<LinkMass>& link_keys() {
  static const Keys<LinkMass> keys("link", "a link", [](auto& key, LinkMass& link) {
    key.number("mass_kg", link.mass, Range::between(1e-9, 1e3), "mass").required();
    key.number("inertia_kg_m2", link.inertia, Range::between(1e-15, 1e3),
               "moment of inertia about the centre of mass")
        .required();
  });
  return keys;
}

const Keys<JointLaw>& link_joint_keys() {
  static const Keys<JointLaw> keys(
      "joint", "pin, bush and plates between links", [](auto& key, JointLaw& law) {
        key.number("stiffness_n_m", law.stiffness, Range::between(1.0, 1e15),
                   "of pin, bush and plates beyond the clearance")
            .required();
        key.number("clearance_um", law.clearance, Range::between(0.0, 1e4), "radial clearance");
        key.number("damping_n_s_m", law.damping, Range::between(0.0, 1e9), "damping");
        key.number("friction", law.friction, Range::between(0.0, 10.0), "of the pin in its bush");
        key.number("pin_mm", law.radius, kLength, "diameter of the pin").times(0.5);
        key.number("slip_speed_m_s", law.slip_speed, Range::between(1e-9, 1e3),
                   "speed below which friction is less than full")
            .needs("friction");
        key.check([](const Config& table, JointLaw& found) {
          if (found.friction > 0.0 && !table.has("pin_mm"))
            table.fail("pin_mm", "is missing, friction above 0 needs it");
        });
      });
  return keys;
}

const Keys<MattressLaw>& foundation_keys() {
  static const Keys<MattressLaw> keys(
      "contact", "elastic foundation between links and the profile",
      [](auto& key, MattressLaw& law) {
        key.number("bed_n_m3", law.stiffness, Range::between(1.0, 1e20),
                   "stiffness of the foundation, pressure over depth")
            .required();
        key.number("width_mm", law.width, kLength, "across the plane").required();
        key.number("damping_s_m", law.damping, Range::between(0.0, 1e6),
                   "damping: the pressure is times 1 + damping times the rate of the depth");
        key.number("friction", law.friction, Range::between(0.0, 10.0), "coefficient of friction");
        key.number("slip_speed_m_s", law.slip_speed, Range::between(1e-9, 1e3),
                   "speed below which friction is less than full");
        key.integer("sections", law.sections, Range::between(2.0, 8.0),
                    "points of integration in a part of the contact");
      });
  return keys;
}

const Keys<OverTable>& over_keys() {
  static const Keys<OverTable> keys(
      "over", "a sprocket or a guide over which the chain runs, in running order, a sprocket first",
      [](auto& key, OverTable& over) {
        const Range measure = Range::between(1e-6, 1e6);
        key.where(over.where);
        key.text("sprocket", over.sprocket, "name of a sprocket");
        key.text("guide", over.guide, "name of a guide");
        key.one_of({"sprocket", "guide"});
        for (const char* name : {"sprocket", "guide"})
          key.check([name](const Config& table, OverTable&) { check_name(table, name); });
        key.table("on", over.on, point_keys(),
                  "the body that carries it, of a sprocket with at_mm of its centre")
            .required();
        key.choice(
            "turn", over.turn,
            {{"clockwise", Turn::kClockwise}, {"counter-clockwise", Turn::kCounterClockwise}},
            "of the chain around it, in the plane's axes");
        key.table("contact", over.law, foundation_keys()).required();
        key.integer("teeth", over.teeth, Range::between(5.0, 10000.0), "teeth of a sprocket")
            .of("sprocket");
        key.all_need("sprocket", {}, "", [&] {
          const auto form = [&](const char* name, GapForm& at, const char* meaning) {
            key.choice(name, at,
                       {{"mean", GapForm::kMean},
                        {"minimum", GapForm::kMinimum},
                        {"maximum", GapForm::kMaximum}},
                       meaning);
          };
          form("form", over.form, "of its tooth gap between the limits of ISO 606");
          form("tip_form", over.tip_form, "of its tip diameter between the limits of ISO 606");
          const char* standard = "; that of ISO 606 without it";
          key.number("seat_radius_mm", over.seat_radius, measure,
                     fmt::format("radius of the tooth gap's seat{}", standard));
          key.number("flank_radius_mm", over.flank_radius, measure,
                     fmt::format("radius of the flanks{}", standard));
          key.number("seat_angle_deg", over.seat_half_angle, measure,
                     fmt::format("angle of the seat{}", standard))
              .times(0.5);
          key.number("tip_diameter_mm", over.tip_diameter, measure,
                     fmt::format("tip diameter{}", standard));
          key.number("gap_deg", over.gap, kAngleDeg,
                     "polar angle of a tooth gap at the start; free without it");
        });
        key.tables("segment", over.segments, segment_keys()).of("guide");
      });
  return keys;
}

const Keys<ChainTable>& chain_keys() {
  static const Keys<ChainTable> keys(
      "chain",
      "a chain of links that runs over sprockets and guides, closed and set in equilibrium",
      [](auto& key, ChainTable& chain) {
        const Range part = Range::between(-2e3, 2e3), every = Range::between(0.0, 1e9);
        key.where(chain.where);
        name_row(key, chain.name).required();
        key.choice("plane", chain.normal, {{"xy", 2}, {"yz", 0}, {"zx", 1}}, "in which it runs");
        key.integer("links", chain.links, Range::between(4.0, 100000.0), "links, an even number")
            .required();
        key.choice("first", chain.first, {{"inner", LinkKind::kInner}, {"outer", LinkKind::kOuter}},
                   "kind of link 0");
        key.number("pitch_mm", chain.pitch, kLength, "pitch of a link without errors").required();
        key.numbers("pitch_errors_um", chain.errors, Range::between(-1e9, 1e9),
                    "what the pitches of the links in turn are more");
        key.path("pitch_table", chain.pitch_table,
                 "CSV of that for each link, from 0 on: link [1], error [um]")
            .excludes("pitch_errors_um");
        key.text("pitch_column", chain.pitch_column,
                 "column of the table; without it the second one")
            .needs("pitch_table");
        key.number("inner_wear_um", chain.inner_wear, part,
                   "what the pitch of inner links is more");
        key.number("outer_wear_um", chain.outer_wear, part,
                   "what the pitch of outer links is more");
        key.number("bush_mm", chain.bush_radius, kLength, "outer diameter of the bushes")
            .times(0.5)
            .required();
        key.number("plate_half_height_mm", chain.half_height, kLength,
                   "of the plates, from the line of the pins")
            .required();
        key.number("shape_every_us", chain.shape_every, every,
                   "its shape is recorded at this interval; 0: never, without it 300 times");
        key.number("shape_every_deg", chain.shape_every_deg, every,
                   "its shape is recorded at this angle of the first sprocket")
            .unconverted()
            .excludes("shape_every_us");
        key.table("inner", chain.make.inner, link_keys(), "an inner link").required();
        key.table("outer", chain.make.outer, link_keys(), "an outer link").required();
        key.table("joint", chain.joint, link_joint_keys()).required();
        key.tables("over", chain.described, over_keys()).required();
        key.check(make_chain);
      });
  return keys;
}

}  // namespace

const keys::Table& chain_table() { return chain_keys().table(); }

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
  for (const Config& table : root.tables("chain")) chains.push_back(chain_keys().read(table));
  return chains;
}

}  // namespace clatter::dynamics
