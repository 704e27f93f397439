// SPDX-License-Identifier: GPL-3.0-or-later
// Sound by panel, directivity, and standard microphone positions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/sound/spherical_harmonics.hpp"
#include "recover/sound/measurement_surface.hpp"
#include "sound_run.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;

/// Power of the motion v P_l(cos theta) of a sphere's surface [W]: 1/2 rho c sigma_l int v^2 dS,
/// sigma_l = 1 / ((ka)^2 |h_l'(ka)|^2).
double power_of_degree(const sound::Fluid& air, unsigned l, double ka, double v) {
  using sound::Complex;
  const auto h = [ka](unsigned n) {
    return Complex(std::sph_bessel(n, ka), -std::sph_neumann(n, ka));
  };
  const Complex slope = static_cast<double>(l) / ka * h(l) - h(l + 1);
  const double sigma = 1.0 / (ka * ka * std::norm(slope));
  return 0.5 * air.impedance() * sigma * v * v * 4.0 * kPi * kRadius * kRadius / (2.0 * l + 1.0);
}

/// int_0^1 P_l(z) dz, by the midpoint rule.
double upper_half_of(unsigned l) {
  constexpr int kSteps = 20000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += std::legendre(l, (i + 0.5) / kSteps) / kSteps;
  return sum;
}

// No face of an icosahedron is along the plane between them.
constexpr const char* kHalves =
    "sound = 'part.sound.h5'\n[spectrum]\nto_hz = 1500\n"
    "[[panel]]\nname = 'upper'\ndirection = [0.31, 0.52, 0.79]\nangle_deg = 90\n"
    "[[panel]]\nname = 'lower'\ndirection = [-0.31, -0.52, -0.79]\nangle_deg = 90\n";

TEST_F(SoundRun, HalvesOfAPulsatingSphereHaveTheirOwnPowerAndTheirExchange) {
  move({1e-6, 0.0});
  const Summary summary = recovered(kHalves);
  const PanelSound& panels = summary.sounds.at(0).panels;
  ASSERT_EQ(panels.panels, (std::vector<std::string>{"skin", "upper", "lower"}));
  const sound::Fluid air = sphere_sound().table.fluid;
  const double ka = air.wavenumber(kLine) * kRadius, v = 2 * kPi * kLine * 1e-6;
  double own = 0.0, between = 0.0;  // the upper half moves with sum_l (2 l + 1) int_0^1 P_l dz P_l
  for (unsigned l = 0; l < 40; ++l) {
    const double power = power_of_degree(air, l, ka, v * (2 * l + 1) * 0.5 * upper_half_of(l));
    own += power;
    between += l % 2 == 0 ? power : -power;
  }
  // The wrap has 300 faces, as in SphereHasItsEfficiencyAndPressure; the halves have ragged edges.
  EXPECT_NEAR(panels.own(30, 1) / own, 1.0, 0.05);
  EXPECT_NEAR(panels.own(30, 2) / own, 1.0, 0.05);
  EXPECT_NEAR(panels.power(30, 1) / (own + between), 1.0, 0.05);
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(3, 3);
  for (const Eigen::MatrixXd& band : panels.exchange) exchange += band;
  EXPECT_NEAR(exchange(1, 2), between, 0.05 * own);
  EXPECT_NEAR(exchange(1, 2), exchange(2, 1), 1e-12 * between);
}

TEST_F(SoundRun, PanelsSumToThePowerOfThePart) {
  const Summary summary = recovered(kHalves);
  const RunSound& sound = summary.sounds.at(0);
  const PanelSound& panels = sound.panels;
  EXPECT_LT(panels.sum_difference, 1e-9);
  EXPECT_EQ(summary.certificate.panel_power_difference, panels.sum_difference);
  EXPECT_NEAR((panels.total[1] + panels.total[2]) / sound.total, 1.0, 1e-9);
  EXPECT_NEAR(panels.total[0] / sound.total, 1.0, 1e-9);
  EXPECT_NEAR((panels.total_a[1] + panels.total_a[2]) / sound.total_a, 1.0, 1e-9);
  // The halves are in phase by pulsating and out of phase by oscillating: they differ.
  EXPECT_GT(std::abs(panels.total[1] - panels.total[2]), 0.01 * sound.total);
  const H5File file = H5File::open(folder_ / "field.h5");
  const std::string at = "analysis/cycle/panels/upper";
  EXPECT_NEAR(file.read_vector(at + "/sound_power")[30], panels.total[1], 1e-9 * sound.total);
  EXPECT_NEAR(file.get_double(at, "sound_power_share"), panels.total[1] / sound.total, 1e-9);
  EXPECT_NEAR(file.get_double(at, "sound_power_db"), 10 * std::log10(panels.total[1] / 1e-12),
              1e-6);
  EXPECT_NEAR(file.read_vector(at + "/third_octave/sound_power_db").maxCoeff(),
              10 * std::log10(panels.total[1] / 1e-12), 1e-6);
  double in_bands = 0.0;
  for (const std::string& band : file.list("analysis/cycle/sound/exchange/third_octave"))
    in_bands += file.read_matrix("analysis/cycle/sound/exchange/third_octave/" + band)(0, 0);
  EXPECT_NEAR(in_bands / sound.total, 1.0, 1e-9);
}

