// SPDX-License-Identifier: GPL-3.0-or-later
// Cards of loads, temperatures and eigenvalue requests.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

LoadSet& load_set(const Card& card, RawDeck& raw) {
  const auto [at, fresh] = raw.loads.try_emplace(card.id(0, "SID"));
  if (fresh) at->second.origin = card.origin();
  return at->second;
}

std::array<double, 3> scaled_vector(const Card& card, size_t scale, size_t first) {
  const double factor = card.number_or(scale, "scale", 0.0);
  std::array<double, 3> out{};
  for (size_t k = 0; k < 3; ++k) out[k] = factor * card.number_or(first + k, "N", 0.0);
  return out;
}

int32_t system_number(const Card& card, size_t i) {
  const int32_t number = card.integer_or(i, "CID", 0);
  if (number < 0) card.fail_expected(i, "CID", "a coordinate system, 0 or more");
  return number;
}

// SID CID A N1 N2 N3.
template <class Raw>
Raw scaled_acceleration(const Card& card) {
  Raw raw;
  raw.origin = card.origin();
  raw.system = system_number(card, 1);
  raw.vector = scaled_vector(card, 2, 3);
  return raw;
}

// With the grids that define its direction.
void read_force_along(const Card& card, size_t grids, RawDeck& raw) {
  RawForce force;
  force.origin = card.origin();
  force.grid = card.id(1, "G");
  force.magnitude = card.number(2, "F");
  for (size_t k = 0; k < grids; ++k) force.along[k] = card.id(3 + k, "G");
  force.moment = card.name().starts_with("MOMENT");
  card.at_most(3 + grids);
  load_set(card, raw).forces.push_back(force);
}

TemperatureSet& temperature_set(const Card& card, size_t i, RawDeck& raw) {
  const auto [at, fresh] = raw.temperatures.try_emplace(card.id(i, "SID"));
  if (fresh) at->second.origin = card.origin();
  return at->second;
}

}  // namespace

void read_force(const Card& card, RawDeck& raw) {
  RawForce force;
  force.origin = card.origin();
  force.grid = card.id(1, "G");
  force.system = system_number(card, 2);
  force.vector = scaled_vector(card, 3, 4);
  force.moment = card.name() == "MOMENT";
  card.at_most(7);
  load_set(card, raw).forces.push_back(force);
}

// SID G F G1 G2: along G1 to G2.
void read_force1(const Card& card, RawDeck& raw) { read_force_along(card, 2, raw); }

// SID G F G1 G2 G3 G4: along (G1 to G2) x (G3 to G4).
void read_force2(const Card& card, RawDeck& raw) { read_force_along(card, 4, raw); }

// SID P G1 G2 G3 G4: along the right-hand normal of G1 G2 G3.
void read_pload(const Card& card, RawDeck& raw) {
  RawPressure pressure;
  pressure.origin = card.origin();
  pressure.values.fill(card.number(1, "P"));
  for (size_t k = 0; k < 3; ++k) pressure.corners[k] = card.id(2 + k, "G");
  pressure.corners[3] = card.id_or(5, "G4", 0);
  card.at_most(6);
  load_set(card, raw).pressures.push_back(pressure);
}

// SID P EID1 EID2 ... of two-dimensional cells.
void read_pload2(const Card& card, RawDeck& raw) {
  LoadSet& set = load_set(card, raw);
  RawPressure pressure;
  pressure.origin = card.origin();
  pressure.values.fill(card.number(1, "P"));
  for (const IdRange& range : card.ids(2, "EID")) set.on_skins.push_back({pressure, range});
}

// EID THRU EID in fields 8 and 9: two-dimensional cells, along their own normals.
bool is_on_skins(const Card& card) { return card.text(6) == "THRU" || card.blank(6); }

void read_pload4(const Card& card, RawDeck& raw) {
  RawPressure pressure;
  pressure.origin = card.origin();
  pressure.cell = card.id(1, "EID");
  pressure.values.fill(card.number(2, "P1"));
  for (size_t i = 1; i < 4; ++i)
    pressure.values[i] = card.number_or(2 + i, "P", pressure.values[0]);
  pressure.system = card.integer_or(8, "CID", 0);
  for (size_t k = 0; k < 3; ++k) pressure.direction[k] = card.number_or(9 + k, "N", 0.0);
  if (!card.blank(12) && card.text(12) != "SURF") card.fail(12, "SORL: expected SURF");
  if (!card.blank(13) && card.text(13) != "NORM") card.fail(13, "LDIR: expected NORM");
  card.at_most(14);
  LoadSet& set = load_set(card, raw);
  if (is_on_skins(card)) {
    const int32_t last = card.id_or(7, "EID2", pressure.cell);
    set.on_skins.push_back({pressure, {pressure.cell, last, 1, true}});
    return;
  }
  pressure.g1 = card.id(6, "G1");
  pressure.g34 = card.id_or(7, "G3 or G4", 0);
  set.pressures.push_back(pressure);
}

