// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/sound_options.hpp"

#include <fmt/format.h>

#include <set>

namespace clatter::recover {
namespace {

Eigen::Vector3d read_vector(const Config& table, const char* key) {
  return Eigen::Vector3d::Map(table.numbers(key, size_t{3}).data());
}

void read_grid(const Config& table, GridRule& grid) {
  grid.from_hz = table.number_or("from_hz", grid.from_hz, Range::positive());
  grid.to_hz = table.number_or("to_hz", grid.to_hz, Range::positive());
  grid.tolerance_db = table.number_or("tolerance_db", grid.tolerance_db, Range::positive());
  grid.most = static_cast<int>(table.integer_or("most", grid.most, {4, 1000}));
  if (!(grid.to_hz > grid.from_hz))
    table.fail("to_hz", fmt::format("found {:g}, expected more than from_hz = {:g}", grid.to_hz,
                                    grid.from_hz));
}

sound::Plane read_ground(const Config& table) {
  const Eigen::Vector3d normal =
      table.has("normal") ? read_vector(table, "normal") : Eigen::Vector3d::UnitZ();
  if (!(normal.norm() > 0.0))
    table.fail("normal", "found a zero vector, expected the direction away from the ground");
  return {normal.normalized(), table.number("offset")};
}

std::vector<Microphone> read_microphones(const Config& config) {
  std::vector<Microphone> microphones;
  std::set<std::string> names;
  for (const Config& table : config.tables("microphone")) {
    const Microphone microphone{table.text("name"), read_vector(table, "position")};
    if (microphone.name.empty() || microphone.name.find('/') != std::string::npos)
      table.fail("name", "found '" + microphone.name + "', expected a name without '/'");
    if (!names.insert(microphone.name).second)
      table.fail("name", "found '" + microphone.name + "' twice, expected different names");
    microphones.push_back(microphone);
  }
  return microphones;
}

std::string vector_text(const Eigen::Vector3d& v) {
  return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v[0], v[1], v[2]);
}

const char* name_of(LidMotion lids) { return lids == LidMotion::kRest ? "rest" : "nearest"; }

}  // namespace

SoundOptions read_sound_options(const Config& config) {
  SoundOptions options;
  if (!config.files().empty()) options.origin = config.files().front().string();
  if (const auto air = config.find_table("air")) {
    options.air.density = air->number_or("density", options.air.density, Range::positive());
    options.air.sound_speed =
        air->number_or("sound_speed", options.air.sound_speed, Range::positive());
  }
  if (const auto skin = config.find_table("skin")) {
    AcousticMesh& mesh = options.mesh;
    mesh.opening = skin->number_or("opening", mesh.opening, Range::positive());
    mesh.edges_per_wavelength =
        skin->number_or("edges_per_wavelength", mesh.edges_per_wavelength, {3.0, 30.0});
    if (skin->choice("lids", {"rest", "nearest"}) == "nearest") options.lids = LidMotion::kNearest;
  }
  if (const auto grid = config.find_table("grid")) read_grid(*grid, options.grid);
  if (const auto ground = config.find_table("ground")) options.ground = read_ground(*ground);
  options.microphones = read_microphones(config);
  if (config.has("microphones"))
    options.set = config.choice("microphones", {"engine_1m", "iso_3744"}) == "iso_3744"
                      ? MicrophoneSet::kIso3744
                      : MicrophoneSet::kEngine1m;
  config.finish();
  return options;
}

std::string resolved_text(const SoundOptions& o) {
  std::string text;
  if (const MicrophoneSet set = o.chosen_set(); set != MicrophoneSet::kNone)
    text = fmt::format("microphones = \"{}\"\n", name_of(set));
  text += fmt::format("[air]\ndensity = {:.9g}\nsound_speed = {:.9g}\n", o.air.density,
                      o.air.sound_speed);
  text += fmt::format("[skin]\nopening = {:.9g}\nedges_per_wavelength = {:.9g}\nlids = \"{}\"\n",
                      o.mesh.opening, o.mesh.edges_per_wavelength, name_of(o.lids));
  text +=
      fmt::format("[grid]\nfrom_hz = {:.9g}\nto_hz = {:.9g}\ntolerance_db = {:.9g}\nmost = {}\n",
                  o.grid.from_hz, o.grid.to_hz, o.grid.tolerance_db, o.grid.most);
  if (o.ground)
    text += fmt::format("[ground]\nnormal = {}\noffset = {:.9g}\n", vector_text(o.ground->normal),
                        o.ground->offset);
  for (const Microphone& microphone : o.microphones)
    text += fmt::format("[[microphone]]\nname = \"{}\"\nposition = {}\n", microphone.name,
                        vector_text(microphone.position));
  return text;
}

std::string sound_options_help() {
  const SoundOptions d;
  return fmt::format(R"(Configuration (block.sound.toml); every key is optional:

  microphones = "engine_1m" # five, 1 m from the sides of the box around the part; or "iso_3744":
                           # of the box of ISO 3744 on the ground; left out beside a list: none
  [air]
  density = {:g}         # kg/m3
  sound_speed = {:g}     # m/s
  [skin]                   # the closed surface that radiates
  opening = {:g}           # m; holes up to this diameter are closed by lids
  edges_per_wavelength = {:g} # at to_hz; 5: 0.5 % of the power of a point source
  lids = "rest"            # rigid and at rest; or "nearest": move with the nearest exposed face
  [grid]
  from_hz = {:g}
  to_hz = {:g}             # the cost grows with its fourth power
  tolerance_db = {:g}       # error of interpolation between frequencies, measured
  most = {}                # frequencies; refused when they do not suffice
  [ground]                 # a rigid plane below the part; free space without it
  normal = [0, 0, 1]       # away from the ground
  offset = -0.5            # m: the plane normal . x = offset
  [[microphone]]           # a list of its own, in addition
  name = "left"
  position = [0, 1.2, 0.1] # m, in the frame of the part)",
                     d.air.density, d.air.sound_speed, d.mesh.opening, d.mesh.edges_per_wavelength,
                     d.grid.from_hz, d.grid.to_hz, d.grid.tolerance_db, d.grid.most);
}

}  // namespace clatter::recover
