// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison of models and the files of modes and reduced models.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "condense/condense.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/whole_file.hpp"
#include "core/modes/compare.hpp"
#include "modal/modes_file.hpp"
#include "tests/condense/box_model.hpp"
#include "tests/paths.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter {
namespace {

namespace fs = std::filesystem;
using test::box_model;

rom::ReducedModel reduce(const fe::FeModel& model, double fmax_hz) {
  condense::CondenseOptions options;
  options.boundary = {"left", "right", "point"};
  options.modes.fmax_hz = fmax_hz;
  set_quiet(true);
  StepClock clock;
  return condense::condense(model, options, clock);
}

class InFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch_path("modes");
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write_fe(const fe::FeModel& model) const {
    const fs::path path = folder_ / "box.fe.h5";
    H5File file = H5File::create(path);
    fe::write_fe_model(file, model);
    write_provenance(file, {fe::kFeSchema, "", {}});
    file.commit();
    return path;
  }
  fs::path write_text(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  /// Exit code of one of clatter's programs; its output goes to `log`.
  int call(const std::string& arguments) const {
    const std::string log = (folder_ / "log").string();
    const std::string command =
        std::string(CLATTER_BIN_DIR) + "/" + arguments + " >" + log + " 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string log() const {
    std::ifstream file(folder_ / "log");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path folder_;
};

TEST(Compare, ByDefaultGoesAsFarAsTheModelClaims) {
  const auto model = box_model();
  const rom::ReducedModel reduced = reduce(model, 9000.0);
  const modes::Comparison result = modes::compare(model, reduced, {});
  modes::ModesOptions claimed;
  claimed.fmax_hz = reduced.certificate.accurate_to_hz.value();
  EXPECT_EQ(static_cast<int>(result.modes.size()), modes::analyse(model, claimed).modes.size() - 6);
  EXPECT_TRUE(result.without_stated_error().modes.empty());
}

TEST(Compare, BeyondThatErrorsAreSummedUpApart) {
  const auto model = box_model();
  const rom::ReducedModel reduced = reduce(model, 9000.0);
  const modes::Comparison result = modes::compare(model, reduced, {reduced.valid_to_hz, 0});
  modes::ModesOptions all;
  all.fmax_hz = reduced.valid_to_hz;
  EXPECT_EQ(static_cast<int>(result.modes.size()), modes::analyse(model, all).modes.size() - 6);
  EXPECT_GT(result.modes.back().full_hz, result.accurate_to_hz);
  const auto stated = result.with_stated_error(), above = result.without_stated_error();
  EXPECT_EQ(stated.modes.size() + above.modes.size(), result.modes.size());
  EXPECT_EQ(result.largest_error(), std::max(stated.largest_error(), above.largest_error()));
  const auto lines = modes::table_of(result);
  EXPECT_NE(lines.back().find("up to 4500 Hz: largest error"), std::string::npos) << lines.back();
  EXPECT_NE(lines[lines.size() - 2].find("no accuracy is stated"), std::string::npos);
}

TEST(Compare, NothingToCompareIsRefusedWithTheFirstElasticFrequency) {
  const auto model = box_model();
  const rom::ReducedModel reduced = reduce(model, 9000.0);
  const double first = modes::compare(model, reduced, {0.0, 7}).modes.front().full_hz;
  for (const modes::CompareOptions& asked : {modes::CompareOptions{0.5 * first, 0}, {0.0, 6}}) {
    try {
      modes::compare(model, reduced, asked);
      ADD_FAILURE() << "accepted";
    } catch (const modes::NothingCompared& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find("nothing was compared"), std::string::npos);
      EXPECT_NE(said.find(fmt::format("{:.6g} Hz", first)), std::string::npos) << said;
      EXPECT_NE(said.find(asked.count > 0 ? "6 lowest" : "below"), std::string::npos) << said;
    }
  }
}

TEST(Compare, ModesBelowHalfTheCutOffAgreeInFrequencyAndShape) {
  const auto model = box_model();
  const rom::ReducedModel reduced = reduce(model, 9000.0);
  const modes::Comparison result = modes::compare(model, reduced, {}).with_stated_error();
  EXPECT_EQ(result.accurate_to_hz, 4500.0);
  EXPECT_EQ(result.rigid_full, 6);
  ASSERT_GT(result.modes.size(), 4u);
  EXPECT_LT(result.largest_error(), 1.5e-5);  // 1.5e-6 is reached
  // A frequency that is too high by this comes from a shape with twice the energy in other modes.
  EXPECT_GT(result.smallest_mac(), 1.0 - 3e-5);
  for (const auto& mode : result.modes) EXPECT_GE(mode.error, -1e-9);
}

TEST(Compare, MatrixOfMacIsNearlyTheIdentityAndHasThePairsOnItsDiagonal) {
  const auto model = box_model();
  const modes::Comparison result = modes::compare(model, reduce(model, 9000.0), {});
  const auto n = static_cast<Eigen::Index>(result.modes.size());
  ASSERT_EQ(result.mac_matrix.rows(), n);
  ASSERT_EQ(result.mac_matrix.cols(), n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const modes::ComparedMode& pair = result.modes[j];
    EXPECT_NEAR(result.mac_matrix(j, j), pair.mac, 1e-6);
    EXPECT_EQ(result.column_hz[j], pair.reduced_hz);
    Eigen::Index best = -1;
    result.mac_matrix.row(j).maxCoeff(&best);
    EXPECT_EQ(best, j);
  }
  const std::string text = modes::matrix_text(result);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), n + 2);
  EXPECT_EQ(std::count(text.begin(), text.end(), ','), n * (n + 1));
  EXPECT_NE(
      text.find(fmt::format("\n{:.4f},{:.6f},", result.modes[0].full_hz, result.mac_matrix(0, 0))),
      std::string::npos);
}

