// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/run_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/units.hpp"
#include "dynamics/run/uniform_samples.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kLarge = kBytesPerGib;  // from here on the size is reported

/// Gap, pressure, fill and contact pressure of a cell, in single precision.
constexpr double kBytesOfFilmCell = 4.0 * 4.0;

}  // namespace

RunSize predict_size(const Scene& scene, const LoadedBodies& bodies) {
  const double cycle = scene.clock ? scene.clock->cycle() : scene.time.end - scene.time.begin;
  const double span = scene.time.recorded * cycle;
  RunSize size;
  const int64_t of_cycle = sample_count(cycle, scene.time.output_step);
  size.samples = scene.time.recorded * (of_cycle - 1) + 1;
  int64_t modes = 0, film_cells = 0;
  for (const auto& component : scene.components) {
    modes += component->traits().modes;
    film_cells += component->traits().film_cells;
  }
  for (const auto& body : bodies) {
    size.coordinates += body.model.size();
    modes += body.modal.modes();
  }
  // q, v and a of each coordinate, time and angle; eta and v of the cycle before and, while another
  // one follows, of this cycle.
  const int64_t checkpoints = scene.clock ? std::min(scene.time.cycles - 1, 2) : 0;
  int64_t numbers = 3 * size.coordinates + 2;
  for (const ForceRecordSpec& force : scene.forces)
    if (const LoadedBody* body = find_body(bodies, force.body)) numbers += body->model.size();
  size.sample_bytes = 8.0 * (static_cast<double>(size.samples) * static_cast<double>(numbers) +
                             static_cast<double>(of_cycle * checkpoints * 2 * modes));
  if (film_cells > 0 && scene.film_every > 0.0) {
    size.film_fields = std::llround(std::ceil(span / scene.film_every));
    size.film_bytes =
        static_cast<double>(size.film_fields) * kBytesOfFilmCell * static_cast<double>(film_cells);
  }
  return size;
}

std::string check_size(const Scene& scene, const RunSize& size, const std::filesystem::path& output,
                       double free_bytes) {
  const auto text = [](double bytes) { return memory_text(bytes / kBytesPerGib); };
  const double all = size.sample_bytes + size.film_bytes;
  std::string needs = fmt::format("{} samples of {} coordinates need {}", size.samples,
                                  size.coordinates, text(size.sample_bytes));
  if (size.film_bytes > 0.1 * size.sample_bytes)
    needs += fmt::format(", {} film fields {}", size.film_fields, text(size.film_bytes));
  if (all > free_bytes) {
    const bool film = size.film_bytes > size.sample_bytes;
    const double found =
        film ? scene.film_every * scene.clock->speed / kDegree : scene.time.output_step / kMicro;
    throw FileError(fmt::format("{}: found {:g}: {}, and {} has {} free, expected at least {:.3g}",
                                film ? scene.time.film_every_where : scene.time.output_step_where,
                                found, needs, output.string(), text(free_bytes),
                                found * 1.1 * all / std::max(free_bytes, 1.0)));
  }
  if (all < kLarge) return "";
  return fmt::format("{}: {} (time.output_step_us = {:g})", output.string(), needs,
                     scene.time.output_step / kMicro);
}

std::string check_size(const Scene& scene, const RunSize& size,
                       const std::filesystem::path& output) {
  const auto folder = std::filesystem::absolute(output).parent_path();
  std::error_code unknown;
  const std::filesystem::space_info space = std::filesystem::space(folder, unknown);
  return check_size(scene, size, output, unknown ? INFINITY : static_cast<double>(space.available));
}

}  // namespace clatter::dynamics
