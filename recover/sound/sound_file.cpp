// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/sound_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"

namespace clatter::recover {
namespace {

template <typename Values>
void put_sound(H5File& file, const std::string& name, const Values& values, const std::string& unit,
               const std::string& meaning) {
  file.write(name, values);
  file.set(name, "unit", unit);
  file.set(name, "meaning", meaning);
}

std::string member(const char* group, size_t index) {
  return fmt::format("{}/{:05d}", group, index);
}

void write_microphones(H5File& file, const SoundTable& table) {
  std::vector<std::string> names;
  RowMatrix position(table.microphones.size(), 3);
  for (size_t m = 0; m < table.microphones.size(); ++m) {
    names.push_back(table.microphones[m].name);
    position.row(static_cast<Eigen::Index>(m)) = table.microphones[m].position.transpose();
  }
  file.write("microphones/name", names);
  put_sound(file, "microphones/position", position, "m", "in the frame of the part");
  put_sound(file, "microphones/distance", table.distance, "m",
            "from the middle of the acoustic skin");
  file.set("microphones", "set", name_of(table.surface.set));
  file.set("microphones", "set_microphones",
           static_cast<int64_t>(table.surface.microphones.size()));
  file.set("microphones", "surface_area_m2", table.surface.area);
}

void write_single(H5File& file, const std::string& name, const RowMatrix& values,
                  const std::string& meaning, const char* unit = "Pa s/m2") {
  const Eigen::Map<const Eigen::VectorXd> flat(values.data(), values.size());
  const std::vector<float> single(flat.begin(), flat.end());
  file.write_float(name, single, {values.rows(), values.cols()});
  file.set(name, "unit", unit);
  file.set(name, "meaning", meaning);
}

void write_far_fields(H5File& file, const SoundTable& table) {
  put_sound(file, "flow/face", table.flow.face, "1", "of the skin of the reduced model, ascending");
  put_sound(file, "flow/node", table.flow.node, "1", "of the acoustic skin");
  put_sound(file, "flow/weight", table.flow.weight, "m2",
            "int N_n v_n dS of the node per velocity of the face: column 3 a + d is direction d of "
            "its node a");
  for (size_t i = 0; i < table.samples.size(); ++i) {
    const Eigen::MatrixXcd& far = table.samples[i].far;
    write_single(file, member("far_field/re", i), far.real(),
                 "F r exp(+i k r), far from the middle of the acoustic skin, in real spherical "
                 "harmonics (row l^2 + l + m) per volume flow of each node, real part");
    write_single(file, member("far_field/im", i), far.imag(), "the same, imaginary part");
  }
}

/// Values of all samples; none where one of them has none.
std::vector<double> all_of(const SoundTable& table,
                           const std::function<std::optional<double>(const SampleChecks&)>& take) {
  std::vector<double> values;
  for (const SoundSample& sample : table.samples)
    if (const auto value = take(sample.checks)) values.push_back(*value);
  return values.size() == table.samples.size() ? values : std::vector<double>();
}

void write_pressures(H5File& file, const SoundTable& table) {
  for (size_t i = 0; i < table.samples.size(); ++i) {
    const Eigen::MatrixXcd pressure = table.samples[i].pressure.cast<sound::Complex>();
    write_single(file, member("surface_pressure/re", i), pressure.real(),
                 "pressure at the nodes of the acoustic skin per reduced velocity, real part",
                 "Pa s/m");
    write_single(file, member("surface_pressure/im", i), pressure.imag(),
                 "the same, imaginary part", "Pa s/m");
  }
  const auto put = [&](const char* name, const char* unit, const char* meaning, const auto& take) {
    if (const std::vector<double> values = all_of(table, take); !values.empty())
      put_sound(file, std::string("checks/") + name, values, unit, meaning);
  };
  put("condition", "1", "of the solved matrix, by frequency",
      [](const SampleChecks& c) { return std::optional(c.condition); });
  put("far_field_error_db", "dB", "as in the certificate, by frequency",
      [](const SampleChecks& c) { return std::optional(c.far_field_error); });
  put("monopole_error_db", "dB", "as in the certificate, by frequency",
      [](const SampleChecks& c) { return c.monopole_error; });
  put("surface_power_error_db", "dB", "as in the certificate, by frequency",
      [](const SampleChecks& c) { return c.surface_power_error; });
}

void check_shape(const H5File& file, const std::string& name, int64_t rows, int64_t columns) {
  const std::vector<int64_t> shape = file.shape(name);
  if (shape != std::vector<int64_t>{rows, columns})
    throw InputError(fmt::format("{}: {}: found shape ({}), expected ({}, {})",
                                 file.path().string(), name, fmt::join(shape, ", "), rows,
                                 columns));
}

void read_microphones(const H5File& file, SoundTable& table) {
  const std::vector<std::string> names = file.read_strings("microphones/name");
  const auto count = static_cast<int64_t>(names.size());
  check_shape(file, "microphones/position", count, 3);
  const RowMatrix position = file.read_rows("microphones/position");
  table.distance = file.read_vector("microphones/distance");
  if (table.distance.size() != count)
    throw InputError(fmt::format("{}: microphones/distance: found {} values, expected {}",
                                 file.path().string(), table.distance.size(), count));
  for (size_t m = 0; m < names.size(); ++m)
    table.microphones.push_back({names[m], position.row(static_cast<Eigen::Index>(m))});
  const std::string set = file.get_string("microphones", "set");
  for (const MicrophoneSet known : {MicrophoneSet::kEngine1m, MicrophoneSet::kIso3744})
    if (set == name_of(known)) table.surface.set = known;
  table.surface.area = file.get_double("microphones", "surface_area_m2");
  const int64_t of_set = file.get_int("microphones", "set_microphones");
  if (of_set < 0 || of_set > count || !(table.surface.area >= 0.0))
    throw InputError(
        fmt::format("{}: microphones: found {} of set '{}' on {:g} m2, expected at "
                    "most {}",
                    file.path().string(), of_set, set, table.surface.area, count));
  table.surface.microphones.assign(table.microphones.begin(), table.microphones.begin() + of_set);
}

Eigen::MatrixXcd read_far_field(const H5File& file, size_t index, int64_t n_v) {
  const std::string re = member("far_field/re", index), im = member("far_field/im", index);
  const std::vector<int64_t> shape = file.shape(re);
  const auto degree = shape.empty() ? -1.0 : std::sqrt(static_cast<double>(shape[0])) - 1.0;
  if (shape.size() != 2 || shape[0] < 1 || degree != std::floor(degree) || shape[1] != n_v)
    throw InputError(
        fmt::format("{}: {}: found shape ({}), expected a square number of rows and "
                    "{} columns",
                    file.path().string(), re, fmt::join(shape, ", "), n_v));
  check_shape(file, im, shape[0], n_v);
  Eigen::MatrixXcd far = file.read_matrix(re).cast<sound::Complex>();
  far += sound::Complex(0.0, 1.0) * file.read_matrix(im);
  return far;
}

/// @param n_v nodes of the acoustic skin
FlowMap read_flow(const H5File& file, int64_t n_v) {
  FlowMap flow{file.read_ints("flow/face"), file.read_ints("flow/node"), {}};
  check_shape(file, "flow/weight", static_cast<int64_t>(flow.face.size()), 18);
  flow.weight = file.read_rows("flow/weight");
  if (flow.node.size() != flow.face.size() || !flow.weight.allFinite())
    throw InputError(
        fmt::format("{}: flow: found {} faces and {} nodes, expected as many, and "
                    "finite weights",
                    file.path().string(), flow.face.size(), flow.node.size()));
  for (size_t k = 0; k < flow.face.size(); ++k)
    if (flow.face[k] < 0 || flow.node[k] < 0 || flow.node[k] >= n_v)
      throw InputError(fmt::format("{}: flow: found face {} and node {}, expected nodes 0 to {}",
                                   file.path().string(), flow.face[k], flow.node[k], n_v - 1));
  return flow;
}

/// Pressures and checks of samples that were read; InputError where they are not all there.
void read_pressures(const H5File& file, int64_t n_v, SoundTable& table) {
  const std::vector<double> condition = file.read_doubles("checks/condition");
  const std::vector<double> far_field = file.read_doubles("checks/far_field_error_db");
  std::vector<double> monopole, surface_power;
  if (file.has("checks/monopole_error_db")) {
    monopole = file.read_doubles("checks/monopole_error_db");
    surface_power = file.read_doubles("checks/surface_power_error_db");
  }
  const size_t n = table.samples.size();
  if (condition.size() != n || far_field.size() != n || surface_power.size() != monopole.size() ||
      (!monopole.empty() && monopole.size() != n))
    throw InputError(fmt::format("{}: checks: expected {} values each", file.path().string(), n));
  for (size_t i = 0; i < n; ++i) {
    SoundSample& sample = table.samples[i];
    const std::string re = member("surface_pressure/re", i), im = member("surface_pressure/im", i);
    for (const std::string& part : {re, im}) check_shape(file, part, n_v, table.size());
    sample.pressure.resize(n_v, table.size());
    sample.pressure.real() = file.read_matrix(re).cast<float>();
    sample.pressure.imag() = file.read_matrix(im).cast<float>();
    if (!sample.pressure.allFinite())
      throw InputError(fmt::format("{}: {}: found NaN or infinity, expected finite values",
                                   file.path().string(), re));
    sample.checks = {condition[i], far_field[i]};
    if (monopole.empty()) continue;
    sample.checks.monopole_error = monopole[i];
    sample.checks.surface_power_error = surface_power[i];
  }
}

/// Whether a file is of the same acoustic skin, motion and space, to the bit.
bool is_alike(const H5File& file, const SoundTable& table, const PartSound& sound) {
  const auto& [fluid, ground] = std::tie(table.fluid, table.ground);
  const SoundTable& own = sound.table;
  const bool same_ground =
      ground.has_value() == own.ground.has_value() &&
      (!ground || (ground->normal == own.ground->normal && ground->offset == own.ground->offset));
  return same_ground && fluid.density == own.fluid.density &&
         fluid.sound_speed == own.fluid.sound_speed && table.flow.face == own.flow.face &&
         table.flow.node == own.flow.node && table.flow.weight == own.flow.weight &&
         file.read_matrix("skin/nodes") == Eigen::MatrixXd(sound.skin.nodes) &&
         file.read_matrix("skin/triangles") == sound.skin.triangles.cast<double>() &&
         file.read_matrix("skin/normal_velocity") == sound.face_velocity;
}

void read_samples(const H5File& file, int size, SoundTable& table) {
  const int64_t n_v = file.shape("skin/nodes").at(0);
  table.flow = read_flow(file, n_v);
  const std::vector<double> grid = file.read_doubles("frequency_hz");
  const auto n_m = static_cast<int64_t>(table.microphones.size());
  for (size_t i = 0; i < grid.size(); ++i) {
    if (!(grid[i] > (i > 0 ? grid[i - 1] : 0.0)))
      throw InputError(
          fmt::format("{}: frequency_hz: found {:g} Hz at {}, expected ascending "
                      "positive frequencies",
                      file.path().string(), grid[i], i));
    SoundSample sample{grid[i], {}, {}, read_far_field(file, i, n_v)};
    check_shape(file, member("resistance", i), size, size);
    sample.R = file.read_matrix(member("resistance", i));
    for (const char* part : {"microphones/pressure_re", "microphones/pressure_im"})
      check_shape(file, member(part, i), n_m, size);
    sample.H = file.read_matrix(member("microphones/pressure_re", i)).cast<sound::Complex>();
    sample.H += sound::Complex(0.0, 1.0) * file.read_matrix(member("microphones/pressure_im", i));
    if (!sample.R.allFinite() || !sample.H.allFinite() || !sample.far.allFinite())
      throw InputError(fmt::format("{}: {}: found NaN or infinity, expected finite values",
                                   file.path().string(), member("resistance", i)));
    table.samples.push_back(std::move(sample));
  }
  if (table.samples.empty())
    throw InputError(file.path().string() + ": frequency_hz: found none, expected at least one");
}

}  // namespace

void write_sound(H5File& file, const PartSound& sound, const SoundOptions& options,
                 const std::string& rom_sha256) {
  file.set("/", "rom_sha256", rom_sha256);
  file.set("/", "phase", "x(t) = Re( X exp(+i 2 pi f t) )");
  file.set("/", "amplitude", "peak: P = 1/2 v^H R v, p = H v, v the reduced velocity");
  file.set("/", "air_density_kg_m3", options.air.density);
  file.set("/", "air_sound_speed_m_s", options.air.sound_speed);
  file.set("/", "lids",
           options.skin.lids == LidMotion::kRest
               ? "rigid and at rest"
               : "move with the nearest point of an exposed face");
  file.set("/", "ground", options.ground ? "rigid plane" : "none");
  if (options.ground) {
    put_sound(file, "ground/normal", Eigen::VectorXd(options.ground->normal), "1",
              "away from the ground");
    file.set("ground", "offset_m", options.ground->offset);
  }
  write_certificate(file, sound.certificate);

  const SoundTable& table = sound.table;
  std::vector<double> grid;
  for (const SoundSample& sample : table.samples) grid.push_back(sample.frequency_hz);
  put_sound(file, "frequency_hz", grid, "Hz",
            "frequencies; R / f^2 is a polynomial through six of them");
  write_microphones(file, table);
  write_far_fields(file, table);
  if (options.surface_pressure) write_pressures(file, table);
  for (size_t i = 0; i < grid.size(); ++i) {
    const SoundSample& sample = table.samples[i];
    put_sound(file, member("resistance", i), sample.R, "N s/m",
              "R of P = 1/2 v^H R v; per coordinate, angles in rad");
    put_sound(file, member("microphones/pressure_re", i), Eigen::MatrixXd(sample.H.real()),
              "Pa s/m", "pressure of each microphone per reduced velocity, real part");
    put_sound(file, member("microphones/pressure_im", i), Eigen::MatrixXd(sample.H.imag()),
              "Pa s/m", "pressure of each microphone per reduced velocity, imaginary part");
  }
  put_sound(file, "efficiency", sound.efficiency, "1",
            "radiation efficiency of each coordinate, frequencies x coordinates");
  put_sound(file, "skin/nodes", sound.skin.nodes, "m", "of the acoustic skin");
  put_sound(file, "skin/triangles", sound.skin.triangles, "1", "flat, outward");
  put_sound(file, "skin/covered", sound.map.covered, "1",
            "share of each triangle in front of exposed faces");
  put_sound(file, "skin/lids", sound.map.lids, "1", "triangles that close openings");
  put_sound(file, "skin/normal_velocity", sound.face_velocity, "1",
            "mean normal velocity of each triangle per reduced velocity, triangles x coordinates");
  file.set("skin", "area_m2", sound.skin.area);
  file.set("skin", "enclosed_volume_m3", sound.skin.volume);
}

std::vector<SoundSample> earlier_samples(const std::filesystem::path& path,
                                         const std::string& rom_sha256, const PartSound& sound) {
  if (!std::filesystem::is_regular_file(path)) return {};
  try {
    const H5File file = open_artefact(path, kSoundSchema);
    if (!file.has("checks/condition") || file.get_string("/", "version") != version()) return {};
    SoundTable table = read_sound(path, rom_sha256, static_cast<int>(sound.face_velocity.cols()));
    if (!is_alike(file, table, sound)) return {};
    read_pressures(file, sound.skin.node_count(), table);
    return std::move(table.samples);
  } catch (const InputError&) {
    return {};  // it is replaced by the new one
  }
}

SoundTable read_sound(const std::filesystem::path& path, const std::string& rom_sha256, int size) {
  const H5File file = open_artefact(path, kSoundSchema);
  const std::string found = file.get_string("/", "rom_sha256");
  if (found != rom_sha256)
    throw InputError(fmt::format(
        "{}: rom_sha256: found {}..., expected {}...: it was made from another reduced model, run "
        "clatter-recover sound again",
        path.string(), found.substr(0, 12), rom_sha256.substr(0, 12)));
  SoundTable table;
  table.fluid = {file.get_double("/", "air_density_kg_m3"),
                 file.get_double("/", "air_sound_speed_m_s")};
  if (file.has("ground/normal")) {
    const Eigen::VectorXd normal = file.read_vector("ground/normal");
    if (normal.size() != 3 || !(std::abs(normal.norm() - 1.0) < 1e-9))
      throw InputError(path.string() + ": ground/normal: expected a unit vector of 3 numbers");
    table.ground = sound::Plane{normal, file.get_double("ground", "offset_m")};
  }
  read_microphones(file, table);
  read_samples(file, size, table);
  return table;
}

}  // namespace clatter::recover
