// SPDX-License-Identifier: GPL-3.0-or-later
// From run to field file and back: the values read equal those written.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <iterator>
#include <numbers>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "recover/recover.hpp"
#include "synthetic.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;
using Complex = std::complex<double>;
constexpr Complex kI{0.0, 1.0};

/// q = (cos w t, sin w t) at engine order `order`, t from angle 0.
MotionLaw turning(const RunPlan& plan, double order) {
  const double w = 2 * std::numbers::pi * order * plan.speed_rpm / 60.0;
  return [w](double t) {
    const Eigen::Vector2d c(std::cos(w * t), std::sin(w * t)), s(-std::sin(w * t), std::cos(w * t));
    return Motion{c, w * s, -w * w * c};
  };
}

std::filesystem::path recover_file(const std::filesystem::path& run, const std::string& config) {
  const Config parsed = Config::parse(config, "test");
  const Options options = field_keys().read(parsed);
  const RunBody body(run, options.body);
  const rom::ReducedModel model = body.read_model();
  const auto path = run.parent_path() / "out.field.h5";
  StepClock clock;
  H5File file = H5File::create(path);
  const Summary summary = recover(body, model, options, file, clock);
  write_provenance(file, {kFieldSchema, parsed.resolved(), {run}});
  file.commit();
  write_exports(path, summary);
  EXPECT_FALSE(summary_text(summary).empty());
  return path;
}

/// A run of order 12 on random rows of T, in a fresh folder.
std::filesystem::path random_run(const std::string& name, const Mesh6& mesh) {
  const RunPlan plan;
  return write_run(fresh_folder(name), model_on(mesh, random_rows(mesh, 2, 5), 5000.0), plan,
                   turning(plan, 12.0));
}

/// A monopole p = A exp(-i k r)/r inside an ellipsoid; velocities by -grad p / (i w rho).
struct Source {
  Eigen::Vector3d centre{0.05, -0.03, 0.04};
  Complex A{0.4, 0.3};
  double w = 0, rho = 1.204, c = 343.2;
  Complex pressure(const Eigen::Vector3d& x) const {
    const double r = (x - centre).norm();
    return A * std::exp(-kI * (w / c) * r) / r;
  }
  Eigen::Vector3cd velocity(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d d = x - centre;
    const double r = d.norm();
    const Complex slope = pressure(x) * (-kI * (w / c) - 1.0 / r);
    return (-slope / (kI * w * rho) / r) * d.cast<Complex>();
  }
};

TEST(FieldFile, MonopoleInsideTheSkinKeepsItsPowerThroughRunSpectraAndFile) {
  // The end-to-end check of normals, areas, phases and files: the run moves the skin like a
  // monopole inside it; the power from the file's own normal velocities must be 2 pi |A|^2 / (rho
  // c).
  const RunPlan plan{.first_angle_deg = -150.0};  // firing TDC is not at a special sample
  const double order = 12.0;
  Source source;
  source.w = 2 * std::numbers::pi * order * plan.speed_rpm / 60.0;
  double error[2];
  for (int level : {2, 3}) {
    Mesh6 mesh = unit_sphere(level);
    mesh.nodes.array().rowwise() *= Eigen::Array3d(0.4, 0.25, 0.3).transpose();
    RowMatrix T(mesh.nodes.size(), 2);  // u(t) = Re(V/(i w) e^{i w t}) = Re U cos - Im U sin
    for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) {
      const Eigen::Vector3cd u =
          source.velocity(Eigen::Vector3d(mesh.nodes.row(a))) / (kI * source.w);
      T.block(3 * a, 0, 3, 1) = u.real();
      T.block(3 * a, 1, 3, 1) = -u.imag();
    }
    const auto folder = fresh_folder("monopole");
    const auto path =
        recover_file(write_run(folder, model_on(mesh, T, 3000.0), plan, turning(plan, order)),
                     "[lines]\norders = [12]\n");
    const H5File file = open_artefact(path, kFieldSchema);
    const Eigen::VectorXd re = file.read_vector("lines/normal_velocity_re/00000");
    const Eigen::VectorXd im = file.read_vector("lines/normal_velocity_im/00000");
    const Eigen::VectorXd area = file.read_vector("skin/face_area");
    const RowMatrix centre = file.read_rows("skin/face_centre");
    double power = 0.0;
    for (Eigen::Index f = 0; f < area.size(); ++f)
      power += 0.5 * area[f] *
               std::real(source.pressure(Eigen::Vector3d(centre.row(f))) *
                         std::conj(Complex(re[f], im[f])));
    error[level - 2] = std::abs(
        power / (2 * std::numbers::pi * std::norm(source.A) / (source.rho * source.c)) - 1.0);
    EXPECT_NEAR(file.read_doubles("lines/frequency_hz")[0], 400.0, 1e-9);
    std::filesystem::remove_all(folder);
  }
  // Pressure is taken at face centres only: second order, a factor near 4 from level to level.
  EXPECT_LT(error[1], 1e-3);  // 1280 faces
  EXPECT_GT(error[0] / error[1], 3.0);
}

