// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/sound_build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <deque>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/progress.hpp"
#include "core/sound/boundary_equations.hpp"
#include "core/sound/far_field.hpp"
#include "core/sound/far_harmonics.hpp"
#include "core/sound/field_points.hpp"
#include "core/sound/monopole.hpp"
#include "recover/acoustic/skin_border.hpp"
#include "recover/skin/exposure.hpp"
#include "recover/sound/acoustic_velocity.hpp"
#include "recover/sound/stored_far_field.hpp"

namespace clatter::recover {
namespace {

double decibels(double power, double reference) {
  return std::abs(10.0 * std::log10(power / reference));
}

/// Computes samples, and notes the errors of the boundary elements at each.
class Sampler {
 public:
  /// @param velocity 3 n_f x r, @param flow n_v x r: of the acoustic skin, per coordinate
  Sampler(const sound::Space& space, const Eigen::MatrixXd& velocity, const RowMatrix& flow,
          std::vector<SoundSample> earlier, PartSound& sound)
      : space_(space),
        velocity_(velocity),
        flow_(flow),
        earlier_(std::move(earlier)),
        sound_(sound),
        source_(sound::inner_point(sound.skin, kDepth * sound.skin.mean_edge)) {
    if (!source_) say("acoustic skin: the body is too thin to be checked by a point source inside");
    points_.resize(static_cast<Eigen::Index>(sound.table.microphones.size()), 3);
    for (Eigen::Index m = 0; m < points_.rows(); ++m)
      points_.row(m) = sound.table.microphones[m].position.transpose();
  }

  SoundSample operator()(double frequency_hz) {
    const auto known = std::find_if(
        earlier_.begin(), earlier_.end(),
        [&](const SoundSample& sample) { return sample.frequency_hz == frequency_hz; });
    SoundSample sample = known != earlier_.end() ? std::move(*known) : solved(frequency_hz);
    const sound::SurfaceState state{frequency_hz, velocity_.cast<sound::Complex>(),
                                    sample.pressure.cast<sound::Complex>()};
    sample.H = sound::field_pressure(sound_.skin, space_, state, points_);
    sample.R = far_field_resistance(space_, sample.far, flow_);
    note(sample.checks);
    return sample;
  }

 private:
  /// By boundary elements, without R and H.
  SoundSample solved(double frequency_hz) const {
    const Eigen::Index r = velocity_.cols();
    Eigen::MatrixXcd motions = velocity_.cast<sound::Complex>();
    double exact = 0.0;
    if (source_) {
      const auto check = sound::monopole(sound_.skin, space_, frequency_hz, *source_);
      motions.conservativeResize(Eigen::NoChange, r + 1);
      motions.col(r) = check.velocity;
      exact = check.power;
    }
    const sound::BoundaryEquations equations(sound_.skin, space_, frequency_hz);
    const sound::SurfaceState state = equations.radiate(motions);
    const Eigen::VectorXd power = sound::far_power(sound_.skin, space_, state);
    SoundSample sample{frequency_hz, {}, {}, {}};
    sample.pressure = state.pressure.leftCols(r).cast<std::complex<float>>();
    sample.far =
        stored_far_field(sound::far_harmonics(sound_.skin, space_, equations).of_flow, flow_);
    sample.checks = checks(state, power, far_field_resistance(space_, sample.far, flow_));
    if (source_) check_source(state, exact, power[r], sample.checks);
    return sample;
  }

  /// @param exact, far power of the point source, the last motion of `state`, and that from the far
  /// field in directions
  void check_source(const sound::SurfaceState& state, double exact, double far,
                    SampleChecks& checks) const {
    const sound::SurfaceState last{state.frequency_hz, state.velocity.rightCols(1),
                                   state.pressure.rightCols(1)};
    const double near = sound::surface_power(sound_.skin, last)[0];
    checks.monopole_error = decibels(far, exact);
    checks.surface_power_error = decibels(near, far);
  }

  /// @param power from the far field in directions, of all motions
  SampleChecks checks(const sound::SurfaceState& state, const Eigen::VectorXd& power,
                      const Eigen::MatrixXd& R) const {
    SampleChecks found{.condition = state.condition};
    for (Eigen::Index j = 0; j < velocity_.cols(); ++j)
      if (power[j] > 0.0)
        found.far_field_error = std::max(found.far_field_error, decibels(0.5 * R(j, j), power[j]));
    return found;
  }

