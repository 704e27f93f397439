// SPDX-License-Identifier: GPL-3.0-or-later
// A cantilever against beam theory and against CalculiX on the same mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include <Eigen/LU>

#include "block_mesh.hpp"
#include "core/base/log.hpp"
#include "core/fe/element.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"
#include "mesh/exports/mesh_export.hpp"
#include "small_solver.hpp"
#include "tests/scratch.hpp"

namespace clatter::assembly::testing {
namespace {

constexpr double kLength = 0.4, kWidth = 0.03, kHeight = 0.02;

mesh::Mesh beam(std::array<int, 3> n) { return block_mesh(n, brick({kLength, kWidth, kHeight})); }

fe::FeModel clamped(mesh::Mesh mesh, const std::string& nu) {
  set_quiet(true);
  const Config config =
      Config::parse("[material.steel]\nregions = [\"body\"]\nE_gpa = 210.0\nnu = " + nu +
                        "\nrho = 7800.0\n[[support]]\nsurface = \"x0\"\n",
                    "beam.fe.toml");
  StepClock clock;
  return build_fe_model(mesh, read_recipe(config, mesh), clock).model;
}

/// First `count` bending frequencies [Hz] of a clamped-free Timoshenko beam (Huang, J. Appl. Mech.
/// 28 (1961), "effect of rotatory inertia and of shear deformation", clamped-free equation).
std::vector<double> timoshenko_hz(double height, int count) {
  const double E = 2.1e11, G = 1.05e11, rho = 7800.0, kappa = 5.0 / 6.0;  // nu = 0
  const double r2 = height * height / 12.0 / (kLength * kLength);         // I / (A L^2)
  const double s2 = E * r2 / (kappa * G);
  const auto equation = [&](double b) {
    const double root = std::sqrt((r2 - s2) * (r2 - s2) + 4.0 / (b * b));
    const double alpha = std::sqrt(0.5 * (root - r2 - s2)),
                 beta = std::sqrt(0.5 * (root + r2 + s2));
    return 2.0 + (b * b * (r2 - s2) * (r2 - s2) + 2.0) * std::cosh(b * alpha) * std::cos(b * beta) -
           b * (r2 + s2) / std::sqrt(1.0 - b * b * r2 * s2) * std::sinh(b * alpha) *
               std::sin(b * beta);
  };
  std::vector<double> hz;
  const double to_hz = std::sqrt(E * r2 / rho) / kLength / (2.0 * std::numbers::pi);
  for (double b = 0.5; static_cast<int>(hz.size()) < count; b += 0.1) {
    if (equation(b) * equation(b + 0.1) > 0.0) continue;
    double low = b, high = b + 0.1;
    for (int i = 0; i < 60; ++i) {
      const double mid = 0.5 * (low + high);
      (equation(low) * equation(mid) <= 0.0 ? high : low) = mid;
    }
    hz.push_back(low * to_hz);
  }
  return hz;
}

TEST(Cantilever, FrequenciesAreThoseOfBeamTheory) {
  // nu = 0, so that the clamp does not constrain the section and beam theory is exact. What remains
  // is the mesh's error, which grows with the fourth power of cells per wave: half of the bound.
  const fe::FeModel model = clamped(beam({40, 3, 2}), "0.0");
  const Eigen::VectorXd hz = lowest_hz(model.K, model.M, 8);
  std::vector<double> want = timoshenko_hz(kHeight, 3);
  for (const double f : timoshenko_hz(kWidth, 2)) want.push_back(f);
  for (const double f : want) {
    const double nearest = (hz.array() / f - 1.0).cwiseAbs().minCoeff();
    EXPECT_LT(nearest, 1e-3) << f << " Hz";
  }
  // Slender limit of the first: 1.875104^2 / (2 pi L^2) sqrt(E I / rho A), above Timoshenko's.
  const double euler = 1.875104069 * 1.875104069 / (2.0 * std::numbers::pi * kLength * kLength) *
                       std::sqrt(2.1e11 * kHeight * kHeight / 12.0 / 7800.0);
  EXPECT_NEAR(hz(0) / euler, 1.0, 3e-3);
}

TEST(Cantilever, StretchingFrequencyIsAQuarterWave) {
  // nu = 0: the rod's u = sin(pi x / 2 L) is a solution of the solid as well.
  const fe::FeModel model = clamped(beam({14, 1, 1}), "0.0");
  const Eigen::VectorXd hz = lowest_hz(model.K, model.M, 12);
  const double want = std::sqrt(2.1e11 / 7800.0) / (4.0 * kLength);
  EXPECT_LT((hz.array() / want - 1.0).cwiseAbs().minCoeff(), 1e-6);
}

void write_deck(const std::filesystem::path& folder) {
  std::ofstream deck(folder / "modes.inp");
  deck << "*INCLUDE, INPUT=beam.inp\n"
          "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7800.\n"
          "*SOLID SECTION, ELSET=body, MATERIAL=STEEL\n"
          "*BOUNDARY\nx0, 1, 3, 0.\n"
          "*STEP\n*FREQUENCY\n10\n*END STEP\n";
}

/// Fourth column of the table under "E I G E N V A L U E   O U T P U T": cycles per time.
std::vector<double> read_hz(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<double> hz;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.find("E I G E N V A L U E") != std::string::npos) inside = true;
    if (line.find("P A R T I C I P A T I O N") != std::string::npos) break;
    std::istringstream stream(line);
    double number = 0.0, eigenvalue = 0.0, radians = 0.0, cycles = 0.0;
    if (inside && stream >> number >> eigenvalue >> radians >> cycles) hz.push_back(cycles);
  }
  return hz;
}