TEST_F(SoundRun, DirectivityOfAPulsatingAndAnOscillatingSphere) {
  for (const bool pulsates : {true, false}) {
    move(pulsates ? Eigen::Vector2d(1e-6, 0.0) : Eigen::Vector2d(0.0, 1e-6));
    const Summary summary = recovered("sound = 'part.sound.h5'\n[spectrum]\nto_hz = 1500\n");
    const Directivity& found = summary.sounds.at(0).directivity;
    EXPECT_LT(found.power_difference, 1e-9);
    Eigen::Index band = 0;
    found.mean_square.rowwise().sum().maxCoeff(&band);
    EXPECT_EQ(found.bands.nominal[band], "500");
    // A dipole sends cos^2 theta, three times its mean along the axis.
    const double axis = found.directions.unit.col(2).cwiseAbs().maxCoeff();
    EXPECT_NEAR(found.index_db[band], pulsates ? 0.0 : 10 * std::log10(3.0 * axis * axis), 0.1);
    const double largest = found.mean_square.row(band).maxCoeff();
    for (Eigen::Index d = 0; d < found.theta_deg.size(); ++d) {
      const double z = std::cos(kPi / 180.0 * found.theta_deg[d]);
      EXPECT_NEAR(found.mean_square(band, d) / largest, pulsates ? 1.0 : z * z / (axis * axis),
                  0.03);
    }
    // The power through the distant sphere.
    const double power = found.mean_square.row(band).dot(found.directions.weight) /
                         sphere_sound().table.fluid.impedance();
    EXPECT_NEAR(power / summary.sounds[0].total, 1.0, 1e-9);
    EXPECT_EQ(summary.certificate.directivity_power_difference, found.power_difference);
  }
}

TEST_F(SoundRun, LevelOnTheMeasurementSurfaceIsThatOfItsMicrophones) {
  move({1e-6, 0.0});
  const RunSound sound =
      recovered("sound = 'part.sound.h5'\n[spectrum]\nto_hz = 1500\n").sounds.at(0);
  const sound::Fluid air = sphere_sound().table.fluid;
  // All five are 1.2 m from the middle: p^2 = rho c P / (4 pi r^2). The acoustic skin is a
  // millimetre larger than the sphere.
  const double p2 = air.impedance() * sound.total / (4.0 * kPi * 1.2 * 1.2);
  EXPECT_EQ(sound.surface.name, "engine_1m");
  EXPECT_NEAR(sound.surface.area, 6.0 * 2.4 * 2.4, 0.1);
  EXPECT_NEAR(sound.surface.pressure_db, 10 * std::log10(p2 / 4e-10), 0.1);
  EXPECT_NEAR(sound.surface.above_power_db,
              10 * std::log10(air.impedance() / 400.0 * 6.0 * 2.4 * 2.4 / (4.0 * kPi * 1.44)), 0.1);
  const H5File file = H5File::open(folder_ / "field.h5");
  const std::string at = "analysis/cycle/sound/measurement_surface";
  EXPECT_NEAR(file.read_vector(at + "/third_octave/power_db").maxCoeff(), sound.surface.power_db,
              1e-6);
  EXPECT_EQ(file.get_string(at, "set"), "engine_1m");
}

/// A table with one node of flow at 500 Hz, whose far field is 3 Pa m per flow in all directions
/// and 1 Pa m times sqrt(3) z.
SoundTable one_node_table(const std::optional<sound::Plane>& ground) {
  SoundTable table{.fluid = {1.2, 340.0}, .ground = ground, .distance = Eigen::VectorXd(0)};
  SoundSample sample{500.0, Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXcd(0, 1)};
  sample.far = Eigen::MatrixXcd::Zero(4, 1);
  sample.far(0, 0) = 3.0 * std::sqrt(4.0 * kPi);
  if (!ground) sample.far(2, 0) = std::sqrt(4.0 * kPi);  // Y_10 = sqrt(3 / (4 pi)) z
  table.samples = {sample};
  return table;
}

/// One line at 500 Hz, of amplitude 1 in one coordinate, in steps of 50 Hz.
Analysis one_line() {
  Analysis analysis;
  analysis.velocity.frequency_hz = Eigen::VectorXd::LinSpaced(13, 0.0, 600.0);
  analysis.velocity.amplitude = Eigen::MatrixXcd::Zero(13, 1);
  analysis.velocity.amplitude(10, 0) = sound::Complex(0.0, 1.0);
  analysis.velocity.power_factor = Eigen::VectorXd::Constant(13, 0.5);
  analysis.velocity.periodic = true;
  return analysis;
}