TEST(FieldFile, OneToneComesBackInEveryDatasetWithItsAmplitudePhaseAndLevel) {
  const RunPlan plan;
  const Mesh6 mesh = box({0.3, 0.2, 0.1}, 2);
  RowMatrix T = RowMatrix::Zero(mesh.nodes.size(), 2);
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) T(3 * a + 1, 0) = 1e-6;  // rigid, along y
  const auto folder = fresh_folder("tone");
  const double order = 24.0, hz = 800.0, w = 2 * std::numbers::pi * hz;
  const auto path = recover_file(
      write_run(folder, model_on(mesh, T, 5000.0), plan, turning(plan, order)),
      "[lines]\nfrequencies_hz = [803]\n[[sensor]]\nset = \"sensor_block\"\n"
      "[[sensor]]\nname = \"top\"\nposition = [0.1, 0.2, 0.05]\ndirection = [0, 3, 0]\n");
  const H5File file = open_artefact(path, kFieldSchema);
  const Eigen::VectorXd f = file.read_vector("analysis/cycle/frequency_hz");
  EXPECT_NEAR(f[48], hz, 1e-9);
  EXPECT_NEAR(file.read_vector("analysis/cycle/order")[48], order, 1e-12);

  // v = Re(i w U e^{i w t}), U = 1e-6 m: purely imaginary, peak amplitude w U.
  const double v = w * 1e-6;
  const RowMatrix re = file.read_rows("lines/velocity_re/00000"),
                  im = file.read_rows("lines/velocity_im/00000");
  EXPECT_LT(re.cwiseAbs().maxCoeff(), 1e-12 * v);
  EXPECT_LT((im.col(1).array() - v).abs().maxCoeff(), 1e-12 * v);
  EXPECT_EQ(file.read_doubles("lines/requested_hz")[0], 803.0);

  // Two faces of 0.3 x 0.1 m2 carry it; ERP = 1/2 rho c S v^2.
  const double erp = 0.5 * 1.204 * 343.2 * 0.06 * v * v;
  EXPECT_NEAR(file.read_vector("analysis/cycle/panels/skin/erp")[48] / erp, 1.0, 1e-11);
  EXPECT_NEAR(file.get_double("analysis/cycle/panels/skin", "erp_w") / erp, 1.0, 1e-10);
  EXPECT_NEAR(file.get_double("analysis/cycle/panels/thrust_side", "share_of_skin"), 0.5, 1e-10);
  EXPECT_NEAR(file.read_vector("analysis/cycle/panels/thrust_side/mean_square_velocity")[48],
              0.5 * v * v, 1e-11 * v * v);

  // The 800 Hz third octave contains all of it; the sensor at coordinate 0 has |a| = w^2.
  const std::vector<std::string> names = file.read_strings("analysis/cycle/third_octave/nominal");
  const auto band = std::find(names.begin(), names.end(), "800") - names.begin();
  const auto skin_db = file.read_vector("analysis/cycle/panels/skin/third_octave/erp_db");
  EXPECT_NEAR(skin_db[band], 10 * std::log10(erp / 1e-12), 1e-9);
  const Eigen::MatrixXd a_db =
      file.read_matrix("analysis/cycle/sensors/sensor_block/third_octave/acceleration_db");
  EXPECT_NEAR(a_db(band, 0), 20 * std::log10(w * w / std::sqrt(2.0) / 1e-6), 1e-9);
  const Eigen::MatrixXd a_re =
      file.read_matrix("analysis/cycle/sensors/sensor_block/spectrum/acceleration_re");
  EXPECT_NEAR(a_re(48, 0) / (-w * w), 1.0, 1e-11);
  const Eigen::MatrixXd top =
      file.read_matrix("analysis/cycle/sensors/top/spectrum/displacement_re");
  EXPECT_NEAR(top(48, 0) / 1e-6, 1.0, 1e-11);

  // A frame in single precision: v(t) = -w U sin(w t).
  const std::vector<double> time = file.read_doubles("frames/time");
  const RowMatrix frame = file.read_rows("frames/velocity/00007");
  EXPECT_NEAR(frame(0, 1), -v * std::sin(w * time[7]), 1e-6 * v);
  EXPECT_NEAR(file.read_doubles("frames/crank_angle_deg")[0], -10.0, 1e-9);
  EXPECT_EQ(time.size(), file.list("frames/velocity").size());
  EXPECT_EQ(file.get_string("analysis/cycle/panels/skin/erp", "unit"), "W");
  EXPECT_NE(file.get_string("/", "phase").find("exp(+i 2 pi f t)"), std::string::npos);
  const auto proved = read_certificate<FieldCertificate>(file);
  EXPECT_NEAR(proved.cycle_to_cycle_velocity_difference.value(), 0.0, 1e-9);
  EXPECT_NEAR(proved.cycle_end_velocity_jump.value(), 0.0, 1e-9);
  EXPECT_EQ(proved.run_complete, 1.0);
  EXPECT_NEAR(proved.mean_square_share_above_spectra.value(), 0.0, 1e-9);
  std::filesystem::remove_all(folder);
}

