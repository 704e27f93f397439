// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ranks/rank_share.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/blas_kernel.hpp"
#include "core/base/log.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/threads.hpp"

namespace clatter::ranks {

void set_rank_share(const Ranks& ranks, const CommonOptions& common) {
  const int threads =
      common.threads > 0 ? common.threads : std::max(1, thread_count() / ranks.on_this_machine());
  const double limit = memory_limit_gib();
  set_memory_limit_gib(0.0);
  const double machine = memory_limit_gib();
  set_memory_limit_gib(limit < machine ? limit : machine / ranks.on_this_machine());
  set_thread_count(threads);
  set_blas_threads(threads);
  say(fmt::format("{} ranks, {} on this machine, threads of each: {}", ranks.size(),
                  ranks.on_this_machine(), threads));
}

}  // namespace clatter::ranks