TEST(PanelSound, TwoPartsAgainstEachOtherByHand) {
  // Flows 1 and -1/2: F_1 = 3, F_2 = -1.5 Pa m and so on; int |F_1|^2 = 4 pi (9 + 1).
  const SoundTable table = one_node_table(std::nullopt);
  const Analysis analysis = one_line();
  PanelParts parts{{"a", "b", "both"}, Eigen::MatrixXd(2, 3), {}};
  parts.belongs << 1, 0, 1, 0, 1, 1;
  parts.flows = {RowMatrix::Constant(1, 1, 1.0), RowMatrix::Constant(1, 1, -0.5)};
  const auto directions = sound::sphere_directions(1);
  const LineSums sums =
      line_sums(table, analysis.velocity, parts, sound::spherical_harmonics(directions.unit, 1));
  const double unit = 0.5 * 4.0 * kPi * 10.0 / (1.2 * 340.0);
  ASSERT_EQ(sums.power.size(), 11);
  EXPECT_NEAR(sums.power[10], 0.25 * unit, 1e-14);
  EXPECT_EQ(sums.power[9], 0.0);
  const ThirdOctaves bands = third_octaves(400.0, 600.0, 50.0);
  const PanelSound panels = panel_sound(analysis, parts, sums, bands, Options{});
  EXPECT_NEAR(panels.own(10, 0), unit, 1e-14);
  EXPECT_NEAR(panels.own(10, 1), 0.25 * unit, 1e-14);
  EXPECT_NEAR(panels.power(10, 0), 0.5 * unit, 1e-14);    // 1 - 1/2
  EXPECT_NEAR(panels.power(10, 1), -0.25 * unit, 1e-14);  // 1/4 - 1/2: takes up power
  EXPECT_NEAR(panels.power(10, 2), 0.25 * unit, 1e-14);
  EXPECT_NEAR(panels.exchange.at(0)(0, 1), -0.5 * unit, 1e-14);
  EXPECT_NEAR(panels.exchange.at(0)(2, 2), 0.25 * unit, 1e-14);
  EXPECT_EQ(panels.band_db(0, 1), kSilence);
  EXPECT_NEAR(panels.total[1], -0.25 * unit, 1e-14);
  EXPECT_LT(panels.sum_difference, 1e-14);
}

TEST(Directivity, SourceOfADipoleAndAMonopoleByHand) {
  const SoundTable table = one_node_table(std::nullopt);
  const Analysis analysis = one_line();
  const PanelParts parts{{}, Eigen::MatrixXd(1, 0), {RowMatrix::Constant(1, 1, 1.0)}};
  const auto directions = sound::sphere_directions(1);
  const LineSums sums =
      line_sums(table, analysis.velocity, parts, sound::spherical_harmonics(directions.unit, 1));
  const Directivity found =
      directivity(table, analysis.velocity, sums, directions, third_octaves(400.0, 600.0, 50.0));
  const double up = 3.0 + std::sqrt(3.0) * directions.unit.col(2).maxCoeff();
  EXPECT_NEAR(found.index_db[0], 10.0 * std::log10(up * up / 10.0), 1e-12);
  EXPECT_NEAR(found.mean_square.row(0).maxCoeff(), 0.5 * up * up, 1e-12);
  EXPECT_GT(directions.unit(found.loudest.at(0), 2), 0.0);
  EXPECT_LT(found.power_difference, 1e-14);
}

TEST(Directivity, NothingGoesBelowTheGroundAndTwiceAsMuchAbove) {
  const SoundTable table = one_node_table(sound::Plane{Eigen::Vector3d::UnitZ(), 0.0});
  const Analysis analysis = one_line();
  const PanelParts parts{{}, Eigen::MatrixXd(1, 0), {RowMatrix::Constant(1, 1, 1.0)}};
  const auto directions = sound::sphere_directions(1);
  const LineSums sums =
      line_sums(table, analysis.velocity, parts, sound::spherical_harmonics(directions.unit, 1));
  EXPECT_NEAR(sums.power[10], 0.5 * 2.0 * kPi * 9.0 / (1.2 * 340.0), 1e-14);
  const Directivity found =
      directivity(table, analysis.velocity, sums, directions, third_octaves(400.0, 600.0, 50.0));
  EXPECT_NEAR(found.index_db[0], 10.0 * std::log10(2.0), 1e-12);
  for (Eigen::Index d = 0; d < directions.unit.rows(); ++d)
    EXPECT_NEAR(found.mean_square(0, d), directions.unit(d, 2) > 0.0 ? 4.5 : 0.0, 1e-12);
}