TEST(FieldFile, ChosenQuantitiesAreWrittenAndBelongTogether) {
  const RunPlan plan;
  const Mesh6 mesh = box({0.3, 0.2, 0.1}, 2);
  const RowMatrix T = random_rows(mesh, 2, 5);
  const auto folder = fresh_folder("quantities");
  const double hz = 400.0, w = 2 * std::numbers::pi * hz;
  const auto run = write_run(folder, model_on(mesh, T, 5000.0), plan, turning(plan, 12.0));
  const std::string all =
      "quantities = [\"displacement\", \"velocity\", \"acceleration\", \"normal_velocity\"]\n";
  const auto path = recover_file(
      run, "[lines]\nfrequencies_hz = [400]\n" + all + "[frames]\nstep_deg = 10\n" + all);
  const H5File file = open_artefact(path, kFieldSchema);
  // Frames: a = -w^2 u for each of a rotating pair of coordinates; v from T and the run.
  for (const std::string& frame : file.list("frames/acceleration")) {
    const RowMatrix u = file.read_rows("frames/displacement/" + frame);
    const RowMatrix a = file.read_rows("frames/acceleration/" + frame);
    EXPECT_LT((a + w * w * u).cwiseAbs().maxCoeff(), 1e-6 * w * w) << frame;
  }
  ASSERT_EQ(file.list("frames/acceleration").size(), 8u);
  EXPECT_EQ(file.get_string("frames/acceleration", "unit"), "m/s2");
  // Lines: a = i w v, u = v / (i w), normal velocities by the operator of the faces.
  const auto line = [&](const std::string& quantity) {
    Eigen::MatrixXcd value(mesh.nodes.rows(), 3);
    value.real() = file.read_rows("lines/" + quantity + "_re/00000");
    value.imag() = file.read_rows("lines/" + quantity + "_im/00000");
    return value;
  };
  const Eigen::MatrixXcd v = line("velocity");
  EXPECT_LT((line("acceleration") - kI * w * v).norm(), 1e-12 * w * v.norm());
  EXPECT_LT((line("displacement") - v / (kI * w)).norm(), 1e-12 * v.norm() / w);
  const std::string xdmf = [](const std::filesystem::path& at) {
    std::ifstream stream(at);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  }(frame_export_path(path));
  EXPECT_NE(xdmf.find("Attribute Name=\"acceleration\" AttributeType=\"Vector\""),
            std::string::npos);
  EXPECT_NE(xdmf.find("out.field.h5:/frames/acceleration/00007"), std::string::npos);

  const auto only = recover_file(run,
                                 "[lines]\nstrongest = 1\nquantities = [\"acceleration\"]\n"
                                 "[frames]\nquantities = [\"normal_velocity\"]\n");
  const H5File few = open_artefact(only, kFieldSchema);
  EXPECT_EQ(few.list("frames"),
            (std::vector<std::string>{"crank_angle_deg", "normal_velocity", "time"}));
  EXPECT_FALSE(few.has("lines/velocity_re"));
  EXPECT_FALSE(few.has("lines/normal_velocity_re"));
  EXPECT_EQ(few.list("lines/acceleration_im").size(), 1u);
  std::filesystem::remove_all(folder);
}

