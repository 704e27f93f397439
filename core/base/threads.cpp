// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/threads.hpp"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace clatter {
namespace {

int chosen_count = 0;

/// Threads that wait for pieces. The caller takes pieces as well, and waits only for those that
/// others have begun: on a busy machine, where a thread may not run for milliseconds, it does all.
class Crew {
 public:
  static Crew& of_the_process() {
    static Crew* const crew = new Crew;  // its threads wait until the process ends
    return *crew;
  }

  /// Calls run(0) .. run(pieces - 1), which do not throw. Of nested calls, and of several at the
  /// same time, only the first has help.
  void work(int64_t pieces, const std::function<void(int64_t)>& run) {
    if (::getpid() != owner_ || busy_.exchange(true)) {
      for (int64_t piece = 0; piece < pieces; ++piece) run(piece);
      return;
    }
    std::unique_lock lock(mutex_);
    grow(pieces - 1);
    run_ = &run;
    next_ = 0;
    pieces_ = pieces;
    wake_.notify_all();
    take(lock);
    done_.wait(lock, [&] { return running_ == 0; });
    busy_ = false;
  }

 private:
  void grow(int64_t threads) {
    try {
      for (; size_ < threads; ++size_) std::thread(&Crew::wait, this).detach();
    } catch (const std::system_error&) {
      // A limit of threads or of memory: there are less (hard case P14).
    }
  }
  void wait() {
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait(lock, [&] { return next_ < pieces_; });
      take(lock);
      if (running_ == 0) done_.notify_one();
    }
  }
  void take(std::unique_lock<std::mutex>& lock) {
    while (next_ < pieces_) {
      const int64_t piece = next_++;
      ++running_;
      lock.unlock();
      (*run_)(piece);
      lock.lock();
      --running_;
    }
  }

  const pid_t owner_ = ::getpid();
  std::atomic<bool> busy_{false};
  std::mutex mutex_;
  std::condition_variable wake_, done_;
  const std::function<void(int64_t)>* run_ = nullptr;
  int64_t pieces_ = 0, next_ = 0, running_ = 0, size_ = 0;
};

}  // namespace

void set_thread_count(int count) { chosen_count = std::max(0, count); }

int thread_count() {
  if (chosen_count > 0) return chosen_count;
  static const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return cores;
}

void parallel_pieces(int64_t n, const std::function<void(int64_t, int64_t)>& body) {
  const int64_t pieces = std::min<int64_t>(thread_count(), n);
  if (pieces <= 1) {
    if (n > 0) body(0, n);
    return;
  }
  std::vector<std::exception_ptr> failures(static_cast<size_t>(pieces));
  Crew::of_the_process().work(pieces, [&](int64_t piece) {
    try {
      body(n * piece / pieces, n * (piece + 1) / pieces);
    } catch (...) {
      failures[piece] = std::current_exception();
    }
  });
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
      failures[k] = std::current_exception();
    }
  };
  static tbb::task_arena arena(thread_count());
  arena.execute([&] { tbb::parallel_for(0, count, run, tbb::simple_partitioner()); });
  for (const auto& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace clatter
