// SPDX-License-Identifier: GPL-3.0-or-later
// Sound files: interpolation, spheres with known sound, runs, refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "recover/sound/wav.hpp"
#include "sound_run.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;

TEST(Wav, RepeatedCycleIsTheSumOfItsLines) {
  Eigen::VectorXcd lines = Eigen::VectorXcd::Zero(4);
  lines[0] = 7.0;  // a mean pressure is not heard
  lines[1] = 0.3;
  lines[3] = sound::Complex(0.0, -0.1);
  const Eigen::VectorXd p = repeated_cycle(lines, 480.0, 0.01);
  ASSERT_EQ(p.size(), 480);
  for (Eigen::Index n = 0; n < p.size(); ++n) {
    const double turn = 2 * kPi * static_cast<double>(n) / 100.0;
    EXPECT_NEAR(p[n], 0.3 * std::cos(turn) + 0.1 * std::sin(3 * turn), 1e-13);
  }
}

TEST(Wav, BytesAreThoseOfRiff) {
  const std::string bytes = wav_bytes(Eigen::Vector3d(0.5, -0.5, 0.0), 0.5);
  ASSERT_EQ(bytes.size(), 44u + 6u);
  EXPECT_EQ(bytes.substr(0, 8), std::string("RIFF\x2a\0\0\0", 8));
  EXPECT_EQ(bytes.substr(8, 8), "WAVEfmt ");
  EXPECT_EQ(bytes.substr(24, 4), std::string("\x80\xbb\0\0", 4));  // 48000
  EXPECT_EQ(bytes.substr(40), std::string("\x06\0\0\0\xff\x7f\x01\x80\0\0", 10));
  test::expect_parts(test::refusal_of([] { wav_bytes(Eigen::Vector3d(1, 0, 0), 0.5); }),
                     {"found a full scale of 0.5 Pa, expected at least the peak of 1 Pa"});
}

TEST(SoundTable, StencilReproducesPolynomials) {
  const std::vector<double> grid = {20, 50, 90, 200, 260, 400};
  const auto quintic = [](double f) { return 3.0 - f + 0.02 * f * f - std::pow(f / 100.0, 5); };
  for (double f : {95.0, 170.0, 200.0}) {
    const Stencil by = stencil(grid, f);
    double value = 0.0;
    for (Eigen::Index i = 0; i < by.weight.size(); ++i)
      value += by.weight[i] * quintic(grid[by.first + static_cast<size_t>(i)]);
    EXPECT_NEAR(value, quintic(f), 1e-9 * std::abs(quintic(f))) << f;
  }
  EXPECT_EQ(stencil(grid, 10.0).weight.size(), 1);
  EXPECT_EQ(stencil(grid, 30.0).weight.size(), 4);
}

/// Pulsating sphere with a microphone: exact R, H of one coordinate, its radial displacement.
SoundSample pulsating(const sound::Fluid& air, double f, double distance) {
  const double k = air.wavenumber(f), ka = k * kRadius, S = 4 * kPi * kRadius * kRadius;
  const sound::Complex z = air.impedance() * sound::Complex(0, ka) / sound::Complex(1, ka);
  return {f, Eigen::MatrixXd::Constant(1, 1, S * z.real()),
          Eigen::MatrixXcd::Constant(
              1, 1, z * kRadius / distance * std::polar(1.0, -k * (distance - kRadius)))};
}

TEST(SoundTable, InterpolatesAPulsatingSphere) {
  SoundTable table{.fluid = {1.204, 343.2},
                   .microphones = {{"m", {3, 0, 0}}},
                   .distance = Eigen::VectorXd::Constant(1, 3.0)};
  for (double f = 100; f <= 1000; f += 150) table.samples.push_back(pulsating(table.fluid, f, 3.0));
  for (double f : {330.0, 470.0, 900.0}) {
    const SampleErrors errors = interpolation_errors(table, pulsating(table.fluid, f, 3.0));
    EXPECT_LT(errors.resistance, 0.05) << f;
    EXPECT_LT(errors.microphone, 0.05) << f;
    EXPECT_GT(errors.resistance, 0.0);
  }
  test::expect_parts(test::refusal_of([&] { resistance_at(table, 1100.0); }),
                     {"sound: found a frequency of 1100 Hz, expected at most 1000"});
}