  void note(const SampleChecks& checks) {
    SoundCertificate& certificate = sound_.certificate;
    const auto raise = [](std::optional<double>& highest, const std::optional<double>& value) {
      if (value) highest = std::max(highest.value_or(0.0), *value);
    };
    raise(certificate.monopole_error_db, checks.monopole_error);
    raise(certificate.surface_power_error_db, checks.surface_power_error);
    certificate.highest_condition = std::max(certificate.highest_condition, checks.condition);
    certificate.far_field_error_db =
        std::max(certificate.far_field_error_db, checks.far_field_error);
  }

  static constexpr double kDepth = 0.4;  // of the point source, in mean edges

  const sound::Space& space_;
  const Eigen::MatrixXd& velocity_;
  const RowMatrix& flow_;
  std::vector<SoundSample> earlier_;
  PartSound& sound_;
  std::optional<Eigen::Vector3d> source_;
  RowMatrix points_;
};

/// The first frequencies: steps of a factor 2.5 up to steps of a sixth of the range.
std::vector<double> first_grid(const GridRule& rule) {
  std::vector<double> grid{rule.from_hz};
  while (grid.back() < rule.to_hz)
    grid.push_back(std::min(2.5 * grid.back(), grid.back() + rule.to_hz / 6.0));
  grid.back() = rule.to_hz;
  if (const size_t n = grid.size(); n > 2 && grid[n - 1] - grid[n - 2] < rule.to_hz / 18.0)
    grid.erase(grid.end() - 2);
  return grid;
}

void insert(SoundTable& table, SoundSample sample) {
  const auto at = std::find_if(table.samples.begin(), table.samples.end(), [&](const auto& other) {
    return other.frequency_hz > sample.frequency_hz;
  });
  table.samples.insert(at, std::move(sample));
}

void refine(const GridRule& rule, Sampler& sample, PartSound& sound) {
  SoundTable& table = sound.table;
  const std::vector<double> grid = first_grid(rule);
  std::deque<std::pair<double, double>> intervals;
  // A guess: a body of the size of a wavelength or two needs five or six for each of the first
  // ones.
  Progress progress("sound", static_cast<double>(6 * grid.size()), "frequencies");
  const auto compute = [&](double frequency_hz) {
    if (static_cast<int>(table.samples.size()) >= rule.most)
      throw NumericsError(
          fmt::format("sound: {} frequencies do not interpolate within {:g} dB: raise grid.most or "
                      "grid.tolerance_db, or lower grid.to_hz",
                      rule.most, rule.tolerance_db));
    SoundSample computed = sample(frequency_hz);
    progress.update(static_cast<double>(table.samples.size() + 1));
    return computed;
  };
  for (size_t i = 0; i < grid.size(); ++i) {
    insert(table, compute(grid[i]));
    if (i > 0) intervals.emplace_back(grid[i - 1], grid[i]);
  }
  SoundCertificate& certificate = sound.certificate;
  while (!intervals.empty()) {
    const auto [low, high] = intervals.front();
    intervals.pop_front();
    const double middle = 0.5 * (low + high);
    SoundSample computed = compute(middle);
    const SampleErrors errors = interpolation_errors(table, computed);
    insert(table, std::move(computed));
    if (std::max(errors.resistance, errors.microphone) > rule.tolerance_db) {
      intervals.emplace_back(low, middle);
      intervals.emplace_back(middle, high);
      continue;
    }
    certificate.interpolation_error_db =
        std::max(certificate.interpolation_error_db, errors.resistance);
    certificate.microphone_interpolation_error_db =
        std::max(certificate.microphone_interpolation_error_db, errors.microphone);
  }
}

/// int v_j^2 dS of each coordinate [m2].
Eigen::VectorXd squares(const sound::Surface& skin, const Eigen::MatrixXd& velocity) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(velocity.cols());
  for (Eigen::Index c = 0; c < skin.face_count(); ++c) {
    const auto corners = velocity.middleRows(3 * c, 3);
    sum += skin.face_area[c] / 12.0 *
           (corners.colwise().squaredNorm() + corners.colwise().sum().cwiseAbs2()).transpose();
  }
  return sum;
}

Eigen::MatrixXd efficiencies(const SoundTable& table, const Eigen::VectorXd& squares) {
  Eigen::MatrixXd sigma(table.samples.size(), squares.size());
  for (Eigen::Index i = 0; i < sigma.rows(); ++i) {
    const Eigen::MatrixXd& R = table.samples[i].R;
    for (Eigen::Index j = 0; j < squares.size(); ++j)
      sigma(i, j) = squares[j] > 0.0 ? R(j, j) / (table.fluid.impedance() * squares[j]) : 0.0;
  }
  return sigma;
}

void check_limit(const rom::ReducedModel& model, const SoundOptions& options) {
  if (model.valid_to_hz > 0.0 && options.grid.to_hz > model.valid_to_hz)
    throw InputError(fmt::format(
        "{}: grid.to_hz: found {:g}, expected at most {:g}, the limit of the reduced model",
        options.origin, options.grid.to_hz, model.valid_to_hz));
}

/// Edges of the skin with one face, with a warning.
double open_edges(const rom::Skin& skin) {
  const SkinBorder border = skin_border(skin);
  if (border.edges > 0)
    warn(
        fmt::format("skin: open along {} edges, up to {:.3g} m wide: closed by the acoustic skin; "
                    "check it in the sound file",
                    border.edges, border.widest));
  return static_cast<double>(border.edges);
}

/// The microphones of the set, then those of the list.
void place_microphones(const SoundOptions& options, const sound::Surface& skin, SoundTable& table) {
  table.surface = with_context(options.origin, [&] {
    return measurement_surface(options.chosen_set(), skin, options.ground);
  });
  table.microphones = table.surface.microphones;
  for (const Microphone& microphone : options.microphones) {
    for (const Microphone& other : table.surface.microphones)
      if (other.name == microphone.name)
        throw InputError(
            fmt::format("{}: microphone '{}': found in the list and in {}, expected "
                        "different names",
                        options.origin, other.name, name_of(table.surface.set)));
    table.microphones.push_back(microphone);
  }
  table.distance.resize(static_cast<Eigen::Index>(table.microphones.size()));
  for (size_t m = 0; m < table.microphones.size(); ++m) {
    const Microphone& microphone = table.microphones[m];
    sound::require_in_fluid(skin, options.space(),
                            options.origin + ": microphone '" + microphone.name + "'",
                            microphone.position);
    table.distance[static_cast<Eigen::Index>(m)] = (microphone.position - skin.middle).norm();
  }
}

}  // namespace

