// SPDX-License-Identifier: GPL-3.0-or-later
// One scene by one integrator at one tolerance: CPU seconds of the integration, counts, and the
// values that are compared at equal distances in time, as one line of JSON.
//   integrate_scene SCENE METHOD TOLERANCE [RUNS]
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "bench/integrate/methods.hpp"
#include "bench/integrate/scenes.hpp"

int main(int argc, char** argv) {
  using namespace clatter::bench;
  if (argc < 4) {
    fmt::print(stderr, "integrate_scene SCENE METHOD TOLERANCE [RUNS]\nscenes: {}\nmethods: {}\n",
               fmt::join(scene_names(), " "), fmt::join(method_names(), " "));
    return 2;
  }
  const int runs = argc > 4 ? std::max(1, std::atoi(argv[4])) : 1;
  try {
    std::vector<double> seconds;
    Motion motion;
    BenchScene scene;
    for (int r = 0; r < runs; ++r) {
      scene = make_scene(argv[1]);
      const std::clock_t begin = std::clock();
      motion = integrate(scene, argv[2], std::atof(argv[3]));
      seconds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
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
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
}