TEST(PartSound, SphereHasItsEfficiencyAndPressure) {
  const PartSound& part = sphere_sound();
  const SoundTable& table = part.table;
  for (size_t i = 0; i < table.samples.size(); ++i) {
    const SoundSample& sample = table.samples[i];
    const double ka = table.fluid.wavenumber(sample.frequency_hz) * kRadius, q = ka * ka;
    // The wrap is 0.8 mm outside of a sphere of 320 faces, and has 300 faces itself.
    EXPECT_NEAR(part.efficiency(static_cast<Eigen::Index>(i), 0) / (q / (1 + q)), 1.0, 0.03);
    EXPECT_NEAR(part.efficiency(static_cast<Eigen::Index>(i), 1) / (q * q / (4 + q * q)), 1.0,
                0.04);
    const SoundSample exact = pulsating(table.fluid, sample.frequency_hz, 0.6);
    EXPECT_NEAR(std::abs(sample.H(kBeside, 0) / exact.H(0, 0) - 1.0), 0.0, 0.03);
    EXPECT_LT(std::abs(sample.H(kBeside, 1)), 0.01 * std::abs(sample.H(kAbove, 1)))
        << "beside a dipole";
    EXPECT_NEAR(sample.R(0, 1), 0.0, 0.01 * sample.R(1, 1));
  }
  EXPECT_EQ(table.from_hz(), 300.0);
  EXPECT_EQ(table.to_hz(), 700.0);
}

TEST(PartSound, CertificateHoldsWhatWasMeasured) {
  const SoundCertificate& certificate = sphere_sound().certificate;
  EXPECT_LT(certificate.monopole_error_db.value(), 0.05);
  EXPECT_GT(certificate.monopole_error_db.value(), 0.0);
  EXPECT_LT(certificate.surface_power_error_db.value(), 0.05);
  EXPECT_LT(certificate.far_field_error_db, 0.05);
  EXPECT_GT(certificate.far_field_error_db, 0.0);
  EXPECT_EQ(certificate.open_edges, 0.0);
  EXPECT_LT(certificate.interpolation_error_db, 1.0);
  EXPECT_LT(certificate.map_flux_error, 1e-13);
  EXPECT_GE(certificate.mesh_limit_hz, 700.0);
  EXPECT_EQ(certificate.lid_area_m2, 0.0);
}

TEST(PartSound, MicrophoneInsideAndFrequencyAboveTheBasisAreRefused) {
  StepClock clock;
  SoundOptions options = sphere_options();
  options.microphones = {{"top", {0, 0, 2}}};
  test::expect_parts(test::refusal_of([&] { part_sound(sphere_model(), options, clock); }),
                     {"defaults: microphone 'top': found in the list and in engine_1m"});
  options.microphones = {{"inside", {0.05, 0, 0}}};
  test::expect_parts(test::refusal_of([&] { part_sound(sphere_model(), options, clock); }),
                     {"defaults: microphone 'inside': found (0.05, 0, 0) m inside the body"});
  options.grid.to_hz = 2500.0;
  test::expect_parts(test::refusal_of([&] { part_sound(sphere_model(), options, clock); }),
                     {"defaults: grid.to_hz: found 2500, expected at most 2000"});
  options = sphere_options();
  options.grid.tolerance_db = 1e-6;
  options.grid.most = 5;
  test::expect_parts(
      test::refusal_of<NumericsError>([&] { part_sound(sphere_model(), options, clock); }),
      {"sound: 5 frequencies do not interpolate within 1e-06 dB: raise grid.most"});
}

