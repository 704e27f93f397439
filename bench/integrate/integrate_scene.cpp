// SPDX-License-Identifier: GPL-3.0-or-later
// One scene by one integrator at one tolerance: CPU seconds of the integration, counts, and the
// values that are compared at equal distances in time, as one line of JSON.
//   integrate_scene SCENE METHOD TOLERANCE [RUNS]
// SCENE is a name or a file, *.run.toml; TOLERANCE of a method with fixed steps is their length
// [s].
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "bench/integrate/methods.hpp"
#include "bench/integrate/scenes.hpp"
#include "core/base/threads.hpp"

namespace {

using namespace clatter::bench;

/// The clock of CPU time may count in units of 10 ms: a measurement takes at least this long [s].
constexpr double kLeast = 0.1;
constexpr int kMost = 2000;  // integrations in a measurement

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// CPU seconds of one integration, the mean of `count`; `motion` is that of the last.
double measure(const char* name, const std::string& method, double tolerance, int count,
               Motion& motion) {
  std::vector<BenchScene> scenes;
  for (int k = 0; k < count; ++k) scenes.push_back(make_scene(name));
  const double begin = cpu_seconds();
  for (const BenchScene& scene : scenes) motion = integrate(scene, method, tolerance);
  return (cpu_seconds() - begin) / count;
}

void print(const BenchScene& scene, const Motion& motion, const std::vector<double>& seconds) {
  std::vector<std::string> rows;
  for (int sample = 1; sample <= scene.samples; ++sample) {
    const Eigen::VectorXd values =
        scene.observe(scene.sample_time(sample), motion.states[static_cast<size_t>(sample) - 1]);
    rows.push_back(fmt::format("[{:.17g}]", fmt::join(values.begin(), values.end(), ",")));
  }
  fmt::print(
      "{{\"unit\":\"{}\",\"coordinates\":{},\"seconds\":[{}],\"steps\":{},\"rejected\":{},"
      "\"evaluations\":{},\"matrices\":{},\"events\":{},\"values\":[{}]}}\n",
      scene.unit, scene.system->modes(), fmt::join(seconds, ","), motion.steps, motion.rejected,
      motion.evaluations, motion.matrices, motion.events, fmt::join(rows, ","));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "integrate_scene SCENE METHOD TOLERANCE [RUNS]\nscenes: {}\nmethods: {}\n",
               fmt::join(scene_names(), " "), fmt::join(method_names(), " "));
    return 2;
  }
  const char* name = argv[1];
  const std::string method = argv[2];
  const double tolerance = std::atof(argv[3]);
  const int runs = argc > 4 ? std::max(1, std::atoi(argv[4])) : 1;
  clatter::set_thread_count(1);  // CPU seconds count a thread that waits, too
  try {
    Motion motion;
    int count = 1;
    double once = measure(name, method, tolerance, count, motion);
    while (runs > 1 && once * count < kLeast && count < kMost) {
      count = std::min(kMost, 4 * count);
      once = measure(name, method, tolerance, count, motion);
    }
    std::vector<double> seconds{once};
    for (int r = 1; r < runs; ++r)
      seconds.push_back(measure(name, method, tolerance, count, motion));
    print(make_scene(name), motion, seconds);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
}
