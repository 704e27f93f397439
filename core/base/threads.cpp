// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/threads.hpp"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace clatter {
namespace {

int chosen_count = 0;

}  // namespace

void set_thread_count(int count) { chosen_count = std::max(0, count); }

int thread_count() {
  if (chosen_count > 0) return chosen_count;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_pieces(int64_t n, const std::function<void(int64_t, int64_t)>& body) {
  const int64_t pieces = std::min<int64_t>(thread_count(), n);
  if (pieces <= 1) {
    if (n > 0) body(0, n);
    return;
  }
  std::vector<std::exception_ptr> failures(static_cast<size_t>(pieces));
  const auto run = [&](int64_t piece) {
    try {
      body(n * piece / pieces, n * (piece + 1) / pieces);
    } catch (...) {
      failures[static_cast<size_t>(piece)] = std::current_exception();
    }
  };
  std::vector<std::thread> workers;
  workers.reserve(static_cast<size_t>(pieces));
  int64_t started = 1;
  try {
    for (; started < pieces; ++started) workers.emplace_back(run, started);
  } catch (const std::system_error&) {
    // A limit of threads or of memory: the others run here (hard case P14).
  }
  run(0);  // on this thread: one thread less to start
  for (; started < pieces; ++started) run(started);
  for (auto& worker : workers) worker.join();
  for (const auto& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

void parallel_tasks(int count, const std::function<void(int)>& task) {
  if (count <= 1 || thread_count() == 1) {
    for (int k = 0; k < count; ++k) task(k);
    return;
  }
  std::vector<std::exception_ptr> failures(static_cast<size_t>(count));
  const auto run = [&](int k) {
    try {
      task(k);
    } catch (...) {
      failures[static_cast<size_t>(k)] = std::current_exception();
    }
  };
  static tbb::task_arena arena(thread_count());
  arena.execute([&] { tbb::parallel_for(0, count, run, tbb::simple_partitioner()); });
  for (const auto& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace clatter