// SID CID N1 N2 N3 DIR, then LOC VAL LOC VAL ...: factors at positions along DIR.
void read_accel(const Card& card, RawDeck& raw) {
  RawAcceleration accel;
  accel.origin = card.origin();
  accel.system = system_number(card, 1);
  for (size_t k = 0; k < 3; ++k) accel.vector[k] = card.number_or(2 + k, "N", 0.0);
  for (size_t i = 8; i < card.size(); i += 2) {
    if (card.blank(i) && card.blank(i + 1)) continue;
    accel.factors.emplace_back(card.number(i, "LOC"), card.number(i + 1, "VAL"));
  }
  std::sort(accel.factors.begin(), accel.factors.end());
  const auto same = [&](const auto& a, const auto& b) { return a.second == b.second; };
  if (std::adjacent_find(accel.factors.begin(), accel.factors.end(), std::not_fn(same)) ==
      accel.factors.end()) {
    for (double& part : accel.vector) part *= accel.factors.empty() ? 1.0 : accel.factors[0].second;
    load_set(card, raw).gravity.push_back({accel.origin, accel.system, accel.vector});
    return;
  }
  const auto at = [](const auto& a, const auto& b) { return a.first == b.first; };
  if (std::adjacent_find(accel.factors.begin(), accel.factors.end(), at) != accel.factors.end())
    card.fail(8, "found two factors at one LOC, expected one");
  constexpr std::string_view kAxes = "XYZ";
  const size_t axis = card.text(5).size() == 1 ? kAxes.find(card.text(5)) : kAxes.npos;
  if (axis == kAxes.npos) card.fail_expected(5, "DIR", "X, Y or Z");
  accel.along = static_cast<int>(axis);
  load_set(card, raw).accelerations.push_back(std::move(accel));
}

// SID CID A N1 N2 N3, then grids.
void read_accel1(const Card& card, RawDeck& raw) {
  auto accel = scaled_acceleration<RawAcceleration>(card);
  accel.grids = card.ids(6, "GID");
  if (accel.grids.empty()) card.fail_expected(8, "GID", "the grids that it acts on");
  load_set(card, raw).accelerations.push_back(std::move(accel));
}

void read_grav(const Card& card, RawDeck& raw) {
  card.at_most(7);
  load_set(card, raw).gravity.push_back(scaled_acceleration<RawGravity>(card));
}

void read_rforce(const Card& card, RawDeck& raw) {
  RawRotation rotation;
  rotation.origin = card.origin();
  rotation.grid = card.id_or(1, "G", 0);
  rotation.system = system_number(card, 2);
  rotation.turns = card.number(3, "A");
  double square = 0.0;
  for (size_t k = 0; k < 3; ++k) {
    rotation.axis[k] = card.number_or(4 + k, "R", 0.0);
    square += rotation.axis[k] * rotation.axis[k];
  }
  const double length = std::sqrt(square);
  if (!(length > 0.0)) card.fail(4, "expected a direction R1 R2 R3 of the axis");
  for (double& part : rotation.axis) part /= length;
  rotation.turns *= length;
  if (card.number_or(8, "RACC", 0.0) != 0.0) {
    card.fail(8, "RACC: angular acceleration is not supported, expected none");
  }
  card.at_most(9);
  load_set(card, raw).rotations.push_back(rotation);
}

void read_load(const Card& card, RawDeck& raw) {
  LoadSum sum;
  sum.origin = card.origin();
  const int32_t set = card.id(0, "SID");
  const double overall = card.number(1, "S");
  for (size_t i = 2; i < card.size(); i += 2) {
    if (card.blank(i) && card.blank(i + 1)) continue;
    sum.terms.emplace_back(overall * card.number(i, "S"), card.id(i + 1, "L"));
  }
  if (!raw.load_sums.emplace(set, std::move(sum)).second) {
    card.fail(0, fmt::format("found a second LOAD {}", set));
  }
}

void read_temp(const Card& card, RawDeck& raw) {
  TemperatureSet& set = temperature_set(card, 0, raw);
  for (size_t i = 1; i < 7; i += 2) {
    if (card.blank(i) && card.blank(i + 1)) continue;
    set.values.push_back({card.id(i, "G"), card.number(i + 1, "T"), card.origin()});
  }
}

void read_tempd(const Card& card, RawDeck& raw) {
  for (size_t i = 0; i < 8; i += 2) {
    if (card.blank(i) && card.blank(i + 1)) continue;
    TemperatureSet& set = temperature_set(card, i, raw);
    if (set.has_default) card.fail(i, fmt::format("found a second TEMPD {}", card.text(i)));
    set.has_default = true;
    set.default_value = card.number(i + 1, "T");
  }
}

void read_eigrl(const Card& card, RawDeck& raw) {
  raw.eigen_counts[card.id(0, "SID")] = card.integer_or(3, "ND", 0);
}

void read_eigr(const Card& card, RawDeck& raw) {
  raw.eigen_counts[card.id(0, "SID")] = card.integer_or(5, "ND", 0);
}

}  // namespace clatter::mesh::deck::nastran
