// SPDX-License-Identifier: GPL-3.0-or-later
// The program from the command line: exit codes, one-line messages, unchanged older results.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "core/base/h5_file.hpp"
#include "synthetic.hpp"
#include "tests/paths.hpp"

namespace clatter::recover {
namespace {

using namespace testing;
namespace fs = std::filesystem;

class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fresh_folder(test->name());
    const Mesh6 mesh = hollow_box({0.3, 0.2, 0.1}, 2);
    const RunPlan plan;
    write_run(folder_, model_on(mesh, random_rows(mesh, 3, 1), 2000.0), plan, [&](double t) {
      const double w = 2 * std::numbers::pi * 400.0;
      Motion m{Eigen::Vector3d(1, 2, 3) * std::cos(w * t), {}, {}};
      m.v = Eigen::Vector3d(1, 2, 3) * -w * std::sin(w * t);
      m.a = -w * w * m.q;
      return m;
    });
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  /// Runs clatter-recover inside the folder.
  int recover(const std::string& arguments) {
    return run_command(
        "cd '" + folder_.string() + "' && '" CLATTER_BIN_DIR "/clatter-recover' " + arguments,
        output_);
  }
  /// Bad input: exit code `code`, one line that contains `words`, no output file.
  void expect_refused(const std::string& arguments, const std::string& words, int code = 2) {
    EXPECT_EQ(recover(arguments + " -o out.field.h5 --quiet"), code) << output_;
    EXPECT_NE(output_.find(words), std::string::npos) << output_;
    EXPECT_EQ(std::count(output_.begin(), output_.end(), '\n'), 1) << output_;
    EXPECT_FALSE(fs::exists(folder_ / "out.field.h5"));
    EXPECT_FALSE(fs::exists(folder_ / "out.field.h5.part"));
  }

  /// A script beside this file finds out.field.h5 right.
  void expect_agreed_by(const std::string& script) {
    const std::string check = "/usr/bin/python3 '" CLATTER_SOURCE_DIR "/tests/recover/" + script +
                              "' '" + (folder_ / "out.field.h5").string() + "'";
    EXPECT_EQ(run_command(check, output_), 0) << output_;
  }