PartSound part_sound(const rom::ReducedModel& model, const SoundOptions& options, StepClock& clock,
                     const EarlierSamples& earlier) {
  check_limit(model, options);
  const sound::Space space = options.space();
  PartSound out;
  const AcousticSkin skin =
      acoustic_skin(model.skin, options.skin.mesh, space.fluid.sound_speed, options.grid.to_hz);
  out.skin = skin.surface;
  clock.lap("acoustic skin");
  const SkinGeometry geometry = measure_skin(model.skin.nodes, model.skin.triangles);
  out.map =
      velocity_map(model.skin, exposure_of(model.skin, geometry), out.skin, options.skin.lids);
  const Eigen::MatrixXd velocity = out.map.map * Eigen::MatrixXd(model.skin.T);
  out.face_velocity = triangle_means(velocity);
  clock.lap("map of normal velocity");

  SoundTable& table = out.table;
  table.fluid = space.fluid;
  table.ground = space.ground;
  table.flow = out.map.flow;
  place_microphones(options, out.skin, table);
  out.certificate = {.faces = static_cast<double>(out.skin.face_count()),
                     .mesh_limit_hz = sound::mesh_limit_hz(out.skin, space.fluid.sound_speed,
                                                           options.skin.mesh.edges_per_wavelength),
                     .shape_error = skin.shape_error,
                     .lid_area_m2 = out.map.lid_area,
                     .open_edges = open_edges(model.skin),
                     .map_flux_error = out.map.errors.flux,
                     .map_velocity_error = out.map.errors.velocity};
  say(
      fmt::format("acoustic skin: {} faces, {:.4g} m2, of it lids {:.3g} m2 over openings up to "
                  "{:.3g} m; good to {:.4g} Hz",
                  out.skin.face_count(), out.skin.area, out.map.lid_area, skin.opening,
                  out.certificate.mesh_limit_hz));
  const std::vector<int32_t> one(static_cast<size_t>(model.skin.triangles.rows()), 0);
  const rom::SkinRows T(model.skin.T);
  const RowMatrix flow =
      group_flows(table.flow, model.skin.triangles, T, one, 1, out.skin.node_count()).front();
  std::vector<SoundSample> known = earlier ? earlier(out) : std::vector<SoundSample>();
  if (!known.empty())
    say(fmt::format("{} frequencies of the earlier file are taken over", known.size()));
  Sampler sampler(space, velocity, flow, std::move(known), out);
  refine(options.grid, sampler, out);
  out.efficiency = efficiencies(table, squares(out.skin, velocity));
  clock.lap("boundary elements");
  return out;
}

}  // namespace clatter::recover
