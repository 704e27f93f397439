// SPDX-License-Identifier: GPL-3.0-or-later
// Short tasks on waiting threads.
#include "core/base/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace clatter {
namespace {

/// Restores the count for the tests after.
struct ThreadCount {
  explicit ThreadCount(int count) { set_thread_count(count); }
  ~ThreadCount() { set_thread_count(0); }
};

TEST(ParallelTasks, AreEachDoneOnce) {
  for (const int threads : {1, 2}) {
    const ThreadCount count(threads);
    std::vector<std::atomic<int>> done(50);
    parallel_tasks(50, [&](int k) { ++done[k]; });
    for (const auto& times : done) EXPECT_EQ(times, 1);
  }
}

TEST(ParallelTasks, TheFirstTasksExceptionIsRethrownWhicheverComesFirst) {
  const ThreadCount count(2);
  for (const int late : {0, 1}) {
    try {
      parallel_tasks(2, [&](int k) {
        if (k == late) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        throw std::runtime_error(std::to_string(k));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "0");
    }
  }
}

}  // namespace
}  // namespace clatter