TEST(Compare, AStifferModelShowsItsErrorInFrequencyOnly) {
  const auto model = box_model();
  rom::ReducedModel reduced = reduce(model, 9000.0);
  reduced.K_rr *= 1.21;
  const modes::Comparison result = modes::compare(model, reduced, {0.0, 12});
  for (const auto& mode : result.modes)
    EXPECT_NEAR(mode.error, 0.1, 2e-6);  // the reduction's own error
}

TEST(Compare, StrangersAreRefused) {
  const auto model = box_model();
  rom::ReducedModel reduced = reduce(model, 6000.0);
  reduced.sets.clear();
  reduced.skin.nodes.array() += 100.0;
  test::expect_parts(test::refusal_of([&] {
                       modes::compare(model, reduced, {0.0, 10});
                     }),
                     {"box and box: found no node or set in both, expected the same part"});
}

TEST(Analyse, AClampedBoxHasNoRigidModesAndZerosWhereItIsHeld) {
  const auto model = box_model();
  modes::ModesOptions options;
  options.count = 5;
  options.fixed = {"left", "right"};
  const modes::PartModes part = modes::analyse(model, options);
  EXPECT_EQ(part.modes.rigid, 0);
  for (const int dof : model.sets.at("left").dofs)
    EXPECT_EQ(part.modes.vectors.row(dof).norm(), 0.0);
  options.fixed = {"lfet"};
  test::expect_parts(test::refusal_of([&] { modes::analyse(model, options); }),
                     {"box: set: found \"lfet\", expected one of: ", "left"});
}

TEST_F(InFolder, ModesFileGivesBackItsTable) {
  const auto model = box_model();
  modes::ModesOptions options;
  options.count = 9;
  const modes::PartModes part = modes::analyse(model, options);
  const fs::path path = folder_ / "box.modes.h5";
  H5File file = H5File::create(path);
  modal::write_modes(file, part);
  write_provenance(file, {modal::kModesSchema, "", {}});
  file.commit();
  const modal::ModeTable table = modal::read_mode_table(path);
  EXPECT_EQ(table.rigid, 6);
  EXPECT_EQ(table.frequency_hz, part.modes.frequencies_hz());
  EXPECT_EQ(H5File::open(path).shape("shapes"), (std::vector<int64_t>{9, model.nodes.rows(), 3}));
}