TEST(SoundOptions, ResolvedTextReadsBackAndBadKeysAreRefused) {
  SoundOptions options = sphere_options();
  options.skin.lids = LidMotion::kNearest;
  options.ground = sound::Plane{Eigen::Vector3d::UnitZ(), -0.5};
  const std::string text = sound_keys().toml_of(options);
  EXPECT_EQ(sound_keys().toml_of(sound_keys().read(Config::parse(text, "x.toml"))), text);
  const auto refusal = [](const char* toml) {
    return test::refusal_of([&] { sound_keys().read(Config::parse(toml, "x.toml")); });
  };
  test::expect_parts(refusal("[grid]\nto_hz = 10"), {"x.toml:2", "to_hz", "more than from_hz"});
  test::expect_parts(refusal("[skin]\nopenings = 1"), {"x.toml:2", "openings", "opening"});
  test::expect_parts(refusal("microphones = 'engine'"), {"x.toml:1", "microphones", "engine_1m"});
  test::expect_parts(refusal("[[microphone]]\nname = 'a'\nposition = [0, 0, 2]\n"
                             "[[microphone]]\nname = 'a'\nposition = [0, 0, 3]"),
                     {"x.toml:5", "found \"a\" twice"});
}

TEST_F(SoundRun, PowerAndPressureOfALineAreThoseOfTheTable) {
  const Summary summary = recovered("sound = 'part.sound.h5'\n[spectrum]\nto_hz = 1500\n");
  const RunSound& sound = summary.sounds.at(0);
  const SoundTable& table = sphere_sound().table;
  const Eigen::Vector2d v = 2 * kPi * kLine * kMotion;
  const double power = 0.5 * v.dot(resistance_at(table, kLine) * v);
  EXPECT_NEAR(sound.total / power, 1.0, 1e-9);
  EXPECT_NEAR(sound.power[30] / power, 1.0, 1e-9);
  EXPECT_EQ(sound.to_hz, 700.0);
  const Eigen::VectorXcd p = microphones_at(table, kLine) * v;
  for (int m : {kBeside, kAbove})
    EXPECT_NEAR(std::abs(sound.microphones.at(m).pressure[30]), std::abs(p[m]),
                1e-9 * std::abs(p[m]));
  EXPECT_NEAR(sound.microphones[kBeside].total_db,
              20 * std::log10(std::abs(p[kBeside]) / std::sqrt(2.0) / 2e-5), 1e-6);
  const H5File file = H5File::open(folder_ / "field.h5");
  EXPECT_NEAR(file.get_double("analysis/cycle/sound", "power_w") / power, 1.0, 1e-9);
  EXPECT_NEAR(file.get_double("analysis/cycle/sound", "power_db"), 10 * std::log10(power / 1e-12),
              1e-6);
  EXPECT_TRUE(file.has("analysis/cycle/sound/microphones/above/pressure_im"));
  // Third octaves: all the power is in the band of 500 Hz.
  const Eigen::VectorXd bands = file.read_vector("analysis/cycle/sound/third_octave/power_db");
  EXPECT_NEAR(bands.maxCoeff(), 10 * std::log10(power / 1e-12), 1e-6);
  // Below coincidence the ERP is an upper estimate.
  EXPECT_LT(sound.total, summary.analyses[0].panels[1].total_erp);
}

TEST_F(SoundRun, LinesHaveTheNormalVelocityOfTheAcousticSkin) {
  recovered("sound = 'part.sound.h5'\n[spectrum]\nto_hz = 1500\n[lines]\nfrequencies_hz = [500]\n");
  const H5File file = H5File::open(folder_ / "field.h5");
  const PartSound& part = sphere_sound();
  EXPECT_EQ(file.read_rows("acoustic/nodes"), part.skin.nodes);
  EXPECT_EQ(file.read_index_matrix("acoustic/triangles"), part.skin.triangles);
  // v = -w q sin(w t) = Re(i w q e^{iwt}), and t = 0 at firing TDC, an even number of periods away.
  const Eigen::VectorXd expected = part.face_velocity * (2 * kPi * kLine * kMotion);
  const Eigen::VectorXd re = file.read_vector("lines/acoustic_normal_velocity_re/00000");
  const Eigen::VectorXd im = file.read_vector("lines/acoustic_normal_velocity_im/00000");
  ASSERT_EQ(re.size(), part.skin.face_count());
  const Eigen::VectorXcd v = re + sound::Complex(0, 1) * im;
  const sound::Complex phase = v[0] / expected[0];
  EXPECT_NEAR(std::abs(phase), 1.0, 1e-9);
  EXPECT_LT((v - phase * expected).norm(), 1e-9 * expected.norm());
}

