// SPDX-License-Identifier: GPL-3.0-or-later
// Memory limits: what is chosen, spilled or refused.
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/base/memory_limit.hpp"
#include "core/sparse/eigen/block_lanczos.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"
#include "core/sparse/eigen/krylov_basis.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"
#include "core/sparse/symmetric_product.hpp"
#include "tests/core/sparse/spring_models.hpp"
#include "tests/random_matrix.hpp"
#include "tests/refusal.hpp"

namespace clatter::sparse {
namespace {

using Eigen::MatrixXd;

struct Limited {
  explicit Limited(double gib) { set_memory_limit_gib(gib); }
  ~Limited() { set_memory_limit_gib(0.0); }
};

TEST(MemoryLimit, IsTheMachinesUnlessOneIsSet) {
  EXPECT_GT(memory_limit_gib(), 0.5);
  EXPECT_GT(memory_in_use_gib(), 0.0);
  const Limited limit(0.25);
  EXPECT_EQ(memory_limit_gib(), 0.25);
  EXPECT_LE(memory_left_gib(), 0.25);
  test::expect_parts(
      test::refusal_of<NumericsError>([&] { require_memory("a thing", 0.3, "take less"); }),
      {"a thing needs 307 MiB, ", " of 256 MiB are left: take less"});
  EXPECT_NO_THROW(require_memory("a thing", 0.0, "take less"));
}

TEST(MemoryLimit, AFactorThatDoesNotFitIsRefusedBeforeItIsMade) {
  const auto box = test::spring_box(9, 9, 9);
  const SparseMatrix A = box.K + 1e6 * box.M;
  const Limited limit(memory_in_use_gib() + 1e-3);  // L needs 7 MB
  test::expect_parts(test::refusal_of<NumericsError>([&] { SupernodalFactor{A}; }),
                     {"the factor of 2187 unknowns needs",
                      "are left: use a coarser mesh or raise the limit (--memory-limit)"});
}

TEST(MemoryLimit, AmlsWhoseVectorsDoNotFitIsRefusedBeforeItTakesThem) {
  const auto box = test::spring_box(24, 20, 18);
  EigenOptions options = test::by_count(2000, EigenMethod::kAmls);
  options.sigma = default_shift(box.K, box.M);
  options.prove_count = false;
  const SupernodalFactor factor(SparseMatrix(box.K - *options.sigma * box.M));
  (void)memory_left_gib();  // returns memory freed by earlier tests
  const double before = memory_in_use_gib();
  const double vectors = gib_of_doubles(25920.0 * 2000.0);
  const Limited limit(before + 0.5 * vectors);
  try {
    (void)solve_modes(box.K, box.M, options, &factor);
    ADD_FAILURE() << "accepted";
  } catch (const NumericsError& error) {
    test::expect_parts(error.what(),
                       {"AMLS with", "vectors of 25920 unknowns", "fewer modes", "--memory-limit"});
  }
  EXPECT_LT(memory_in_use_gib() - before, 0.2 * vectors);  // 0.4 GiB
}

#ifndef __SANITIZE_ADDRESS__  // which keeps freed memory
TEST(MemoryLimit, AmlsThatFitsRuns) {
  const auto box = test::spring_box(12, 10, 9);
  EigenOptions options = test::by_count(100, EigenMethod::kAmls);
  options.prove_count = false;
  const Limited limit(memory_in_use_gib() + 0.25);
  EXPECT_EQ(solve_modes(box.K, box.M, options).size(), 100);
}
#endif

TEST(MemoryLimit, TheBasisShrinksThenGoesToDisk) {
  BlockLanczosOptions options;
  options.count = 100;
  const auto columns = [&](double held) {  // that fit in addition to 3 blocks and the modes
    return basis_size(options, 16, 1000000, gib_of_doubles(1e6 * (held + 48 + 100)));
  };
  const BasisSize ample = columns(500), enough = columns(300), least = columns(200);
  EXPECT_EQ(ample.columns, 464);   // 4 modes and 4 blocks
  EXPECT_EQ(enough.columns, 272);  // 2 modes and 4 blocks, rounded to blocks
  EXPECT_EQ(least.columns, 192);   // 1.25 modes and 4 blocks, rounded to blocks
  for (const BasisSize& room : {ample, enough, least}) EXPECT_EQ(room.storage, Storage::kMemory);
  EXPECT_EQ(columns(150).storage, Storage::kDisk);
  EXPECT_EQ(columns(150).columns, enough.columns);
}

TEST(MemoryLimit, ModesAreTheSameWithTheBasisOnDisk) {
  const auto box = test::spring_box(10, 9, 9);
  const double sigma = default_shift(box.K, box.M);
  const SupernodalFactor factor(SparseMatrix(box.K - sigma * box.M));
  const SymmetricProduct mass(box.M);
  ShiftInvert problem;
  problem.size = box.K.rows();
  problem.sigma = sigma;
  problem.solve = [&](const double* x, double* y, int count) {
    Eigen::Map<RowMatrix>(y, problem.size, count) =
        factor.solve(Eigen::Map<const RowMatrix>(x, problem.size, count));
  };
  problem.mass = [&](const double* x, double* y, int count) { mass.multiply(x, y, count); };
  BlockLanczosOptions options;
  options.count = 12;
  options.storage = Storage::kMemory;
  const EigenResult memory = solve_block_lanczos(problem, options);
  options.storage = Storage::kDisk;
  const EigenResult disk = solve_block_lanczos(problem, options);
  ASSERT_TRUE(memory.ok() && disk.ok());
  EXPECT_EQ(memory.values, disk.values);
  EXPECT_EQ(memory.vectors, disk.vectors);
}

TEST(KrylovBasisTest, ProductsAreThoseOfDenseMatricesInMemoryAndOnDisk) {
  const Eigen::Index n = 3001, b = 16,
                     room = 13 * b;  // more than one tile in each direction, and a remainder
  TallBlock block(n, b);
  const MatrixXd S = test::random_matrix(room, 5);
  MatrixXd V(n, room), H[2];
  for (const Storage storage : {Storage::kMemory, Storage::kDisk}) {
    KrylovBasis basis(n, room, storage);
    for (Eigen::Index k = 0; k < 13; ++k) {
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index c = 0; c < b; ++c)
          block.row(i)[c] = V(i, k * b + c) =
              std::sin(0.37 * static_cast<double>(i * b + c + 1) * static_cast<double>(k + 1));
      basis.put(k * b, block);
    }
    const MatrixXd last = V.rightCols(b), used = V.middleCols(2, 199);
    const MatrixXd coefficients = H[static_cast<int>(storage)] = basis.coefficients(2, 201, block);
    EXPECT_LT((coefficients - used.transpose() * last).norm(), 1e-12 * coefficients.norm());
    basis.subtract(2, coefficients, block);
    const RowMatrix left = Eigen::Map<const RowMatrix>(block.row(0), n, b);
    EXPECT_LT((left - (last - used * coefficients)).norm(), 1e-12 * (used * coefficients).norm());
    basis.transform(S);
    EXPECT_LT((basis.take_columns(5) - V * S).norm(), 1e-12 * (V * S).norm());
  }
  EXPECT_EQ(H[0], H[1]);
}

}  // namespace
}  // namespace clatter::sparse
