// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/slap_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/write_artefact.hpp"
#include "dynamics/run/run_file.hpp"
#include "tests/dynamics/motored_cycle.hpp"
#include "tests/dynamics/synthetic.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics::testing {

namespace fs = std::filesystem;

fs::path test_folder() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const fs::path folder = fs::path(::testing::TempDir()) / "clatter_dynamics_runs" /
                          test->test_suite_name() / test->name();
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

void write_slap_scene(const fs::path& folder) {
  write_rom(folder / "piston.rom.h5", rigid_piston(1.9, 4e-3, 8.992e-3));
  write_rom(folder / "block.rom.h5", elastic_block(0.0535, 8, 6));
  write_rom(folder / "bar.rom.h5", clamped_bar(1.0, 100, 10));
  write_motored_cycle(folder / "motored.csv", {}, 0.0174532925199432957);
  std::ofstream(folder / "slap.run.toml") << R"(
[engine]
speed_rpm = 2000.0
stroke_mm = 130.0
[rod]
length_mm = 210.0
mass_kg = 2.2
inertia_kg_m2 = 0.02
centre_mm = 70.0
[time]
cycles = 2
output_step_us = 50.0
[gas]
table = "motored.csv"
[piston]
rom = "piston.rom.h5"
model = "rigid"
[block]
rom = "block.rom.h5"
model = "rigid"
[contact]
bore_mm = 107.0
clearance_um = 20.0
barrel_top_um = 30.0
barrel_bottom_um = 20.0
ovality_um = 40.0
cells_around = 6
cells_along = 6
oil_thickness_um = 5.0
)";
}

std::string dry_engine(double stiffness) {
  return fmt::format(R"(
[block]
model = "elastic"
mode_limit_hz = 3000.0
[contact]
lubrication = "none"
clearance_um = 2.0
asperity_loss_factor = 0.3
[[mount]]
sets = ["mounts"]
stiffness_n_m = [{0}, {0}, {1}]
damping_n_s_m = [{2}, {2}, {3}]
)",
                     stiffness, 2.0 * stiffness, 1e-2 * stiffness, 2e-2 * stiffness);
}

std::string in_line_cylinder(int number, const std::string& keys) {
  const int firing[] = {0, 180, 540, 360};
  return fmt::format(R"(
[[cylinder]]
name = "c{0}"
firing_deg = {1}
{3}
[cylinder.block]
liner = "liner_{0}"
liner_axial = "liner_{0}_axial"
bearings = ["main_{0}", "main_{2}"]
gas_load = "head_{0}_gas"
)",
                     number, firing[number - 1], number + 1, keys);
}

Scene changed_scene(const fs::path& folder, const std::string& changes) {
  std::ofstream(folder / "changed.run.toml") << "base = \"slap.run.toml\"\n" << changes;
  return read_scene(folder / "changed.run.toml");
}

std::string scene_refusal(const fs::path& folder, const std::string& changes) {
  return test::refusal_of([&] {
    const Scene scene = changed_scene(folder, changes);
    build_model(scene, load_bodies(scene));
  });
}

H5File finished_file(const Scene& scene, const LoadedBodies& bodies, RunResult& result) {
  write_run(scene, bodies, result);
  const fs::path path = result.file->path();
  finish_artefact(*result.file, path, provenance_of(scene), {}, {});
  return open_artefact(path, "clatter/run/1");
}

H5File complete_file(const Scene& scene, const std::filesystem::path& output, RunResult& result) {
  RunControl control;
  control.output = output;
  const LoadedBodies bodies = load_bodies(scene);
  result = simulate(scene, bodies, control);
  EXPECT_TRUE(result.complete) << result.failure;
  return finished_file(scene, bodies, result);
}

}  // namespace clatter::dynamics::testing