TEST(FieldFile, PanelsOfSurfacesAndWindowsOverTheAngleReachTheFile) {
  const RunPlan plan{.cycles = 5};
  const Mesh6 mesh = box({0.3, 0.2, 0.1}, 1);
  const auto folder = fresh_folder("surfaces");
  rom::ReducedModel model = model_on(mesh, random_rows(mesh, 2, 5), 5000.0);
  model.skin.faces = {{"deck", {10, 11}}, {"skin", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}};
  const auto path = recover_file(write_run(folder, model, plan, turning(plan, 12.0)),
                                 "[[panel]]\nname = \"top\"\nsurfaces = [\"deck\"]\n"
                                 "[[window]]\nname = \"orders\"\ndomain = \"angle\"\ncycles = 3\n"
                                 "taper = \"hann\"\nsegment_deg = 720\noverlap = 0.5\n");
  const H5File file = open_artefact(path, kFieldSchema);
  EXPECT_EQ(file.read_ints("panels/top/faces"), (std::vector<int32_t>{10, 11}));
  EXPECT_NEAR(file.get_double("panels/top", "area_m2"), 0.06, 1e-14);
  EXPECT_EQ(file.get_string("analysis/orders", "domain"), "angle");
  EXPECT_EQ(file.get_int("analysis/orders", "averages"), 5);
  // Welch's formula for half overlap of Hann segments: 5 / (1 + 2 (4/5) / 36).
  EXPECT_NEAR(file.get_double("analysis/orders", "equivalent_averages"), 5 / (1 + 1.6 / 36), 1e-3);
  EXPECT_EQ(file.get_string("analysis/cycle", "domain"), "time");
  EXPECT_EQ(file.get_int("analysis/cycle", "averages"), 1);
  // Order 12: the power of the averaged window in its three lines is that of the cycle's one line.
  const Eigen::VectorXd orders = file.read_vector("analysis/orders/order");
  EXPECT_NEAR(orders[24], 12.0, 1e-9);
  for (const std::string panel : {"skin", "top"}) {
    const Eigen::VectorXd erp = file.read_vector("analysis/orders/panels/" + panel + "/erp");
    const Eigen::VectorXd cycle = file.read_vector("analysis/cycle/panels/" + panel + "/erp");
    EXPECT_NEAR(erp.segment(23, 3).sum() / cycle[24], 1.0, 1e-5) << panel;
  }
  const std::string powers = "analysis/orders/sensors/sensor_block/spectrum";
  EXPECT_EQ(file.list(powers), (std::vector<std::string>{"acceleration_power", "displacement_power",
                                                         "velocity_power"}));
  EXPECT_NEAR(file.read_matrix(powers + "/displacement_power").col(0).segment(23, 3).sum(), 0.5,
              1e-5);
  std::filesystem::remove_all(folder);
}

