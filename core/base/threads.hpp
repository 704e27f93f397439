// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Thread count of clatter's own loops, and the parallel loops.
#include <cstdint>
#include <functional>

namespace clatter {

/// Sets the count for the process; 0 means all cores.
void set_thread_count(int count);
int thread_count();

/// Calls body(begin, end) on contiguous pieces of [0, n), as many as threads. The pieces depend
/// only on n and the thread count, so results do too; which thread runs a piece, and how many run
/// at the same time, does not: pieces must not wait for each other. An exception in any piece is
/// rethrown.
void parallel_pieces(int64_t n, const std::function<void(int64_t begin, int64_t end)>& body);

/// Calls task(0) .. task(count - 1). A waiting thread takes what the caller has not begun, so short
/// tasks (tens of microseconds) gain on an idle machine and lose little on a busy one. Of several
/// exceptions that of the first task is rethrown. The number of threads is that of the first call,
/// or one.
void parallel_tasks(int count, const std::function<void(int task)>& task);

}  // namespace clatter
