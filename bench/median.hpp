// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Wall time of a piece of code.
#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

/// Median of `repeats` runs [us], each after a pause [us].
template <class Run>
double median_us(int repeats, int pause_us, Run&& run) {
  std::vector<double> times;
  for (int r = 0; r < repeats; ++r) {
    if (pause_us > 0) std::this_thread::sleep_for(std::chrono::microseconds(pause_us));
    const auto begin = std::chrono::steady_clock::now();
    run();
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
    times.push_back(time.count());
  }
  std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
  return times[repeats / 2];
}