TEST(FieldFile, LinesNeedAnAnalysisWithPhases) {
  const auto run = random_run("phases", box({1, 1, 1}, 1));
  const std::string averaged =
      "cycle = false\n[[window]]\nname = \"w\"\ncycles = 2\nsegment_deg = 360\n";
  test::expect_parts(
      test::refusal_of([&] { recover_file(run, averaged + "[lines]\norders = [12]\n"); }),
      {"lines need a cycle or a window in one segment"});
  const H5File file = open_artefact(recover_file(run, averaged), kFieldSchema);
  EXPECT_FALSE(file.has("lines"));
  EXPECT_GT(file.get_int("analysis/w", "averages"), 1);
  std::filesystem::remove_all(run.parent_path());
}

TEST(FieldFile, SlimFilesHaveLevelsInSinglePrecisionAndNothingElse) {
  const auto run = random_run("slim", box({0.3, 0.2, 0.1}, 4));
  const std::string less = "window = []\n[frames]\non = false\n[lines]\nstrongest = 0\n";
  const auto path = recover_file(run, less);
  const auto full_size = static_cast<double>(std::filesystem::file_size(path));
  const Eigen::VectorXd full =
      open_artefact(path, kFieldSchema).read_vector("analysis/cycle/panels/skin/erp");
  const H5File file = open_artefact(
      recover_file(run, less + "[output]\nskin = false\nsamples = false\nspectra = false\n"
                               "precision = \"single\"\n"),
      kFieldSchema);
  EXPECT_LT(static_cast<double>(std::filesystem::file_size(path)), 0.35 * full_size);
  for (const char* absent :
       {"skin", "frames", "panels/skin/faces", "analysis/cycle/sensors/sensor_block/velocity",
        "analysis/cycle/sensors/sensor_block/spectrum",
        "analysis/cycle/panels/skin/instant_mean_square_velocity", "analysis/ftdc"})
    EXPECT_FALSE(file.has(absent)) << absent;
  const Eigen::VectorXd erp = file.read_vector("analysis/cycle/panels/skin/erp");
  EXPECT_EQ(erp, full.cast<float>().cast<double>());
  EXPECT_NE(erp, full);
  // Axes keep their precision, attributes the totals.
  const double step = RunPlan{}.cycle_s() / RunPlan{}.samples;
  EXPECT_NEAR(file.read_vector("analysis/cycle/time")[77], 77 * step, 1e-15);
  EXPECT_NEAR(file.get_double("analysis/cycle/panels/skin", "erp_w"), full.sum(),
              1e-12 * full.sum());
  std::filesystem::remove_all(run.parent_path());
}

TEST(FieldFile, StrongestPeaksAreTakenWhenNoFrequencyIsAskedFor) {
  const RunPlan plan;
  const Mesh6 mesh = box({1, 1, 1}, 1);
  RowMatrix T = random_rows(mesh, 2, 5);
  const auto two_tones = [&](double t) {
    Motion m = turning(plan, 12.0)(t);
    const Motion high = turning(plan, 30.0)(t);
    m.q[1] = 0.3 * high.q[0], m.v[1] = 0.3 * high.v[0], m.a[1] = 0.3 * high.a[0];
    return m;
  };
  const auto folder = fresh_folder("peaks");
  const auto path = recover_file(write_run(folder, model_on(mesh, T, 2000.0), plan, two_tones),
                                 "[lines]\nstrongest = 2\n[frames]\non = false\n");
  const H5File file = open_artefact(path, kFieldSchema);
  const std::vector<double> hz = file.read_doubles("lines/frequency_hz");
  ASSERT_EQ(hz.size(), 2u);
  EXPECT_NEAR(hz[0], 400.0, 1e-9);
  EXPECT_NEAR(hz[1], 1000.0, 1e-9);
  EXPECT_FALSE(file.has("frames"));
  EXPECT_FALSE(std::filesystem::exists(frame_export_path(path)));
  std::filesystem::remove_all(folder);
}

