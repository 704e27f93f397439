// SPDX-License-Identifier: GPL-3.0-or-later
// An engine that turns backward is the mirror image of one that turns forward.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/dynamics/mirrored.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kOffset = 0.8e-3;  // of the pin [m]

/// An engine and its image, with the pin on the other side: scenes and what their samples differ
/// by.
class MirrorImage : public testing::SlapScenes {
 protected:
  /// Runs both engines with `changes` and, where a shape has sides, their own `of_forward` and
  /// `of_backward`.
  void run(const std::string& changes, const std::string& of_forward = "",
           const std::string& of_backward = "") {
    const rom::ReducedModel piston = testing::elastic_piston(0.0535, 3, 4, -kOffset);
    const rom::ReducedModel block = testing::elastic_block(0.0535, 8, 6, {2e-3, -1e-3});
    forward_ = one(piston, block, "forward", 1e3 * kOffset, changes + of_forward);
    backward_ = one(mirrored(piston, of_piston_), mirrored(block, of_block_), "backward",
                    -1e3 * kOffset, changes + of_backward);
  }

  /// Largest difference of "q", "v" or "a" of all coordinates of a body from the image of the other
  /// run, relative to the largest of them, in the first `rows` samples.
  double difference(const std::string& body, const std::string& what, Eigen::Index rows = 721) {
    const RowMatrix a = forward_->read_rows("bodies/" + body + "/" + what);
    const RowMatrix b = backward_->read_rows("bodies/" + body + "/" + what);
    EXPECT_EQ(a.rows(), b.rows());
    const testing::Mirror& mirror = body == "piston" ? of_piston_ : of_block_;
    rows = std::min(rows, a.rows());
    double worst = 0.0;
    for (Eigen::Index k = 0; k < a.cols(); ++k) {
      const auto at = static_cast<size_t>(k);
      const Eigen::VectorXd image = mirror.sign[at] * b.col(mirror.place[at]).head(rows);
      worst = std::max(worst, (a.col(k).head(rows) - image).cwiseAbs().maxCoeff());
    }
    return worst / a.cwiseAbs().maxCoeff();
  }

  std::optional<H5File> forward_, backward_;

 private:
  H5File one(const rom::ReducedModel& piston, const rom::ReducedModel& block,
             const std::string& rotation, double pin_offset_mm, const std::string& changes) {
    testing::write_rom(folder_ / "piston.rom.h5", piston);
    testing::write_rom(folder_ / "block.rom.h5", block);
    return recorded(scene(fmt::format("[engine]\npin_offset_mm = {}\nrotation = \"{}\"\n"
                                      "[time]\ncycles = 1\n{}",
                                      pin_offset_mm, rotation, changes)),
                    rotation);
  }

  testing::Mirror of_piston_, of_block_;
};

TEST_F(MirrorImage, OfADryPiston) {
  run("[contact]\nlubrication = \"none\"\n");
  for (const char* what : {"q", "v", "a"}) EXPECT_LT(difference("piston", what), 1e-10) << what;
  const RowMatrix q = forward_->read_rows("bodies/piston/q");
  EXPECT_GT(q.col(1).maxCoeff() - q.col(1).minCoeff(), 2e-5);  // it crosses the clearance
}

TEST_F(MirrorImage, OfAPistonInAFullFilm) {
  run("[contact]\ncavitation = false\nflow_factors = true\n");
  for (const char* what : {"q", "v", "a"}) EXPECT_LT(difference("piston", what), 1e-10) << what;
}

TEST_F(MirrorImage, OfAPistonInAFilmThatCavitates) {
  // Cells that fill multiply differences of rounding: a thousandfold in 20 samples.
  run("");
  for (const char* what : {"q", "v", "a"}) {
    EXPECT_LT(difference("piston", what, 41), 1e-10) << what;
    EXPECT_LT(difference("piston", what, 121), 1e-6) << what;
  }
}

TEST_F(MirrorImage, OfElasticPartsOnMounts) {
  run(std::string("[contact]\ncavitation = false\n[accuracy]\ntolerance = 1e-3\n[piston]\nmodel = "
                  "\"elastic\"\nmode_limit_hz = 8000.0\n") +
      testing::kElasticBlock);
  for (const char* body : {"piston", "block"}) {
    EXPECT_LT(difference(body, "q"), 1e-10) << body;
    EXPECT_LT(difference(body, "v"), 1e-9) << body;
    EXPECT_LT(difference(body, "a"), 1e-7) << body;
  }
}

