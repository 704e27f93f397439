// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <vector>

#include "core/base/artefact.hpp"
#include "tests/scratch.hpp"

namespace clatter::recover::testing {
namespace {

using Corners = std::vector<std::array<int32_t, 3>>;
using Points = std::vector<Eigen::Vector3d>;

/// Adds the mid-side node of each edge once, on the sphere if `onto_sphere`.
class MidSideNodes {
 public:
  MidSideNodes(Points& points, bool onto_sphere) : points_(points), onto_sphere_(onto_sphere) {}
  int32_t of(int32_t a, int32_t b) {
    const auto key = std::minmax(a, b);
    const auto [at, is_new] = known_.try_emplace(key, static_cast<int32_t>(points_.size()));
    if (is_new) {
      const Eigen::Vector3d middle = 0.5 * (points_[a] + points_[b]);
      points_.push_back(onto_sphere_ ? Eigen::Vector3d(middle.normalized()) : middle);
    }
    return at->second;
  }

 private:
  Points& points_;
  bool onto_sphere_;
  std::map<std::pair<int32_t, int32_t>, int32_t> known_;
};

Mesh6 quadratic(Points points, const Corners& corners, bool onto_sphere) {
  MidSideNodes mid_side_nodes(points, onto_sphere);
  Mesh6 mesh;
  mesh.triangles.resize(static_cast<Eigen::Index>(corners.size()), 6);
  for (size_t f = 0; f < corners.size(); ++f) {
    const auto& [a, b, c] = corners[f];
    mesh.triangles.row(static_cast<Eigen::Index>(f)) << a, b, c, mid_side_nodes.of(a, b),
        mid_side_nodes.of(b, c), mid_side_nodes.of(c, a);
  }
  mesh.nodes.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (size_t i = 0; i < points.size(); ++i)
    mesh.nodes.row(static_cast<Eigen::Index>(i)) = points[i];
  return mesh;
}

}  // namespace

Mesh6 unit_sphere(int levels) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Points points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (auto& p : points) p.normalize();
  Corners corners{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                  {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                  {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                  {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    MidSideNodes mid_side_nodes(points, true);
    Corners finer;
    for (const auto& [a, b, c] : corners) {
      const int32_t ab = mid_side_nodes.of(a, b), bc = mid_side_nodes.of(b, c),
                    ca = mid_side_nodes.of(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    corners = finer;
  }
  return quadratic(points, corners, true);
}

Mesh6 box(const Eigen::Vector3d& size, int n) {
  Points points;
  std::map<std::array<int, 3>, int32_t> ids;
  const auto node = [&](std::array<int, 3> ijk) {
    const auto [at, is_new] = ids.try_emplace(ijk, static_cast<int32_t>(points.size()));
    if (is_new)
      points.emplace_back(size[0] * ijk[0] / n, size[1] * ijk[1] / n, size[2] * ijk[2] / n);
    return at->second;
  };
  Corners corners;
  for (int d = 0; d < 3; ++d)
    for (int end : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int di, int dj) {
            std::array<int, 3> ijk{};
            ijk[d] = end;
            ijk[(d + 1) % 3] = i + di;
            ijk[(d + 2) % 3] = j + dj;
            return node(ijk);
          };
          const int32_t a = at(0, 0), b = at(1, 0), c = at(1, 1), e = at(0, 1);
          if (end == n)
            corners.insert(corners.end(), {{a, b, c}, {a, c, e}});
          else
            corners.insert(corners.end(), {{a, c, b}, {a, e, c}});
        }
  return quadratic(points, corners, false);
}

Mesh6 hollow_box(const Eigen::Vector3d& size, int n) {
  Mesh6 outer = box(size, n), hole = box(size / 3, n);
  hole.nodes.rowwise() += size.transpose() / 3;
  const Eigen::Index n_outer = outer.nodes.rows(), f_outer = outer.triangles.rows();
  outer.nodes.conservativeResize(n_outer + hole.nodes.rows(), 3);
  outer.nodes.bottomRows(hole.nodes.rows()) = hole.nodes;
  outer.triangles.conservativeResize(f_outer + hole.triangles.rows(), 6);
  // Reversed: corners 0 2 1, and mid-side nodes 02, 21, 10.
  for (Eigen::Index f = 0; f < hole.triangles.rows(); ++f)
    for (int a = 0; a < 6; ++a) {
      static constexpr int kTurned[6] = {0, 2, 1, 5, 4, 3};
      outer.triangles(f_outer + f, a) =
          hole.triangles(f, kTurned[a]) + static_cast<int32_t>(n_outer);
    }
  return outer;
}

rom::Skin bare_skin(const Mesh6& mesh, const std::map<std::string, std::vector<int32_t>>& faces) {
  rom::Skin skin{mesh.nodes, mesh.triangles};
  skin.faces = faces;
  return skin;
}

RowMatrix random_rows(const Mesh6& mesh, int r, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  RowMatrix T(3 * mesh.nodes.rows(), r);
  for (Eigen::Index i = 0; i < T.size(); ++i) T.data()[i] = number(random);
  return T;
}

rom::ReducedModel model_on(const Mesh6& mesh, const RowMatrix& T, double valid_to_hz) {
  const Eigen::Index r = T.cols();
  rom::ReducedModel model;
  model.name = "block";
  model.method = "craig-bampton";
  model.n_boundary = 1;
  model.M_rr = model.K_rr = Eigen::MatrixXd::Identity(r, r);
  model.rigid = Eigen::MatrixXd::Zero(r, 6);
  model.mass.mass = 1.0;
  model.valid_to_hz = valid_to_hz;
  model.certificate.certified = 1.0;
  model.skin = {mesh.nodes, mesh.triangles, T};
  rom::DofSet sensor;
  sensor.kind = "sensor";
  sensor.dofs = {0};
  sensor.labels = {"sensor_block.y"};
  sensor.position = Eigen::MatrixXd::Zero(1, 3);
  sensor.direction = Eigen::RowVector3d::UnitY();
  sensor.is_rotation = {0};
  model.sets["sensor_block"] = sensor;
  return model;
}

PartSound sound_of_rigid(const rom::Skin& skin, double to_hz, double shape_error) {
  RowMatrix T = RowMatrix::Zero(skin.nodes.size(), 3);
  for (Eigen::Index n = 0; n < skin.nodes.rows(); ++n) T.middleRows(3 * n, 3).setIdentity();
  rom::ReducedModel model = model_on({skin.nodes, skin.triangles}, T, 5000.0);
  model.skin = skin;
  model.skin.T = T;
  SoundOptions options;
  options.skin.mesh.shape_error = shape_error;
  options.grid.from_hz = 50.0;
  options.grid.to_hz = to_hz;
  options.grid.tolerance_db = 2.0;
  StepClock clock;
  return part_sound(model, options, clock);
}

std::filesystem::path write_run(const std::filesystem::path& folder, const rom::ReducedModel& model,
                                const RunPlan& plan, const MotionLaw& law) {
  const auto rom_path = folder / "rom.h5", run_path = folder / "run.h5";
  H5File rom = H5File::create(rom_path);
  rom::write_reduced_model(rom, model);
  write_provenance(rom, {"clatter/rom/1", "", {}});
  rom.commit();

  const int n_t = plan.samples * plan.cycles + 1;
  const double step = plan.cycle_s() / plan.samples;
  Eigen::VectorXd time(n_t), angle(n_t);
  RowMatrix q(n_t, model.size()), v = q, a = q;
  for (int i = 0; i < n_t; ++i) {
    time[i] = i * step;
    angle[i] = plan.first_angle_deg + i * 720.0 / plan.samples;
    const Motion motion = law(time[i] + plan.first_angle_deg / 720.0 * plan.cycle_s());
    q.row(i) = motion.q;
    v.row(i) = motion.v;
    a.row(i) = motion.a;
  }
  H5File run = H5File::create(run_path);
  write_provenance(run, {"clatter/run/1", "", {}});
  run.write("output/time", time);
  run.write("output/crank_angle_deg", angle);
  run.write("bodies/block/q", q);
  run.write("bodies/block/v", v);
  run.write("bodies/block/a", a);
  run.set("bodies/block", "rom", "rom.h5");
  run.set("bodies/block", "rom_sha256", sha256_of_file(rom_path));
  run.commit();
  return run_path;
}

std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder = test::scratch_path("recover_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

int run_command(const std::string& command, std::string& output) {
  output.clear();
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return -1;
  char buffer[4096];
  while (const size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
  const int status = ::pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace clatter::recover::testing