TEST_F(SoundRun, StrongestLineIsThatOfTheSoundPowerNotOfTheErp) {
  // The sphere oscillates at 1000/3 Hz and pulsates at 600 Hz. The A-weighted ERP of the
  // oscillation is 3.3^2 / 3 x 10^(-0.40) = 1.44 times that of the pulsation; but ka^4 / (4 + ka^4)
  // = 0.36 of it is radiated, of the other (ka)^2 / (1 + (ka)^2) = 0.83: 0.63 times.
  write_inputs([&](double t) {
    const Eigen::Array2d w{2 * kPi * 600.0, 2 * kPi * 1000.0 / 3.0}, v{1e-3, 3.3e-3};
    return Motion{v / w * (w * t).sin(), v * (w * t).cos(), -v * w * (w * t).sin()};
  });
  const std::string rule = "[spectrum]\nto_hz = 1500\n[lines]\nstrongest = 1\n";
  const std::vector<double> by_erp = recovered(rule).lines.frequency_hz;
  const std::vector<double> by_power =
      recovered("sound = 'part.sound.h5'\n" + rule).lines.frequency_hz;
  ASSERT_EQ(by_erp.size(), 1u);
  ASSERT_EQ(by_power.size(), 1u);
  EXPECT_NEAR(by_erp[0], 1000.0 / 3.0, 1e-6);
  EXPECT_NEAR(by_power[0], 600.0, 1e-6);
}

TEST_F(SoundRun, AnotherAirThanThatOfTheSoundFileIsRefused) {
  test::expect_parts(
      test::refusal_of([&] { recovered("sound = 'part.sound.h5'\n[air]\nsound_speed = 350\n"); }),
      {"field.toml: air: found 1.204 kg/m3 and 350 m/s", "and 343.2 m/s as in"});
}

TEST_F(SoundRun, FileComesBackAndThatOfAnotherModelIsRefused) {
  const SoundTable back = read_sound(folder_ / "part.sound.h5", rom_, 2);
  ASSERT_EQ(back.samples.size(), sphere_sound().table.samples.size());
  EXPECT_EQ(back.samples[1].R, sphere_sound().table.samples[1].R);
  EXPECT_EQ(back.samples[1].H, sphere_sound().table.samples[1].H);
  EXPECT_EQ((back.samples[1].far - sphere_sound().table.samples[1].far).norm(), 0.0);
  EXPECT_EQ(back.flow.face, sphere_sound().table.flow.face);
  EXPECT_EQ(back.flow.node, sphere_sound().table.flow.node);
  EXPECT_TRUE(back.flow.weight == sphere_sound().table.flow.weight);
  EXPECT_EQ(back.surface.set, MicrophoneSet::kEngine1m);
  EXPECT_EQ(back.surface.microphones.size(), 5u);
  EXPECT_EQ(back.surface.area, sphere_sound().table.surface.area);
  EXPECT_EQ(back.microphones[kAbove].name, "above");
  test::expect_parts(
      test::refusal_of([&] { read_sound(folder_ / "part.sound.h5", std::string(64, 'a'), 2); }),
      {"part.sound.h5: rom_sha256: found", "expected aaaaaaaaaaaa...", "clatter-recover sound"});
  test::expect_parts(test::refusal_of([&] { read_sound(folder_ / "part.sound.h5", rom_, 3); }),
                     {"resistance/00000: found shape (2, 2), expected (3, 3)"});
}

}  // namespace
}  // namespace clatter::recover
