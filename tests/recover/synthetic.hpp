// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small skins, reduced models and runs with known solutions.
#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/rom/reduced_model.hpp"
#include "recover/sound/sound_build.hpp"

namespace clatter::recover::testing {

struct Mesh6 {
  RowMatrix nodes;
  IndexMatrix triangles;
};

/// A sphere of radius 1 about the origin: the icosahedron, each face split `levels` times in four,
/// every node (mid-side nodes too) on the sphere. 20 * 4^levels faces.
Mesh6 unit_sphere(int levels);

/// A box [0, size] of flat quadratic triangles, n x n squares per side, two triangles each.
Mesh6 box(const Eigen::Vector3d& size, int n);

/// The box with a box-shaped hole in its middle third: two closed shells in one skin, all normals
/// out of the solid.
Mesh6 hollow_box(const Eigen::Vector3d& size, int n);

/// The skin of `mesh` without rows T.
rom::Skin bare_skin(const Mesh6& mesh,
                    const std::map<std::string, std::vector<int32_t>>& faces = {});

/// A random field of r columns on the skin of `mesh`, seeded.
RowMatrix random_rows(const Mesh6& mesh, int r, unsigned seed);

/// A reduced model with the given skin, identity mass, one sensor set "sensor_block" (coordinate
/// 0).
rom::ReducedModel model_on(const Mesh6& mesh, const RowMatrix& T, double valid_to_hz);

/// The sound of a body that moves along x, y and z without deforming, from 50 Hz; between the
/// frequencies that are computed within 2 dB.
PartSound sound_of_rigid(const rom::Skin& skin, double to_hz, double shape_error = 0.02);

/// Motion of reduced coordinates: displacement, velocity and acceleration at a time.
struct Motion {
  Eigen::VectorXd q, v, a;
};
using MotionLaw = std::function<Motion(double time_s)>;

/// A steady run: body "block", `cycles` times 720 degrees at `speed_rpm`, `samples` per cycle.
struct RunPlan {
  double speed_rpm = 2000.0;
  int samples = 720;
  int cycles = 2;
  double first_angle_deg = 0.0;
  double cycle_s() const { return 120.0 / speed_rpm; }
};

/// Writes rom.h5 and run.h5 into `folder`; `law` is given times from angle 0. Returns the run's
/// path.
std::filesystem::path write_run(const std::filesystem::path& folder, const rom::ReducedModel& model,
                                const RunPlan& plan, const MotionLaw& law);

/// A fresh folder under the system's temporary one.
std::filesystem::path fresh_folder(const std::string& name);

/// Runs a shell command; `output` gets both output streams. Returns its exit code.
int run_command(const std::string& command, std::string& output);

}  // namespace clatter::recover::testing