/// What CalculiX 2.20 finds, for systems without it: Debian 13 has no package calculix-ccx. Where
/// it is installed, `assembly_reference_test --gtest_filter='*Calculix*'` prints each that differs.
constexpr std::array<double, 10> kStoredHz = {105.2561, 157.3064, 652.4152, 961.3403, 1735.973,
                                              1796.645, 2593.820, 3251.956, 3441.522, 4842.731};

/// CalculiX's ten lowest frequencies of the mesh, clamped at x0; the stored ones without CalculiX.
std::vector<double> calculix_hz(const mesh::Mesh& mesh) {
  const char* installed =
      "test -z \"$CLATTER_WITHOUT_CALCULIX\" && command -v ccx > /dev/null 2>&1";
  if (std::system(installed) != 0) return {kStoredHz.begin(), kStoredHz.end()};
  const std::filesystem::path folder = test::scratch_path("ccx");
  std::filesystem::create_directories(folder);
  mesh::Mesh clamped = mesh;
  clamped.node_sets["x0"] = mesh::nodes_of(mesh.surface("x0"));
  mesh::export_mesh(clamped, folder / "beam.inp");
  write_deck(folder);
  const std::string command =
      "cd '" + folder.string() + "' && OMP_NUM_THREADS=1 ccx modes > ccx.log 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::vector<double> hz = read_hz(folder / "modes.dat");
  std::filesystem::remove_all(folder);
  EXPECT_EQ(hz.size(), kStoredHz.size());
  for (size_t k = 0; k < hz.size(); ++k)
    EXPECT_NEAR(hz[k] / kStoredHz.at(k), 1.0, 1.01e-6) << "CalculiX finds " << hz[k] << " Hz";
  return hz;
}

/// The mass with four points a cell, as CalculiX integrates C3D10; supported rows are excluded.
SparseMatrix four_point_mass(const mesh::Mesh& mesh, const fe::FeModel& model) {
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  const IndexMatrix& cells = mesh.cells[0].nodes;
  for (Eigen::Index c = 0; c < cells.rows(); ++c) {
    Eigen::Matrix<double, 10, 3> x;
    for (int a = 0; a < 10; ++a) x.row(a) = mesh.nodes.row(cells(c, a));
    for (Eigen::Index q = 0; q < 4; ++q) {
      const auto shape =
          mesh::cell_shape(mesh::CellType::kTet10, mesh::tet_rule_4().points.row(q).transpose());
      const double dm = 7800.0 * mesh::tet_rule_4().weights(q) *
                        Eigen::Matrix3d(x.transpose() * shape.gradient).determinant();
      for (int a = 0; a < 10; ++a)
        for (int b = 0; b < 10; ++b)
          for (int d = 0; d < 3; ++d)
            entries.emplace_back(3 * cells(c, a) + d, 3 * cells(c, b) + d,
                                 dm * shape.value(a) * shape.value(b));
    }
  }
  SparseMatrix M(model.T.rows(), model.T.rows());
  M.setFromTriplets(entries.begin(), entries.end());
  return SparseMatrix(
      SparseMatrix(model.T.transpose() * M * model.T).triangularView<Eigen::Lower>());
}

TEST(Cantilever, FrequenciesAreThoseOfCalculixOnTheExportedMesh) {
  const mesh::Mesh mesh = beam({20, 3, 2});
  const std::vector<double> theirs = calculix_hz(mesh);
  const fe::FeModel model = clamped(mesh, "0.3");
  const Eigen::VectorXd ours = lowest_hz(model.K, model.M, 10);
  const Eigen::VectorXd alike = lowest_hz(model.K, four_point_mass(mesh, model), 10);
  for (size_t k = 0; k < theirs.size(); ++k) {
    const auto mode = static_cast<Eigen::Index>(k);
    // CalculiX integrates the mass of C3D10 with the four points of its stiffness, which is exact
    // to degree 2 of 4. With the same points all agree to the seven digits that it prints; our
    // exact mass differs within the mesh's own error.
    EXPECT_NEAR(alike(mode) / theirs[k], 1.0, 1e-6) << "mode " << k + 1;
    EXPECT_NEAR(ours(mode) / theirs[k], 1.0, 1e-4) << "mode " << k + 1;
  }
}

}  // namespace
}  // namespace clatter::assembly::testing
