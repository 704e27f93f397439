// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/integrate/methods.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <memory>
#include <utility>

#include "bench/integrate/exponential.hpp"
#include "bench/integrate/first_order.hpp"
#include "bench/integrate/generalised_alpha.hpp"
#include "bench/integrate/sundials_run.hpp"
#include "core/base/error.hpp"

namespace clatter::bench {

using dynamics::StageState;
using Eigen::VectorXd;

namespace {

struct SundialsMethod {
  const char* name;
  SundialsOptions options;
};
constexpr std::array<SundialsMethod, 7> kSundials{
    {{"cvode", {SundialsSolver::kCvode, 5, true}},
     {"cvode-roots", {SundialsSolver::kCvode, 5, true, true}},
     {"cvode-2", {SundialsSolver::kCvode, 2, true}},
     {"cvode-2-roots", {SundialsSolver::kCvode, 2, true, true}},
     {"ida", {SundialsSolver::kIda, 5, true}},
     {"ida-2", {SundialsSolver::kIda, 2, true}},
     {"ida-displacements", {SundialsSolver::kIda, 5, false}}}};

const std::array<const dynamics::Tableau*, 3> kKernel{&dynamics::tr_bdf2(), &dynamics::sdirk2(),
                                                      &dynamics::predictor_corrector()};

/// Generalised-alpha by its spectral radius at infinite frequency.
constexpr std::array<std::pair<const char*, double>, 2> kTried{
    {{"generalised-alpha-0.8", 0.8}, {"generalised-alpha-0.4", 0.4}}};

/// Impulses change the velocities at the end of a step, so that no cubic leads there.
bool has_events(const dynamics::System& system) {
  for (int e = 0; e < system.elements(); ++e)
    if (system.element(e).events() > 0) return true;
  return false;
}

/// The kernel's methods with steps of one length: its name with this.
constexpr const char* kFixed = "-fixed";

dynamics::StepOptions options_of(const BenchScene& scene, double tolerance) {
  dynamics::StepOptions options = scene.options;
  options.accuracy.tolerance = tolerance;
  return options;
}

Motion run(const BenchScene& scene, std::unique_ptr<dynamics::Integrator> method) {
  method->start(scene.begin, scene.eta, scene.v);
  Motion motion;
  const bool steps_to_samples = has_events(*scene.system);
  for (int sample = 1; sample <= scene.samples;) {
    method->step(steps_to_samples ? scene.sample_time(sample) : scene.end);
    const StageState &from = method->previous(), &to = method->arrived();
    const double length = to.time - from.time;
    for (; sample <= scene.samples && scene.sample_time(sample) <= to.time; ++sample) {
      const double t = (scene.sample_time(sample) - from.time) / length;
      if (steps_to_samples) {
        motion.states.push_back({to.eta, to.v});
        continue;
      }
      motion.states.push_back({dynamics::hermite(from.eta, from.v, to.eta, to.v, length, t),
                               dynamics::hermite(from.v, from.a, to.v, to.a, length, t)});
    }
  }
  const dynamics::StepStatistics& count = method->statistics();
  motion.steps = count.accepted;
  motion.rejected = count.rejected_error + count.rejected_newton + count.rejected_refused;
  motion.evaluations = count.evaluations;
  motion.matrices = count.factorizations;
  motion.events = count.events;
  return motion;
}

Motion by_kernel(const BenchScene& scene, const dynamics::Tableau& table, double tolerance) {
  dynamics::StepOptions options = options_of(scene, tolerance);
  options.method = &table;
  return run(scene, dynamics::make_integrator(*scene.system, options));
}

/// Newton's iteration is as exact as for the scene's own tolerance.
Motion by_fixed_steps(const BenchScene& scene, const dynamics::Tableau& table, double length) {
  dynamics::StepOptions options = scene.options;
  options.method = &table;
  options.fixed = true;
  options.largest = length;
  return run(scene, dynamics::make_integrator(*scene.system, options));
}

/// The kernel's limits of errors (ErrorWeights), for each x.
VectorXd limits(const BenchScene& scene, const FirstOrder& system, double tolerance) {
  const dynamics::System& bodies = *scene.system;
  dynamics::Accuracy accuracy = scene.options.accuracy;
  accuracy.tolerance = tolerance;
  const auto weights = dynamics::error_weights(bodies, accuracy);
  VectorXd eta = VectorXd::Zero(bodies.modes()), v = eta;
  for (int k = 0; k < bodies.modes(); ++k) {
    if (weights.modal_displacement(k) > 0.0) {
      eta(k) = 1.0 / weights.modal_displacement(k);
      v(k) = 1.0 / weights.modal_velocity(k);
    }
  }
  for (int b = 0; b < static_cast<int>(bodies.bodies().size()); ++b) {
    for (size_t i = 0; i < bodies.rows(b).size(); ++i) {
      Eigen::Index state = 0;
      const double reach =
          bodies.P(b).row(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff(&state);
      if (bodies.bodies()[b].is_state(static_cast<int>(state)))
        eta(bodies.mode_offset(b) + state) =
            1.0 / (reach * weights.displacement(bodies.rows(b)[i]));
    }
  }
  return system.state(eta, v);
}

Motion by_sundials(const BenchScene& scene, const SundialsMethod& method, double tolerance) {
  FirstOrder system(*scene.system, method.options.roots_of_contacts);
  scene.system->begin_step(scene.begin);
  SundialsRun run(system, method.options, scene.begin, system.state(scene.eta, scene.v),
                  limits(scene, system, tolerance));
  Motion motion;
  for (int sample = 1; sample <= scene.samples; ++sample) {
    const VectorXd& x = run.advance(scene.sample_time(sample), scene.end);
    motion.states.push_back({x.head(system.modes()), system.velocities(x)});
  }
  const SundialsCounts count = run.counts();
  motion.steps = count.steps;
  motion.rejected = count.rejected;
  motion.evaluations = count.evaluations;
  motion.matrices = count.jacobians;
  motion.events = count.events;
  return motion;
}

}  // namespace

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const dynamics::Tableau* table : kKernel) all.push_back(table->name);
    for (const dynamics::Tableau* table : kKernel) all.push_back(table->name + kFixed);
    for (const auto& [name, rho] : kTried) all.emplace_back(name);
    all.emplace_back("exponential");
    for (const SundialsMethod& method : kSundials) all.emplace_back(method.name);
    return all;
  }();
  return names;
}

Motion integrate(const BenchScene& scene, const std::string& method, double tolerance) {
  for (const dynamics::Tableau* table : kKernel) {
    if (table->name == method) return by_kernel(scene, *table, tolerance);
    if (table->name + kFixed == method) return by_fixed_steps(scene, *table, tolerance);
  }
  for (const auto& [name, rho] : kTried)
    if (name == method)
      return run(scene, std::make_unique<GeneralisedAlpha>(*scene.system,
                                                           options_of(scene, tolerance), rho));
  if (method == "exponential")
    return run(scene, std::make_unique<Exponential>(*scene.system, options_of(scene, tolerance)));
  for (const SundialsMethod& own : kSundials)
    if (own.name == method) return by_sundials(scene, own, tolerance);
  throw InputError(fmt::format("bench: found method {}, expected one of {}", method,
                               fmt::join(method_names(), ", ")));
}

}  // namespace clatter::bench
