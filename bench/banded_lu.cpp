// SPDX-License-Identifier: GPL-3.0-or-later
// BandedLu of the film compared with LAPACK's dgbtrf and dgbtrs: microseconds of a factorisation
// and of the solves of one step (one right-hand side, then 40 of the sensitivities), and their
// difference.
//   banded_lu [repeats]
#include <lapack.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "bench/median.hpp"
#include "dynamics/film/banded_lu.hpp"

namespace {

using clatter::film::BandedLu;

/// Entries of a film matrix of `band` cells by n / band rows: five points, column-diagonally
/// dominant.
struct FilmMatrix {
  int n, band;
  std::vector<double> off, diagonal;  // couplings of cell i to i + 1 and i + band

  FilmMatrix(int rows, int band_width) : n(rows * band_width), band(band_width) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> value(0.1, 1.0);
    off.resize(2 * static_cast<size_t>(n));
    diagonal.assign(n, 0.05);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 2; ++k) {
        const int j = i + (k == 0 ? 1 : band);
        if (j >= n) continue;
        const double a = value(random);
        off[2 * static_cast<size_t>(i) + static_cast<size_t>(k)] = a;
        diagonal[i] += a;
        diagonal[j] += a;
      }
  }
  template <class Put>
  void fill(Put&& put) const {
    for (int i = 0; i < n; ++i) {
      put(i, i, diagonal[i]);
      for (int k = 0; k < 2; ++k) {
        const int j = i + (k == 0 ? 1 : band);
        if (j >= n || (k == 1 && band == 1)) continue;
        const double a = -off[2 * static_cast<size_t>(i) + static_cast<size_t>(k)];
        put(i, j, a);
        put(j, i, a);
      }
    }
  }
};

void compare(int rows, int band, int repeats) {
  constexpr int kRight = 40;
  const FilmMatrix A(rows, band);
  const int n = A.n, lead = 3 * band + 1, one = 1, right = kRight;
  int info = 0;

  BandedLu own(n, band);
  std::vector<double> own_x(static_cast<size_t>(n) * kRight, 1.0),
      own_y(static_cast<size_t>(n), 1.0);
  const double own_us = median_us(repeats, 0, [&] {
    own.set_zero();
    A.fill([&](int i, int j, double a) { own.at(i, j) = a; });
    if (!own.factor()) std::abort();
    std::fill(own_y.begin(), own_y.end(), 1.0);
    own.solve(own_y.data());
    std::fill(own_x.begin(), own_x.end(), 1.0);
    own.solve_rows(own_x.data(), kRight);
  });

  std::vector<double> ab(static_cast<size_t>(lead) * static_cast<size_t>(n)),
      y(static_cast<size_t>(n));
  std::vector<double> x(static_cast<size_t>(n) * kRight);
  std::vector<int> pivots(static_cast<size_t>(n));
  const double lapack_us = median_us(repeats, 0, [&] {
    std::fill(ab.begin(), ab.end(), 0.0);
    A.fill([&](int i, int j, double a) {
      ab[static_cast<size_t>(j) * static_cast<size_t>(lead) +
         static_cast<size_t>(2 * band + i - j)] = a;
    });
    LAPACK_dgbtrf(&n, &n, &band, &band, ab.data(), &lead, pivots.data(), &info);
    std::fill(y.begin(), y.end(), 1.0);
    LAPACK_dgbtrs("N", &n, &band, &band, &one, ab.data(), &lead, pivots.data(), y.data(), &n,
                  &info);
    std::fill(x.begin(), x.end(), 1.0);
    LAPACK_dgbtrs("N", &n, &band, &band, &right, ab.data(), &lead, pivots.data(), x.data(), &n,
                  &info);
  });
  double difference = 0.0, size = 0.0;
  for (int i = 0; i < n; ++i) {
    difference = std::max(difference, std::abs(own_y[i] - y[i]));
    size = std::max(size, std::abs(y[i]));
  }
  std::printf("| %d x %d | %d | %.0f | %.0f | %.2f | %.0e |\n", rows, band, n, own_us, lapack_us,
              lapack_us / own_us, difference / size);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 201;
  std::puts("| cells | unknowns | BandedLu [us] | dgbtrf, dgbtrs [us] | ratio | difference |");
  std::puts("|---|---|---|---|---|---|");
  for (const auto& [rows, band] : {std::pair{20, 6}, {20, 12}, {40, 12}, {40, 24}, {80, 48}})
    compare(rows, band, repeats);
}