/// A box of this size as a surface of twelve triangles, from the origin.
sound::Surface plain_box(const Eigen::Vector3d& size) {
  RowMatrix nodes(8, 3);
  for (int n = 0; n < 8; ++n)
    nodes.row(n) << (n & 1) * size[0], (n >> 1 & 1) * size[1], (n >> 2) * size[2];
  IndexMatrix faces(12, 3);
  faces << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6,
      1, 3, 5, 3, 7, 5;
  return sound::closed_surface(nodes, faces);
}

TEST(MeasurementSurface, SmallPartOnTheGroundHasNinePositions) {
  const auto part = plain_box({0.8, 0.6, 0.5});
  const MeasurementSurface surface = measurement_surface(
      MicrophoneSet::kIso3744, part, sound::Plane{Eigen::Vector3d::UnitZ(), -0.3});
  // 2 a = 2.8, 2 b = 2.6, c = 1.8 m; S = 4 (a b + b c + c a).
  EXPECT_NEAR(surface.area, 4 * (1.4 * 1.3 + 1.3 * 1.8 + 1.8 * 1.4), 1e-12);
  ASSERT_EQ(surface.microphones.size(), 9u);
  const auto expect_at = [&](size_t index, const Eigen::Vector3d& position) {
    EXPECT_LT((surface.microphones[index].position - position).norm(), 1e-12) << index;
  };
  expect_at(0, {1.8, 0.3, 0.6});
  expect_at(1, {-1.0, 0.3, 0.6});
  expect_at(2, {0.4, 1.6, 0.6});
  expect_at(3, {0.4, -1.0, 0.6});
  expect_at(4, {0.4, 0.3, 1.5});
  for (size_t m = 5; m < 9; ++m) EXPECT_NEAR(surface.microphones[m].position[2], 1.5, 1e-12);
  EXPECT_EQ(surface.microphones[8].name, "iso_09");
}

TEST(MeasurementSurface, LongSideIsDividedIntoRectanglesOfUpToThreeMetres) {
  const auto part = plain_box({3.0, 0.6, 0.5});
  // The side along x is 5 m long: two parts; the axis of the plane may point anywhere.
  const MeasurementSurface surface = measurement_surface(
      MicrophoneSet::kIso3744, part, sound::Plane{-Eigen::Vector3d::UnitY(), -1.0});
  // Two ends, two sides and a top of two parts each: 2 + 6 centres; upper corners at three x.
  EXPECT_EQ(surface.microphones.size(), 8u + 6u);
  EXPECT_NEAR(surface.area, 5.0 * 2.5 + 2 * 5.0 * 2.0 + 2 * 2.5 * 2.0, 1e-12);
  for (const Microphone& microphone : surface.microphones)
    EXPECT_LT(microphone.position[1], 1.0) << microphone.name;
}

TEST(MeasurementSurface, FivePositionsOfAnEngine) {
  const auto part = plain_box({0.8, 0.6, 0.5});
  const MeasurementSurface free = measurement_surface(MicrophoneSet::kEngine1m, part, std::nullopt);
  ASSERT_EQ(free.microphones.size(), 5u);
  EXPECT_NEAR(free.area, 2 * (2.8 * 2.6 + 2.6 * 2.5 + 2.5 * 2.8), 1e-12);
  EXPECT_EQ(free.microphones[0].name, "plus_y");
  EXPECT_LT((free.microphones[0].position - Eigen::Vector3d(0.4, 1.6, 0.25)).norm(), 1e-12);
  EXPECT_LT((free.microphones[4].position - Eigen::Vector3d(0.4, 0.3, 1.5)).norm(), 1e-12);
  const MeasurementSurface above = measurement_surface(
      MicrophoneSet::kEngine1m, part, sound::Plane{Eigen::Vector3d::UnitZ(), -0.3});
  EXPECT_NEAR(above.area, 4 * (1.4 * 1.3 + 1.3 * 1.8 + 1.8 * 1.4), 1e-12);
  EXPECT_EQ(measurement_surface(MicrophoneSet::kNone, part, std::nullopt).microphones.size(), 0u);
}

TEST(MeasurementSurface, IsoPositionsNeedAPlaneAlongAnAxis) {
  const auto part = plain_box({0.8, 0.6, 0.5});
  test::expect_parts(
      test::refusal_of([&] { measurement_surface(MicrophoneSet::kIso3744, part, std::nullopt); }),
      {"\"iso_3744\" needs [ground]:"});
  const sound::Plane inclined{Eigen::Vector3d(0, 0.6, 0.8), -3.0};
  test::expect_parts(
      test::refusal_of([&] { measurement_surface(MicrophoneSet::kIso3744, part, inclined); }),
      {"\"iso_3744\" needs [ground] with a normal along an axis"});
}

}  // namespace
}  // namespace clatter::recover