TEST_F(InFolder, CommandsReduceAndCompareAModel) {
  const std::string fe = write_fe(box_model()).string();
  const std::string toml =
      write_text("box.rom.toml", "boundary = [\"left\", \"right\"]\nfmax_hz = 9000.0\n").string();
  const std::string rom = (folder_ / "box.rom.h5").string();
  ASSERT_EQ(call("clatter-condense " + fe + " -c " + toml + " -o " + rom + " --json"), 0) << log();
  EXPECT_NE(log().find("\"count_proved\": 1"), std::string::npos) << log();
  const rom::ReducedModel reduced = rom::read_reduced_model(rom);
  EXPECT_EQ(reduced.method, "craig-bampton");
  EXPECT_EQ(reduced.valid_to_hz, 9000.0);
  EXPECT_EQ(reduced.certificate.rigid_modes.value(), 6.0);
  ASSERT_EQ(call("clatter-modal compare " + fe + " " + rom), 0) << log();
  EXPECT_NE(log().find("MAC"), std::string::npos) << log();
  ASSERT_EQ(call("clatter-modal compare " + fe + " " + rom + " --mac " +
                 (folder_ / "box.mac.csv").string()),
            0)
      << log();
  EXPECT_EQ(read_whole_file(folder_ / "box.mac.csv").rfind("# MAC of the full model's", 0), 0u);
  EXPECT_EQ(call("clatter-modal compare " + fe + " " + rom + " --mac " + rom), 2) << log();
  EXPECT_EQ(call("clatter-modal compare " + fe + " " + rom + " --fmax-hz 100"), 3) << log();
  EXPECT_NE(log().find("error: box: nothing was compared"), std::string::npos) << log();
  const std::string modes = (folder_ / "box.modes.h5").string();
  ASSERT_EQ(call("clatter-modal " + fe + " --count 8 -o " + modes), 0) << log();
  EXPECT_EQ(modal::read_mode_table(modes).rigid, 6);
  ASSERT_EQ(call("clatter-modal " + rom + " --count 8 -o " + modes), 0) << log();
}

TEST_F(InFolder, BadInputEndsWithCode2AndLeavesNoFile) {
  const std::string fe = write_fe(box_model()).string();
  const std::string rom = (folder_ / "box.rom.h5").string();
  const auto condense_with = [&](const std::string& text) {
    const std::string toml = write_text("bad.rom.toml", text).string();
    return call("clatter-condense " + fe + " -c " + toml + " -o " + rom);
  };
  EXPECT_EQ(condense_with("boundary = [\"lfet\"]\nfmax_hz = 5000.0\n"), 2);
  EXPECT_NE(log().find("left"), std::string::npos) << log();
  EXPECT_EQ(condense_with("boundary = [\"left\"]\nfmax_hz = -1.0\n"), 2);
  EXPECT_EQ(condense_with("boundary = [\"left\"]\nfmax_hz = 1e12\n"), 2);
  EXPECT_EQ(condense_with("boundary = [\"point\"]\nfmax_hz = 5000.0\n"), 2);
  EXPECT_EQ(condense_with("bounday = [\"left\"]\nfmax_hz = 5000.0\n"), 2);
  EXPECT_FALSE(fs::exists(rom));
  EXPECT_EQ(call("clatter-modal " + fe + " --fmax-hz -3 -o " + rom), 2);
  EXPECT_EQ(call("clatter-modal " + fe), 2);
}

TEST_F(InFolder, ATruncatedModelIsRefusedAndTheOldResultStays) {
  const std::string fe = write_fe(box_model()).string();
  fs::resize_file(fe, fs::file_size(fe) / 2);
  const std::string rom = write_text("box.rom.h5", "an older result").string();
  const std::string toml =
      write_text("box.rom.toml", "boundary = [\"left\", \"right\"]\ncount = 5\n").string();
  const int code = call("clatter-condense " + fe + " -c " + toml + " -o " + rom);
  EXPECT_TRUE(code == 2 || code == 4) << code << log();
  std::ifstream old(rom);
  std::string text;
  std::getline(old, text);
  EXPECT_EQ(text, "an older result");
}

TEST_F(InFolder, HardC6_TooLittleMemoryEndsWithCode3AndNeverWithASignal) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer needs terabytes of address space, ulimit -v forbids them";
#endif
  const std::string fe = write_fe(box_model(24, 22, 22)).string();
  const std::string toml =
      write_text("box.rom.toml", "boundary = [\"left\", \"right\"]\ncount = 60\n").string();
  const std::string rom = (folder_ / "box.rom.h5").string();
  for (const std::string& program : {"clatter-condense " + fe + " -c " + toml + " -o " + rom,
                                     "clatter-modal " + fe + " --count 60 -o " + rom}) {
    // Address space that holds the program and the matrices, but not the factor.
    const std::string command = "bash -c 'export OPENBLAS_NUM_THREADS=1; ulimit -v 420000; exec " +
                                std::string(CLATTER_BIN_DIR) + "/" + program + "' >" +
                                (folder_ / "log").string() + " 2>&1";
    const int status = std::system(command.c_str());
    ASSERT_TRUE(WIFEXITED(status)) << program;
    EXPECT_EQ(WEXITSTATUS(status), 3) << log();
    EXPECT_NE(log().find("memory"), std::string::npos) << log();
    EXPECT_FALSE(fs::exists(rom));
    EXPECT_FALSE(fs::exists(rom + ".part"));
  }
}

}  // namespace
}  // namespace clatter