  fs::path folder_;
  std::string output_;
};

TEST_F(Program, DefaultsMakeAFieldFileThatAnotherProgramReads) {
  ASSERT_EQ(recover("run.h5 -o out.field.h5 --json --depfile out.d"), 0) << output_;
  EXPECT_NE(output_.find("\"erp_db\""), std::string::npos);
  EXPECT_NE(output_.find("ERP re 1 pW"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out.d"));
  expect_agreed_by("check_field.py");
}

TEST_F(Program, AnotherProgramReadsAllQuantitiesInSinglePrecision) {
  const std::string all =
      "quantities = [\"displacement\", \"velocity\", \"acceleration\", \"normal_velocity\"]\n";
  write("all.toml", "[output]\nprecision = \"single\"\n[frames]\n" + all + "[lines]\n" + all);
  ASSERT_EQ(recover("run.h5 -c all.toml -o out.field.h5"), 0) << output_;
  expect_agreed_by("check_field.py");
}

TEST_F(Program, AveragedPowersAreThoseOfScipy) {
  write("welch.toml",
        "cycle = false\n[[window]]\nname = \"w\"\nfrom_s = 0\nto_s = 0.12\ntaper = \"hann\"\n"
        "segment_s = 0.025\noverlap = 0.5\n");
  ASSERT_EQ(recover("run.h5 -c welch.toml -o out.field.h5"), 0) << output_;
  expect_agreed_by("check_averages.py");
}

TEST_F(Program, HelpTeachesTheConfiguration) {
  EXPECT_EQ(recover("--help"), 0);
  for (const char* word : {"clatter-recover slap.run.h5", "clatter-recover keys"})
    EXPECT_NE(output_.find(word), std::string::npos) << word;
  EXPECT_EQ(recover("keys field.toml"), 0) << output_;
  for (const char* word : {"[[panel]]", "[[window]]", "taper"})
    EXPECT_NE(output_.find(word), std::string::npos) << word;
}

TEST_F(Program, SameInputGivesTheSameNumbers) {
  ASSERT_EQ(recover("run.h5 -o a.field.h5 --quiet"), 0) << output_;
  ASSERT_EQ(recover("run.h5 -o b.field.h5 --quiet"), 0) << output_;
  const H5File a = H5File::open(folder_ / "a.field.h5"), b = H5File::open(folder_ / "b.field.h5");
  for (const char* name : {"analysis/cycle/panels/skin/erp", "lines/normal_velocity_im/00000",
                           "analysis/ftdc/panels/exposed/instant_mean_square_velocity"})
    EXPECT_EQ(a.read_doubles(name), b.read_doubles(name)) << name;
}

TEST_F(Program, FrequencyAboveTheBasisIsRefused) {
  write("f.toml", "[lines]\nfrequencies_hz = [2500]\n");
  expect_refused("run.h5 -c f.toml", "2500 Hz, expected at most 2000 Hz");
  write("g.toml", "[spectrum]\nto_hz = 2500\n");
  expect_refused("run.h5 -c g.toml", "spectrum.to_hz: found 2500 Hz");
}

TEST_F(Program, MissingFilesAndWrongSchemasAreRefused) {
  EXPECT_NE(recover("nowhere.run.h5 -o out.field.h5 --quiet"), 0);
  EXPECT_FALSE(fs::exists(folder_ / "out.field.h5"));
  expect_refused("rom.h5", "clatter/run/1");
}

TEST_F(Program, UnknownKeyBodySensorAndPanelAreRefused) {
  write("key.toml", "[spectrun]\nto_hz = 10\n");
  expect_refused("run.h5 -c key.toml", "spectrun");
  write("body.toml", "body = \"piston\"\n");
  expect_refused("run.h5 -c body.toml", "piston");
  write("sensor.toml", "[[sensor]]\nset = \"nowhere\"\n");
  expect_refused("run.h5 -c sensor.toml", "nowhere");
  write("panel.toml", "[[panel]]\nname = \"far\"\nbox_min = [9, 9, 9]\n");
  expect_refused("run.h5 -c panel.toml", "far");
  write("surface.toml", "[[panel]]\nname = \"deck\"\nsurfaces = [\"deck\"]\n");
  expect_refused("run.h5 -c surface.toml", "panel 'deck': surfaces");
  write("window.toml", "[[window]]\nname = \"late\"\nfrom_s = 1.0\nto_s = 2.0\n");
  expect_refused("run.h5 -c window.toml", "late");
}

TEST_F(Program, TruncatedRunIsRefusedAndAnOlderResultStaysUntouched) {
  ASSERT_EQ(recover("run.h5 -o keep.field.h5 --quiet"), 0) << output_;
  const auto before = fs::file_size(folder_ / "keep.field.h5");
  fs::resize_file(folder_ / "run.h5", fs::file_size(folder_ / "run.h5") / 2);
  const int code = recover("run.h5 -o keep.field.h5 --quiet");
  EXPECT_TRUE(code == 2 || code == 4) << code << output_;
  EXPECT_EQ(std::count(output_.begin(), output_.end(), '\n'), 1) << output_;
  EXPECT_EQ(fs::file_size(folder_ / "keep.field.h5"), before);
}

TEST_F(Program, AnotherReducedModelThanTheRunsIsRefused) {
  const Mesh6 mesh = box({1, 1, 1}, 1);
  const auto other = fresh_folder("other_rom");
  write_run(other, model_on(mesh, random_rows(mesh, 3, 2), 2000.0), {}, [](double) {
    return Motion{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  });
  fs::copy_file(other / "rom.h5", folder_ / "rom.h5", fs::copy_options::overwrite_existing);
  fs::remove_all(other);
  expect_refused("run.h5", "sha256");
}

TEST_F(Program, SoundAtOtherMicrophonesTakesOverWhatItHasSolved) {
  const std::string options =
      "[skin]\nopening = 0.05\n[grid]\nfrom_hz = 200\nto_hz = 500\ntolerance_db = 3\n";
  const std::string taken = "frequencies of the earlier file are taken over";
  write("part.toml", options);
  ASSERT_EQ(recover("sound rom.h5 -c part.toml -o part.sound.h5"), 0) << output_;
  EXPECT_EQ(output_.find(taken), std::string::npos) << output_;
  write("part.toml", options + "[[microphone]]\nname = \"ear\"\nposition = [0, 1, 1]\n");
  ASSERT_EQ(recover("sound rom.h5 -c part.toml -o part.sound.h5"), 0) << output_;
  EXPECT_NE(output_.find(taken), std::string::npos) << output_;
  EXPECT_NE(output_.find("microphone ear"), std::string::npos) << output_;
  ASSERT_EQ(recover("sound rom.h5 -c part.toml -o fresh.sound.h5"), 0) << output_;
  const H5File again = H5File::open(folder_ / "part.sound.h5"),
               fresh = H5File::open(folder_ / "fresh.sound.h5");
  for (const char* name : {"microphones/pressure_re/00000", "surface_pressure/im/00001"})
    EXPECT_TRUE(again.read_matrix(name) == fresh.read_matrix(name)) << name;
}

TEST_F(Program, SoundOfAPartIsUsedByARun) {
  write("part.toml",
        "[skin]\nopening = 0.05\n[grid]\nfrom_hz = 200\nto_hz = 500\ntolerance_db = 3\n");
  ASSERT_EQ(recover("sound rom.h5 -c part.toml -o part.sound.h5 --json"), 0) << output_;
  EXPECT_NE(output_.find("\"monopole_error_db\""), std::string::npos) << output_;
  write("field.toml", "sound = \"part.sound.h5\"\n");
  ASSERT_EQ(recover("run.h5 -c field.toml -o out.field.h5"), 0) << output_;
  for (const char* words : {"sound power", "boundary elements up to 500 Hz", "microphone plus_y",
                            "sound of panel exposed", "100.0 %", "engine_1m: ",
                            "from that of boundary elements", "panel_power_difference"})
    EXPECT_NE(output_.find(words), std::string::npos) << output_;
  const H5File field = H5File::open(folder_ / "out.field.h5");
  for (const char* attribute : {"unit", "meaning", "amplitude", "phase"})
    EXPECT_TRUE(field.has_attribute("analysis/cycle/sound/microphones/top/pressure_re", attribute))
        << attribute;
  ASSERT_EQ(recover("listen out.field.h5 out.wav --microphone top --seconds 0.5"), 0) << output_;
  EXPECT_NE(output_.find("top, up to 500 Hz: peak"), std::string::npos) << output_;
  EXPECT_EQ(fs::file_size(folder_ / "out.wav"), 44u + 2u * 24000u);
  EXPECT_EQ(recover("listen out.field.h5 none.wav --microphone roof"), 2);
  EXPECT_NE(output_.find("found [minus_x, minus_y, plus_x, plus_y, top], expected roof"),
            std::string::npos)
      << output_;
  ASSERT_EQ(recover("sound --help"), 0);
  EXPECT_NE(output_.find("block.sound.h5"), std::string::npos) << output_;
  ASSERT_EQ(recover("keys sound.toml"), 0) << output_;
  for (const char* word : {"[[microphone]]", "[ground]", "tolerance_db"})
    EXPECT_NE(output_.find(word), std::string::npos) << word;
}

TEST_F(Program, BadSoundInputIsRefused) {
  write("key.toml", "[grit]\nto_hz = 10\n");
  expect_refused("sound rom.h5 -c key.toml", "grit");
  write("above.toml", "[grid]\nto_hz = 3000\n");
  expect_refused("sound rom.h5 -c above.toml", "grid.to_hz: found 3000, expected at most 2000");
  write("opening.toml", "[skin]\nopening = 1\n");
  expect_refused("sound rom.h5 -c opening.toml", "rom.h5: acoustic skin: found openings of 1 m");
  expect_refused("sound run.h5", "clatter/rom/1");
  write("field.toml", "sound = \"rom.h5\"\n");
  expect_refused("run.h5 -c field.toml", "clatter/sound/2");
  write("inside.toml",
        "[skin]\nopening = 0.05\n[[microphone]]\nname = \"m\"\nposition = [0.05, 0.05, 0.05]\n");
  expect_refused(
      "sound rom.h5 -c inside.toml",
      "inside.toml: microphone 'm': found (0.05, 0.05, 0.05) m inside the body, expected "
      "a point outside");
  write("below.toml",
        "[skin]\nopening = 0.05\n[ground]\noffset = -0.2\n[[microphone]]\nname = \"m\"\n"
        "position = [1, 0, -0.3]\n");
  expect_refused("sound rom.h5 -c below.toml",
                 "below.toml: microphone 'm': found (1, 0, -0.3) m below the ground plane");
  write("free.toml", "microphones = \"iso_3744\"\n[skin]\nopening = 0.05\n");
  expect_refused("sound rom.h5 -c free.toml",
                 "free.toml: microphones: \"iso_3744\" needs [ground]:");
  write("set.toml", "microphones = \"engine\"\n");
  expect_refused("sound rom.h5 -c set.toml", "set.toml:1: microphones: found");
}

TEST_F(Program, SkinThatIsMissingOrOpenIsRefusedForSound) {
  const auto other = fresh_folder("open_rom");
  const auto at_rest = [](double) {
    return Motion{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  };
  Mesh6 mesh = box({0.3, 0.2, 0.1}, 2);
  const IndexMatrix all = mesh.triangles;
  mesh.triangles = all.topRows(all.rows() - 8);  // without the side at z = 0.1
  write_run(other, model_on(mesh, random_rows(mesh, 3, 2), 2000.0), {}, at_rest);
  write("part.toml", "[skin]\nopening = 0.05\n");
  expect_refused("sound '" + (other / "rom.h5").string() + "' -c part.toml",
                 "acoustic skin: found a skin that is open along 8 edges, 0.3 m wide, expected a "
                 "closed one or openings up to 0.05 m");
  rom::ReducedModel bare = model_on(mesh, random_rows(mesh, 3, 2), 2000.0);
  bare.skin = {};
  write_run(other, bare, {}, at_rest);
  expect_refused("sound '" + (other / "rom.h5").string() + "' -c part.toml",
                 "rom.h5: acoustic skin: found a reduced model without a skin");
  expect_refused("'" + (other / "run.h5").string() + "'",
                 "rom.h5: skin: found none, expected a skin (condense with one)");
  fs::remove_all(other);
}

TEST_F(Program, SoundFileOfAnotherModelIsRefused) {
  write("part.toml",
        "[skin]\nopening = 0.05\n[grid]\nfrom_hz = 400\nto_hz = 500\ntolerance_db = 9\n");
  ASSERT_EQ(recover("sound rom.h5 -c part.toml -o part.sound.h5"), 0) << output_;
  const Mesh6 mesh = hollow_box({0.3, 0.2, 0.1}, 2);
  write_run(folder_, model_on(mesh, random_rows(mesh, 3, 7), 2000.0), {}, [](double) {
    return Motion{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  });
  write("field.toml", "sound = \"part.sound.h5\"\n");
  expect_refused("run.h5 -c field.toml", "part.sound.h5: rom_sha256: found");
}

}  // namespace
}  // namespace clatter::recover
