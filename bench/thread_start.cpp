// SPDX-License-Identifier: GPL-3.0-or-later
// parallel_pieces, whose threads sleep between calls, compared with OpenMP's, which spin for a
// while: microseconds of a loop over n doubles, after a pause in which waiting threads fall asleep,
// and one directly after another.
//   thread_start [repeats]
#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "bench/median.hpp"
#include "core/base/threads.hpp"

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 201;
  std::puts("| doubles | pause [ms] | one thread [us] | parallel_pieces [us] | OpenMP [us] |");
  std::puts("|---|---|---|---|---|");
  for (const int64_t n : {int64_t{1000}, int64_t{100000}, int64_t{10000000}}) {
    std::vector<double> x(static_cast<size_t>(n), 1.0);
    const auto piece = [&](int64_t begin, int64_t end) {
      for (int64_t i = begin; i < end; ++i) x[i] = 0.5 * x[i] + 1.0;
    };
    for (const int pause : {0, 5000}) {
      const int runs = n > 1000000 ? std::min(repeats, 31) : repeats;
      const double one = median_us(runs, pause, [&] { piece(0, n); });
      const double own = median_us(runs, pause, [&] { clatter::parallel_pieces(n, piece); });
      const double open_mp = median_us(runs, pause, [&] {
#pragma omp parallel
        {
          const int64_t count = omp_get_num_threads(), mine = omp_get_thread_num();
          piece(n * mine / count, n * (mine + 1) / count);
        }
      });
      std::printf("| %lld | %d | %.1f | %.1f | %.1f |\n", static_cast<long long>(n), pause / 1000,
                  one, own, open_mp);
    }
  }
}
