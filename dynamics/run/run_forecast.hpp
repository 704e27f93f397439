// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a run will cost, effect by effect, before it is made.
#include <filesystem>
#include <optional>
#include <string>

#include "dynamics/component/effects.hpp"
#include "dynamics/integrate/statistics.hpp"
#include "dynamics/run/bodies.hpp"
#include "dynamics/run/model.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

/// Predicted cost of a complete run.
struct RunForecast {
  EffectTable effects;             // with seconds and evaluations
  StepStatistics statistics;       // steps, evaluations, seconds of stepping
  double other_seconds = 0.0;      // of elements that no row of the table counts
  double processor_seconds = 0.0;  // of all threads, of a probe; 0: not known
  std::string source;              // how it was predicted, one sentence
};

/// Limits of a probe.
struct ProbeLimits {
  int sections = 24;     // of the first cycle, or of the span
  double share = 0.1;    // of each section with the steps of the run that are counted
  double settle = 0.1;   // of each section before it, in such steps that are not
  int coarser = 4;       // times as long the steps between
  int least_steps = 8;   // counted in each section
  double seconds = 2.0;  // of the processor, at least granted
  double of_run = 0.05;  // of the seconds predicted for the run, granted if they are more
};

/// Predicts by a probe: integrates the first cycle (a scene without an engine: its span), most of
/// it in steps `coarser` times as long (tolerance times coarser^3, as the methods are of second
/// order), and the last fifth of each section with the steps of the run itself. In the first half
/// of it the errors of the coarse steps, by which a skirt bounces in its film, die out; counts and
/// seconds of each element in the second stand for the section. What is not reached within the
/// limits is taken as what is. Every cycle is taken as the first one. NumericsError when not even
/// the first section succeeds.
RunForecast probe_run(const Scene& scene, const LoadedBodies& bodies,
                      const ProbeLimits& limits = {});

/// The measured cost of the complete run of the same scene and inputs at `path`; empty when there
/// is none. Evaluations of an effect are those of its elements in `model`, the scene's.
std::optional<RunForecast> measured_run(const Scene& scene, const Model& model,
                                        const std::filesystem::path& path);

}  // namespace clatter::dynamics
