// Memory limits: what is chosen, spilled or refused.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/memory_limit.hpp"
#include "modal/eigen/krylov_basis.hpp"
#include "modal/factor/supernodal_factor.hpp"
#include "tests/modal/spring_models.hpp"

namespace clatter::modal {
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
  EXPECT_THROW(require_memory("a thing", 0.3, "take less"), NumericsError);
  EXPECT_NO_THROW(require_memory("a thing", 0.0, "take less"));
}

TEST(MemoryLimit, AFactorThatDoesNotFitIsRefusedBeforeItIsMade) {
  const auto box = test::spring_box(9, 9, 9);
  const SparseMatrix A = box.K + 1e6 * box.M;
  const Limited limit(memory_in_use_gib() + 1e-3);  // L alone takes 7 MB
  EXPECT_THROW(SupernodalFactor{A}, NumericsError);
}

TEST(MemoryLimit, ModesAreTheSameWithTheBasisOnDisk) {
  const auto box = test::spring_box(10, 9, 9);
  set_quiet(true);
  EigenOptions options;
  options.count = 12;
  options.prove_count = false;
  const ModeSet free = solve_modes(box.K, box.M, options);
  const SparseMatrix shifted = box.K - free.sigma * box.M;
  const SupernodalFactor factor(shifted);
  options.sigma = free.sigma;
  // Room for the modes and a few blocks, not for a basis.
  const double vectors = gib_of_doubles(static_cast<double>(box.K.rows()) * (15 + 12 + 8));
  const Limited limit(memory_in_use_gib() + vectors + 1e-4);
  const ModeSet spilled = solve_modes(box.K, box.M, options, &factor);
  EXPECT_LT((spilled.values - free.values).cwiseAbs().maxCoeff(), 1e-9 * free.values[11]);
}

TEST(KrylovBasisTest, TheDiskHoldsTheSameNumbers) {
  const Eigen::Index n = 3000, b = 4;
  KrylovBasis memory(n, 12), disk(n, 12, Storage::kDisk);
  TallBlock block(n, b);
  for (Eigen::Index k = 0; k < 3; ++k) {
    for (Eigen::Index i = 0; i < n * b; ++i)
      block.data[static_cast<size_t>(i)] = std::sin(0.37 * static_cast<double>(i * (k + 1)));
    memory.put(k * b, block);
    disk.put(k * b, block);
  }
  EXPECT_EQ(memory.columns(12), disk.columns(12));
  const MatrixXd V = memory.columns(12);
  const MatrixXd H = memory.coefficients(2, 9, block);
  const MatrixXd last = V.rightCols(b);
  EXPECT_LT((H - V.middleCols(2, 7).transpose() * last).norm(), 1e-12 * H.norm());
  const MatrixXd S = MatrixXd::Random(12, 5);
  disk.transform(S);
  EXPECT_LT((disk.columns(5) - V * S).norm(), 1e-12 * (V * S).norm());
  memory.subtract(2, H, block);
  RowMatrix left = Eigen::Map<const RowMatrix>(block.row(0), n, b);
  EXPECT_LT((left - (last - V.middleCols(2, 7) * H)).norm(), 1e-12 * left.norm());
}

}  // namespace
}  // namespace clatter::modal
