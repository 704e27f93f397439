// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the tests on all ranks of mpirun; the ranks agree on each result.
#include <gtest/gtest.h>

#include "tests/core/ranks/all_ranks.hpp"

namespace {

const clatter::ranks::Ranks* everyone = nullptr;

/// Only rank 0 prints what passes.
void keep_rank_zero_talking(const clatter::ranks::Ranks& all) {
  auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
  if (all.rank() > 0) delete listeners.Release(listeners.default_result_printer());
}

}  // namespace

const clatter::ranks::Ranks& clatter::test::all_ranks() { return *everyone; }

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return clatter::ranks::run_ranks("ranks_test", argc, argv, [](const clatter::ranks::Ranks& all) {
    everyone = &all;
    keep_rank_zero_talking(all);
    const double failed = RUN_ALL_TESTS();
    return all.sum(failed) > 0.0 ? 1 : 0;
  });
}
