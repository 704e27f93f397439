// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/shaft_lumps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {
namespace {

constexpr double kSame = 1e-6;  // [m]: discs and bearings this near are at one station

void add_position(std::vector<double>& positions, double at) {
  for (const double other : positions)
    if (std::abs(other - at) <= kSame) return;
  positions.push_back(at);
}

std::vector<double> station_positions(const ShaftSpec& shaft) {
  std::vector<double> given;
  for (const ShaftDiscSpec& disc : shaft.discs) add_position(given, disc.at);
  for (const ShaftBearingSpec& bearing : shaft.bearings) add_position(given, bearing.at);
  std::vector<double> all = given;
  const double begin = shaft.sections->begin(), length = shaft.sections->end() - begin;
  for (int k = 0; k < shaft.slices; ++k) {
    const double low = begin + length * k / shaft.slices,
                 high = begin + length * (k + 1) / shaft.slices;
    const bool taken = std::any_of(given.begin(), given.end(), [&](double at) {
      return at >= low - kSame && at <= high + kSame;
    });
    if (!taken) all.push_back(0.5 * (low + high));
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::string station_name(const ShaftSpec& shaft, const ShaftStation& station, size_t index) {
  for (const size_t d : station.discs)
    if (!shaft.discs[d].phaser) return shaft.discs[d].name;
  if (!station.bearings.empty()) return shaft.bearings[station.bearings.front()].name;
  if (!station.discs.empty()) return shaft.discs[station.discs.front()].name + "_hub";
  return fmt::format("slice_{}", index + 1);
}

void add_disc(const ShaftDiscSpec& disc, ShaftPiece& piece) {
  ShaftPiece one{disc.inertia, disc.at};
  if (disc.phaser) one.inertia.polar = 0.0;
  piece = joined(piece, one);
}

}  // namespace

std::vector<ShaftStation> shaft_stations(const ShaftSpec& shaft) {
  const std::vector<double> at = station_positions(shaft);
  std::vector<ShaftStation> stations(at.size());
  for (size_t i = 0; i < at.size(); ++i) {
    ShaftStation& station = stations[i];
    const double low = i == 0 ? shaft.sections->begin() : 0.5 * (at[i - 1] + at[i]);
    const double high = i + 1 == at.size() ? shaft.sections->end() : 0.5 * (at[i] + at[i + 1]);
    station.at = at[i];
    ShaftPiece piece = shaft.sections->piece(low, high);
    for (size_t d = 0; d < shaft.discs.size(); ++d) {
      if (std::abs(shaft.discs[d].at - at[i]) > kSame) continue;
      station.discs.push_back(d);
      add_disc(shaft.discs[d], piece);
    }
    for (size_t b = 0; b < shaft.bearings.size(); ++b)
      if (std::abs(shaft.bearings[b].at - at[i]) <= kSame) station.bearings.push_back(b);
    station.inertia = piece.inertia;
    station.centre = piece.centre;
    station.name = station_name(shaft, station, i);
  }
  return stations;
}

size_t station_of_disc(const std::vector<ShaftStation>& stations, size_t disc) {
  size_t at = 0;
  while (std::count(stations[at].discs.begin(), stations[at].discs.end(), disc) == 0) ++at;
  return at;
}

size_t station_of_bearing(const std::vector<ShaftStation>& stations, size_t bearing) {
  size_t at = 0;
  while (std::count(stations[at].bearings.begin(), stations[at].bearings.end(), bearing) == 0) ++at;
  return at;
}

}  // namespace clatter::dynamics