TEST_F(MirrorImage, OfRingsAndFrictionOfThePins) {
  run(std::string("[contact]\ncavitation = false\n[accuracy]\ntolerance = 1e-3\n"
                  "[[contact.ring]]\nheight_mm = 45\nface_radius_mm = 20\nload_n_mm = 0.5\n"
                  "width_mm = 2.5\nthickness_mm = 4\ngas_share = 1\nfriction_coefficient = 0.1\n"
                  "groove_coefficient = 0.05\n[small_end]\nfriction_coefficient = 0.05\n"
                  "diameter_mm = 40\n[big_end]\nfriction_coefficient = 0.02\ndiameter_mm = 70\n") +
      testing::kElasticBlock);
  for (const char* what : {"q", "v", "a"}) EXPECT_LT(difference("piston", what), 1e-8) << what;
}

TEST_F(MirrorImage, OfOilFilmsInTheJointsOfTheRod) {
  run(std::string("[contact]\ncavitation = false\n[accuracy]\ntolerance = 1e-3\n"
                  "[small_end]\nmodel = \"moes\"\ndiameter_mm = 40\nwidth_mm = 30\n"
                  "clearance_um = 20\nviscosity_mpa_s = 10\n[big_end]\nmodel = \"butenschoen\"\n"
                  "diameter_mm = 70\nwidth_mm = 30\nclearance_um = 35\nviscosity_mpa_s = 10\n") +
      testing::kElasticBlock);
  for (const char* what : {"q", "v", "a"}) EXPECT_LT(difference("piston", what), 1e-8) << what;
}

TEST_F(MirrorImage, OfWarmShapesThatTheGasScales) {
  // The image of an order n with its maximum at p is that order with its maximum at 180 deg - p.
  const auto shapes = [](double bore_deg, double skirt_deg) {
    return fmt::format(
        "[[contact.bore_shape]]\norder = 3\nheight_mm = [100, 330]\namplitude_um = [3, 6]\n"
        "phase_deg = {}\nscale_table = \"scale.csv\"\n[[contact.skirt_shape]]\norder = 2\n"
        "height_mm = [-50, 50]\namplitude_um = [2, 5]\nphase_deg = {}\n",
        bore_deg, skirt_deg);
  };
  std::ofstream(folder_ / "scale.csv")
      << "crank_angle [deg], scale [1]\n-360, 1\n-180, 0.9\n0, 1.4\n180, 1.2\n360, 1\n";
  run("[contact]\ncavitation = false\n", shapes(25.0, 70.0), shapes(155.0, 110.0));
  for (const char* what : {"q", "v", "a"}) EXPECT_LT(difference("piston", what), 1e-10) << what;
}

TEST_F(MirrorImage, OfACrankWhoseSpeedFluctuates) {
  const std::string uneven = "[[engine.order]]\norder = 2\namplitude_rpm = 60\nphase_deg = 40\n";
  run("[contact]\ncavitation = false\n" + uneven);
  for (const char* what : {"q", "v", "a"}) EXPECT_LT(difference("piston", what), 1e-10) << what;
  const auto angle = forward_->read_doubles("output/crank_angle_deg");
  EXPECT_NEAR(angle.back() - angle.front(), 720.0, 1e-9);
  double furthest = 0.0;  // from a uniform turn: 60 / 2000 / 2 rad
  for (size_t i = 0; i < angle.size(); ++i) {
    const double uniform =
        angle.front() + 720.0 * static_cast<double>(i) / static_cast<double>(angle.size() - 1);
    furthest = std::max(furthest, std::abs(angle[i] - uniform));
  }
  EXPECT_GT(furthest, 0.8);
  EXPECT_LT(furthest, 2.0 * 0.86);
}

TEST_F(MirrorImage, IsRefusedForOrdersThatDoNotRepeat) {
  const std::string order = "[[engine.order]]\namplitude_rpm = ";
  test::expect_parts(refusal(order + "60\norder = 0.7\n"),
                     {"order: found 0.7, expected a multiple of 0.5"});
  test::expect_parts(refusal(order + "2500\norder = 2\n"),
                     {"engine.order: found amplitudes of 2000 rpm and more"});
}

TEST_F(MirrorImage, IsRefusedForADirectionThatIsNone) {
  test::expect_parts(refusal("[engine]\nrotation = \"left\"\n"),
                     {"changed.run.toml:3: engine.rotation: found \"left\"",
                      "expected one of: forward, backward"});
}

}  // namespace
}  // namespace clatter::dynamics