TEST(FieldFile, EveryLineOfABandIsTakenBesidesTheFrequenciesAskedFor) {
  const RunPlan plan;  // lines are half an order apart, 50/3 Hz
  const auto folder = fresh_folder("band");
  const auto run =
      write_run(folder, model_on(box({1, 1, 1}, 1), random_rows(box({1, 1, 1}, 1), 2, 5), 2000.0),
                plan, turning(plan, 12.0));
  const auto path = recover_file(
      run,
      "[lines]\nfrequencies_hz = [1003, 400]\nfrom_hz = 400\nto_hz = 440\n[frames]\non = false\n");
  const std::vector<double> hz =
      open_artefact(path, kFieldSchema).read_doubles("lines/frequency_hz");
  ASSERT_EQ(hz.size(), 4u);
  const std::vector<double> expected{400.0, 400.0 + 50.0 / 3.0, 400.0 + 100.0 / 3.0, 1000.0};
  for (size_t i = 0; i < hz.size(); ++i) EXPECT_NEAR(hz[i], expected[i], 1e-9);
  const auto refusal = [&](const std::string& lines) {
    return test::refusal_of([&] { recover_file(run, "[lines]\n" + lines); });
  };
  test::expect_parts(refusal("from_hz = 405\nto_hz = 410\n"),
                     {"no line of the spectrum lies from 405 to 410 Hz", "16.6667 Hz apart"});
  test::expect_parts(refusal("from_hz = 405\nto_hz = 2500\n"), {"2500 Hz, expected at most"});
  test::expect_parts(refusal("from_hz = 405\n"), {"to_hz"});
  std::filesystem::remove_all(folder);
}

TEST(FieldFile, CertificateShowsAMotionThatDoesNotRepeatAndWhatLiesAboveTheSpectra) {
  const RunPlan plan;
  const Mesh6 mesh = box({1, 1, 1}, 1);
  RowMatrix T = RowMatrix::Zero(mesh.nodes.size(), 2);
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) T(3 * a, 0) = T(3 * a + 1, 1) = 1.0;
  const auto folder = fresh_folder("jump");
  const auto run = write_run(folder, model_on(mesh, T, 0.0), plan, turning(plan, 12.125));
  const H5File file = open_artefact(recover_file(run, "[spectrum]\nto_hz = 1000\n"), kFieldSchema);
  // v has constant magnitude w and rotates by a quarter over a cycle (0.25 of 2 pi): |jump| =
  // sqrt(2) w.
  const auto proved = read_certificate<FieldCertificate>(file);
  EXPECT_NEAR(proved.cycle_end_velocity_jump.value(), std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(proved.cycle_to_cycle_velocity_difference.value(), std::sqrt(2.0), 1e-9);
  const double leaked = proved.mean_square_share_above_spectra.value();
  EXPECT_GT(leaked, 1e-5);
  EXPECT_LT(leaked, 0.02);
  std::filesystem::remove_all(folder);
}

TEST(FieldFile, RunThatDoesNotTurnIsAnalysedAsAWhole) {
  const RunPlan plan;
  const Mesh6 mesh = box({1, 1, 1}, 1);
  const auto folder = fresh_folder("still");
  const auto run =
      write_run(folder, model_on(mesh, random_rows(mesh, 2, 5), 2000.0), plan, turning(plan, 12.0));
  H5File still = H5File::create(folder / "still.h5");  // the same without a crank
  const H5File turns = H5File::open(run);
  write_provenance(still, {"clatter/run/1", "", {}});
  still.write("output/time", turns.read_vector("output/time"));
  for (const char* member : {"bodies/block/q", "bodies/block/v", "bodies/block/a"})
    still.write(member, turns.read_rows(member));
  for (const char* name : {"rom", "rom_sha256"})
    still.set("bodies/block", name, turns.get_string("bodies/block", name));
  still.commit();
  const H5File file = open_artefact(recover_file(folder / "still.h5", ""), kFieldSchema);
  EXPECT_EQ(file.list("analysis"), std::vector<std::string>{"whole"});
  EXPECT_FALSE(file.has("analysis/whole/order"));
  EXPECT_GE(file.list("frames/velocity").size(), 50u);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace clatter::recover
