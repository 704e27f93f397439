// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/base/sparse.hpp"
#include "core/rom/reduced_model.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch_path("files");
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

SparseMatrix small_lower() {
  SparseMatrix matrix(3, 3);
  std::vector<Eigen::Triplet<double>> entries{{0, 0, 2.0}, {1, 0, -1.0}, {1, 1, 2.0}, {2, 2, 5.0}};
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

rom::ReducedModel small_model() {
  rom::ReducedModel model;
  model.name = "bar";
  model.method = "craig-bampton";
  model.n_boundary = 1;
  model.M_rr = Eigen::MatrixXd::Identity(2, 2);
  model.K_rr = Eigen::Matrix2d{{2.0, -1.0}, {-1.0, 2.0}};
  model.rigid = Eigen::MatrixXd::Ones(2, 6);
  model.fixed_interface_hz = Eigen::VectorXd::Constant(1, 100.0);
  rom::DofSet tip{"node", {0}, {"tip.x"}, Eigen::MatrixXd::Zero(1, 3), Eigen::MatrixXd::Ones(1, 3),
                  {0}};
  model.sets["tip"] = tip;
  model.loads["gas"] = Eigen::Vector2d(1.0, 2.0);
  return model;
}

TEST_F(Files, DatasetsWrittenInPartsAreThoseWrittenAtOnce) {
  RowMatrix values(20000, 3);
  for (Eigen::Index i = 0; i < values.size(); ++i) values.data()[i] = 0.1 * static_cast<double>(i);
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> narrow = values.cast<float>();
  H5File out = H5File::create(folder_ / "a.h5");
  out.create("double", {20000, 3}, false);
  out.create("single", {20000, 3}, true);
  // Parts that end within chunks of 5461 and 10922 rows, and out of order.
  for (const auto& [first, end] : {std::pair{7000, 20000}, {0, 1}, {1, 7000}}) {
    out.write_part("double", first, values.row(first).data(), 3 * (end - first));
    out.write_part("single", first, narrow.row(first).data(), 3 * (end - first));
  }
  out.store_single(true);
  out.write("narrowed", values);
  out.write("counts", std::vector<int32_t>{1, 2, 2000000001});
  out.store_single(false);
  out.write("wide", values);
  out.commit();
  const H5File in = H5File::open(folder_ / "a.h5");
  EXPECT_EQ(in.read_rows("double"), values);
  EXPECT_EQ(in.read_rows("single"), RowMatrix(narrow.cast<double>()));
  EXPECT_EQ(in.read_rows("narrowed"), RowMatrix(narrow.cast<double>()));
  EXPECT_EQ(in.read_rows("wide"), values);
  EXPECT_EQ(in.read_ints("counts").back(), 2000000001);
  // 8, 4, 4 and 8 bytes a value, in complete chunks: at most a tenth more.
  EXPECT_LT(fs::file_size(folder_ / "a.h5"), size_t{20000} * 3 * (8 + 4 + 4 + 8) * 11 / 10 + 10000);
}

TEST_F(Files, AppendedRowsAreTheRowsWrittenAtOnceUnderAnotherName) {
  const RowMatrix all = RowMatrix::Random(1003, 7);
  const fs::path begun = folder_ / "begun.h5", named = folder_ / "named.h5";
  H5File file = H5File::create(begun);
  for (int first = 0; first < 1003; first += 100) {
    const int count = std::min(100, 1003 - first);
    file.append("group/rows", all.middleRows(first, count));
    file.append("numbers", std::vector<double>(count, first));
    file.append_float("cells", std::vector<float>(6 * count, 0.5F), {count, 2, 3});
  }
  file.append("group/rows", RowMatrix(0, 7));
  file.append("none", std::vector<double>());
  EXPECT_EQ(file.read_rows("group/rows", 300, 200), all.middleRows(300, 200));  // while it grows
  file.commit(named);
  EXPECT_FALSE(fs::exists(begun) || fs::exists(folder_ / "begun.h5.part"));
  const H5File back = H5File::open(named);
  EXPECT_EQ(back.read_rows("group/rows"), all);
  const auto numbers = back.read_doubles("numbers");
  ASSERT_EQ(numbers.size(), 1003U);
  EXPECT_EQ(numbers[999], 900.0);
  EXPECT_EQ(numbers[1002], 1000.0);
  EXPECT_EQ(back.shape("cells"), (std::vector<int64_t>{1003, 2, 3}));
  EXPECT_EQ(back.shape("none"), (std::vector<int64_t>{0}));
}

// As a resumed run does: its records are copied from the checkpoint and grow.
TEST_F(Files, CopiedDatasetsGrow) {
  const int n_sets = 40;
  {
    H5File file = H5File::create(folder_ / "so_far.h5");
    for (int k = 0; k < n_sets; ++k)
      file.append(fmt::format("run/history/{}", k), std::vector<double>(30, k));
    file.set("run", "name", "so far");
    file.commit();
  }
  H5File file = H5File::create(folder_ / "grown.h5");
  file.append("history/0", std::vector<double>{7.0});  // gives way
  file.copy(H5File::open(folder_ / "so_far.h5"), "run", "/");
  for (int k = 0; k < n_sets; ++k)
    file.append(fmt::format("history/{}", k), std::vector<double>(2, -k));
  file.commit();
  const H5File grown = H5File::open(folder_ / "grown.h5");
  for (int k = 0; k < n_sets; ++k) {
    std::vector<double> expected(30, k);
    expected.insert(expected.end(), 2, -k);
    EXPECT_EQ(grown.read_doubles(fmt::format("history/{}", k)), expected);
  }
}

TEST_F(Files, MatricesComeBackAsTheyWere) {
  const RowMatrix rows{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  H5File out = H5File::create(folder_ / "a.h5");
  out.write("group/rows", rows);
  out.write("group/matrix", Eigen::MatrixXd(rows));
  out.write("texts", std::vector<std::string>{"one", ""});
  out.set("group", "unit", "m");
  out.commit();
  const H5File in = H5File::open(folder_ / "a.h5");
  EXPECT_EQ(in.read_rows("group/rows"), rows);
  EXPECT_EQ(in.read_matrix("group/matrix"), Eigen::MatrixXd(rows));
  EXPECT_EQ(in.read_rows("group/rows", 1, 1), rows.row(1));
  EXPECT_EQ(in.read_strings("texts"), (std::vector<std::string>{"one", ""}));
  EXPECT_EQ(in.get_string("group", "unit"), "m");
}

TEST_F(Files, NoFileHasTheFinalNameBeforeCommit) {
  const fs::path path = folder_ / "a.h5";
  std::ofstream(path) << "older artefact";
  {
    H5File out = H5File::create(path);
    out.write("x", std::vector<double>{1.0});
  }
  std::string content;
  std::getline(std::ifstream(path), content);
  EXPECT_EQ(content, "older artefact");
  EXPECT_FALSE(fs::exists(folder_ / "a.h5.part"));
}

TEST_F(Files, ATruncatedFileIsOneClearLine) {
  const fs::path path = folder_ / "a.h5";
  H5File out = H5File::create(path);
  out.write("x", std::vector<double>(1000, 1.0));
  out.commit();
  fs::resize_file(path, 3000);
  test::expect_parts(
      test::refusal_of([&] { H5File::open(path); }),
      {path.string(), "cannot be opened, expected a complete HDF5 file (truncated, or not HDF5)"});
}

TEST_F(Files, AWrongSchemaNamesBoth) {
  H5File out = H5File::create(folder_ / "a.h5");
  write_provenance(out, {"clatter/mesh/1", "", {}});
  out.commit();
  try {
    open_artefact(folder_ / "a.h5", "clatter/fe/1");
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("found clatter/mesh/1, expected clatter/fe/1"),
              std::string::npos);
  }
}

TEST_F(Files, ASparseMatrixRoundTripsAndMultiplies) {
  const SparseMatrix lower = small_lower();
  H5File out = H5File::create(folder_ / "a.h5");
  write_sparse(out, "K", lower, true);
  out.commit();
  const SparseMatrix back = read_sparse(H5File::open(folder_ / "a.h5"), "K");
  EXPECT_EQ(Eigen::MatrixXd(back), Eigen::MatrixXd(lower));
  // By hand: [2 -1 0; -1 2 0; 0 0 5] times (1, 1, 1).
  EXPECT_EQ(multiply_symmetric(back, Eigen::VectorXd::Ones(3)), Eigen::Vector3d(1.0, 1.0, 5.0));
}

TEST_F(Files, ASparseMatrixWithAnIndexOutOfRangeIsRefused) {
  H5File out = H5File::create(folder_ / "a.h5");
  write_sparse(out, "K", small_lower(), true);
  out.set("K", "shape", std::vector<int64_t>{2, 3});
  out.commit();
  test::expect_parts(test::refusal_of([&] { read_sparse(H5File::open(folder_ / "a.h5"), "K"); }),
                     {"a.h5: K: column 2 has row index 2, expected ascending within 2 to 1"});
}

TEST_F(Files, AnAttributeWithSeveralNumbersIsNotReadAsOne) {
  H5File out = H5File::create(folder_ / "a.h5");
  out.set("K", "shape", std::vector<int64_t>{2, 3});
  out.commit();
  const H5File back = H5File::open(folder_ / "a.h5");
  EXPECT_EQ(back.get_ints("K", "shape"), (std::vector<int64_t>{2, 3}));
  test::expect_parts(test::refusal_of([&] { back.get_int("K", "shape"); }),
                     {"a.h5: K: attribute shape has 2 numbers, expected 1"});
}

TEST_F(Files, AReducedModelRoundTrips) {
  const rom::ReducedModel model = small_model();
  H5File out = H5File::create(folder_ / "a.rom.h5");
  write_provenance(out, {"clatter/rom/1", "", {}});
  rom::write_reduced_model(out, model);
  out.commit();
  const rom::ReducedModel back = rom::read_reduced_model(folder_ / "a.rom.h5");
  EXPECT_EQ(back.K_rr, model.K_rr);
  EXPECT_EQ(back.set("tip").labels, model.set("tip").labels);
  EXPECT_EQ(back.loads.at("gas"), model.loads.at("gas"));
  test::expect_parts(test::refusal_of([&] { back.set("tap"); }),
                     {"bar: no set named tap, expected one of: tip"});
}

TEST_F(Files, AReducedModelWithAValueThatIsNotFiniteIsRefused) {
  rom::ReducedModel model = small_model();
  model.M_rr(0, 1) = std::numeric_limits<double>::quiet_NaN();
  H5File out = H5File::create(folder_ / "a.rom.h5");
  write_provenance(out, {"clatter/rom/1", "", {}});
  rom::write_reduced_model(out, model);
  out.commit();
  test::expect_parts(test::refusal_of([&] { rom::read_reduced_model(folder_ / "a.rom.h5"); }),
                     {"a.rom.h5: M_rr: found a value that is not finite"});
}

TEST_F(Files, TheHashIsThatOfTheStandard) {
  std::ofstream(folder_ / "abc") << "abc";
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(sha256_of_file(folder_ / "abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace clatter
