// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/sound_options.hpp"

#include <fmt/format.h>

#include "recover/options/options.hpp"

namespace clatter::recover {
namespace {

using keys::Keys;

const Keys<SkinRule>& skin_keys() {
  static const Keys<SkinRule> keys(
      "skin", "the closed surface that radiates", [](auto& key, SkinRule& skin) {
        key.number("opening", skin.mesh.opening, Range::positive(),
                   "diameter up to which holes are closed by lids; 0.12 m without it, of smaller "
                   "bodies a third of their size")
            .shown_in("m");
        key.number("edges_per_wavelength", skin.mesh.edges_per_wavelength,
                   Range::between(3.0, 30.0),
                   "edges of its triangles at the highest frequency; 5 leave an error of 0.5 % of "
                   "the power of a point source");
        key.number("shape_error", skin.mesh.shape_error, Range::between(1e-4, 0.5),
                   "largest error of its volume and area, which shorter edges lower; 0.02 leaves "
                   "0.1 dB of the power of a small sphere, 0.4 dB of slender bodies");
        key.integer("most_faces", skin.mesh.most_faces, {100, 60000},
                    "most triangles; the part is refused when they do not suffice");
        key.choice("lids", skin.lids,
                   {{"rest", LidMotion::kRest}, {"nearest", LidMotion::kNearest}},
                   "whether lids are at rest or move with the nearest exposed face");
      });
  return keys;
}

const Keys<GridRule>& grid_keys() {
  static const Keys<GridRule> keys(
      "grid", "the frequencies that are computed", [](auto& key, GridRule& grid) {
        key.number("from_hz", grid.from_hz, Range::positive(), "lowest frequency");
        key.number("to_hz", grid.to_hz, Range::positive(),
                   "highest frequency; the cost grows with its fourth power");
        key.number("tolerance_db", grid.tolerance_db, Range::positive(),
                   "largest error of interpolation between frequencies, which is measured")
            .shown_in("dB");
        key.integer("most", grid.most, {4, 1000},
                    "most frequencies; the part is refused when they do not suffice");
        key.check([](const Config& table, GridRule& g) {
          if (!(g.to_hz > g.from_hz))
            table.fail("to_hz", fmt::format("found {:g}, expected more than from_hz = {:g}",
                                            g.to_hz, g.from_hz));
        });
      });
  return keys;
}

const Keys<sound::Plane>& ground_keys() {
  static const Keys<sound::Plane> keys(
      "ground", "a rigid plane below the part; free space without it",
      [](auto& key, sound::Plane& plane) {
        key.direction("normal", plane.normal, "direction away from the ground");
        key.number("offset", plane.offset, {},
                   "distance of the plane from the origin, along the normal")
            .required()
            .shown_in("m");
      },
      {Eigen::Vector3d::UnitZ(), 0.0});
  return keys;
}

const Keys<Microphone>& microphone_keys() {
  static const Keys<Microphone> keys(
      "microphone", "a point at which the pressure is computed, beside those of a set",
      [](auto& key, Microphone& microphone) {
        key.name("name", microphone.name, "name of its results").required().distinct();
        key.vector("position", microphone.position, {}, "position in the frame of the part")
            .required()
            .shown_in("m");
      });
  return keys;
}

}  // namespace

const Keys<SoundOptions>& sound_keys() {
  static const Keys<SoundOptions> keys(
      "sound.toml", "how a part's sound is computed; every key is optional",
      [](auto& key, SoundOptions& options) {
        key.choice("microphones", options.set,
                   {{"engine_1m", MicrophoneSet::kEngine1m}, {"iso_3744", MicrophoneSet::kIso3744}},
                   "points 1 m around the part: five beside and above it, or those of ISO 3744 on "
                   "the ground; engine_1m when no microphone is given");
        key.flag("surface_pressure", options.surface_pressure,
                 "the file keeps the pressures on the acoustic skin, with which it is made again "
                 "for other microphones without boundary elements");
        key.table("air", options.air, air_keys());
        key.table("skin", options.skin, skin_keys());
        key.table("grid", options.grid, grid_keys());
        key.table("ground", options.ground, ground_keys());
        key.tables("microphone", options.microphones, microphone_keys());
        key.check([](const Config& config, SoundOptions& o) {
          if (!config.files().empty()) o.origin = config.files().front().string();
        });
      });
  return keys;
}

}  // namespace clatter::recover
