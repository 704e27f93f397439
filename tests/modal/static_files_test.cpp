// SPDX-License-Identifier: GPL-3.0-or-later
// Statics from file to file: models, the command, refusals.
#include "modal/statics.hpp"

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "modal/certificates.hpp"
#include "static_bar.hpp"
#include "tests/paths.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter::modal {
namespace {

using fe::FeModel;
using testing::bar;
using testing::kSlide;

/// Files of one test in a separate folder.
class StaticFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch_path("static");
    std::filesystem::create_directories(folder_);
    H5File file = H5File::create(folder_ / "bar.fe.h5");
    write_provenance(file, {fe::kFeSchema, "", {}});
    fe::write_fe_model(file, model_);
    file.commit();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  int run(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.string() +
                                "' && '" CLATTER_BIN_DIR "/clatter-modal' " + arguments +
                                " > /dev/null 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  FeModel model_ = bar(std::string(kSlide) + R"(
[[point]]
name = "hub"
at = [0.05, 0.1, 0.5]
[[coupling]]
point = "hub"
surface = "z1"
[[support]]
name = "hub"
point = "hub"
directions = ["z"]
[[load]]
name = "lift"
kind = "displacement"
point = "hub"
directions = ["z"]
value = 1.0e-5
[[load]]
name = "push"
kind = "force"
set = "hub"
force = [3.0, 0.0, 0.0]
moment = [0.0, 0.0, 2.0]
[[case]]
name = "both"
loads = { lift = 2.0, push = 100.0 }
)");
  std::filesystem::path folder_;
};

TEST_F(StaticFiles, TheModelReadFromItsFileGivesTheSameSolution) {
  const FeModel back = fe::read_fe_model(folder_ / "bar.fe.h5");
  const StaticCase want = solve_static(model_, {"both"}).cases[0];
  const StaticCase got = solve_static(back, {"both"}).cases[0];
  EXPECT_EQ((got.displacement - want.displacement).norm(), 0.0);
  EXPECT_EQ((got.reactions - want.reactions).norm(), 0.0);
  EXPECT_EQ((got.points - want.points).norm(), 0.0);
  EXPECT_EQ((got.stress[0].stress - want.stress[0].stress).norm(), 0.0);
  EXPECT_DOUBLE_EQ(got.points(2), 2.0e-5);
  EXPECT_EQ(back.supports.names, model_.supports.names);
}

TEST_F(StaticFiles, TheCommandWritesStressesAndRefusesAnInvalidPosition) {
  EXPECT_EQ(run("statics bar.fe.h5 --stress-at nowhere -o bar.static.h5"), 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bar.static.h5"));
  ASSERT_EQ(run("statics bar.fe.h5 --case both --stress-at 1 -o bar.static.h5"), 0);
  const StaticCase want = solve_static(model_, {"both"}).cases[0];
  const H5File file = open_artefact(folder_ / "bar.static.h5", fe::kStaticSchema);
  EXPECT_EQ(file.read_ints("stress_nodes/body"), want.stress[0].nodes);
  EXPECT_LT((file.read_rows("cases/both/stress/body") - want.stress[0].stress).norm(),
            1e-12 * want.stress[0].stress.norm());
  EXPECT_EQ(file.read_vector("cases/both/von_mises/body").size(), model_.nodes.rows());
}

TEST_F(StaticFiles, TheCommandWritesDisplacementsAndReactionsOfTheNamedCases) {
  ASSERT_EQ(run("statics bar.fe.h5 --case both --case push -o bar.static.h5"), 0);
  const H5File file = open_artefact(folder_ / "bar.static.h5", fe::kStaticSchema);
  EXPECT_EQ(file.list("cases"), (std::vector<std::string>{"both", "push"}));
  const StaticCase want = solve_static(model_, {"both"}).cases[0];
  const RowMatrix u = file.read_rows("cases/both/displacement");
  ASSERT_EQ(u.rows(), model_.nodes.rows());
  EXPECT_LT((u.row(7).transpose() - want.displacement.segment<3>(21)).norm(), 1e-15);
  EXPECT_LT((file.read_matrix("cases/both/support_sums") - want.support_sums).norm(),
            1e-9 * want.support_sums.norm());
  EXPECT_LT(read_certificate<StaticCertificate>(file).balance_max, 1e-9);
  EXPECT_EQ(run("statics bar.fe.h5 --case nothing -o other.static.h5"), 2);
  EXPECT_EQ(run("statics bar.fe.h5"), 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "other.static.h5"));
}

TEST_F(StaticFiles, CasesOfLoadsThatAreNotThereAreRefused) {
  model_.cases["both"]["gone"] = 1.0;
  H5File file = H5File::create(folder_ / "bad.fe.h5");
  write_provenance(file, {fe::kFeSchema, "", {}});
  fe::write_fe_model(file, model_);
  file.commit();
  test::expect_parts(test::refusal_of([&] { fe::read_fe_model(folder_ / "bad.fe.h5"); }),
                     {"bad.fe.h5: cases/both: found load \"gone\", expected a load of the model"});
}

TEST_F(StaticFiles, SupportsBeyondTheirNamesAreRefused) {
  model_.supports.support[0] = 17;
  H5File file = H5File::create(folder_ / "bad.fe.h5");
  write_provenance(file, {fe::kFeSchema, "", {}});
  fe::write_fe_model(file, model_);
  file.commit();
  test::expect_parts(test::refusal_of([&] { fe::read_fe_model(folder_ / "bad.fe.h5"); }),
                     {"bad.fe.h5: supports/support: found 17, expected 0 to "});
}

}  // namespace
}  // namespace clatter::modal
