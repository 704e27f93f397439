// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A sphere that pulsates and oscillates: its reduced model, its sound, and a run of it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/base/artefact.hpp"
#include "recover/recover.hpp"
#include "recover/sound/sound_file.hpp"
#include "synthetic.hpp"

namespace clatter::recover::testing {

constexpr double kPi = std::numbers::pi, kRadius = 0.2;
constexpr int kBeside = 5, kAbove = 6;  // microphones of the list, after the five of the set

/// A sphere of radius 0.2 m: radial displacement, and displacement along z.
inline rom::ReducedModel sphere_model() {
  Mesh6 mesh = unit_sphere(2);
  mesh.nodes *= kRadius;
  RowMatrix T = RowMatrix::Zero(mesh.nodes.size(), 2);
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) {
    T.block(3 * n, 0, 3, 1) = mesh.nodes.row(n).transpose() / kRadius;
    T(3 * n + 2, 1) = 1.0;
  }
  return model_on(mesh, T, 2000.0);
}

inline SoundOptions sphere_options() {
  SoundOptions options;
  options.skin.mesh = {.opening = 0.05, .edges_per_wavelength = 8.0};
  options.grid = {.from_hz = 300.0, .to_hz = 700.0, .tolerance_db = 1.0};
  options.set = MicrophoneSet::kEngine1m;
  options.microphones = {{"beside", {0.6, 0, 0}}, {"above", {0, 0, 1.0}}};
  return options;
}

/// The sound of the sphere, computed once for all tests.
inline const PartSound& sphere_sound() {
  static const PartSound sound = [] {
    StepClock clock;
    return part_sound(sphere_model(), sphere_options(), clock);
  }();
  return sound;
}

/// A folder for rom.h5, run.h5 and field.h5 of a sphere.
class SphereRun : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder(::testing::UnitTest::GetInstance()->current_test_info()->name());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static constexpr double kLine = 500.0;  // 30 lines of a cycle at 2000 rpm
  const Eigen::Vector2d kMotion{1e-6, 2e-6};
  Summary recovered(const std::string& toml) {
    std::ofstream(folder_ / "field.toml") << toml;
    const Options options = field_keys().read(Config::load(folder_ / "field.toml"));
    const RunBody body(folder_ / "run.h5", "");
    H5File file = H5File::create(folder_ / "field.h5");
    StepClock clock;
    Summary summary = recover(body, body.read_model(), options, file, clock);
    file.set("/", "schema", kFieldSchema);
    file.commit();
    return summary;
  }
  std::filesystem::path folder_;
};

/// A sphere that pulsates and oscillates, and its sound file.
class SoundRun : public SphereRun {
 protected:
  void SetUp() override {
    SphereRun::SetUp();
    move(kMotion);
  }

  /// Writes the run with this amplitude at kLine, and the sound file.
  void move(const Eigen::Vector2d& amplitude) {
    const double w = 2 * kPi * kLine;
    write_inputs([&](double t) {
      Motion m{amplitude * std::cos(w * t), {}, {}};
      m.v = -w * amplitude * std::sin(w * t);
      m.a = -w * w * m.q;
      return m;
    });
  }
  void write_inputs(const MotionLaw& law) {
    write_run(folder_, sphere_model(), RunPlan{}, law);
    write_sound_file();
  }
  /// Of the reduced model in the folder.
  void write_sound_file() {
    rom_ = sha256_of_file(folder_ / "rom.h5");
    H5File file = H5File::create(folder_ / "part.sound.h5");
    file.set("/", "schema", kSoundSchema);
    file.set("/", "version", version());
    write_sound(file, sphere_sound(), sphere_options(), rom_);
    file.commit();
  }

  std::string rom_;
};

}  // namespace clatter::recover::testing
