// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/condense.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "condense/basis/cutoff_search.hpp"
#include "condense/basis/frame_inertia.hpp"
#include "condense/basis/inertia_force.hpp"
#include "condense/basis/modal_damping.hpp"
#include "condense/certify/certificate.hpp"
#include "condense/rows/recovery_rows.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/fe/free_motions.hpp"

namespace clatter::condense {
namespace {

void report_repeated(const DofPartition& partition) {
  if (partition.repeated.empty()) return;
  warn(fmt::format("boundary: {} DoFs are in two sets and got one coordinate each, the first is {}",
                   partition.repeated.size(), partition.repeated.front()));
}

/// Drops vectors that depend on others; returns how many.
int drop_dependent(CraigBampton& source) {
  ReducedBasis& basis = source.basis;
  const std::vector<int> kept = independent_columns(source.M_rr, basis.boundary());
  const int dropped = static_cast<int>(basis.size()) - static_cast<int>(kept.size());
  if (dropped == 0) return 0;
  warn(fmt::format("{} basis vectors depend on others and were dropped", dropped));
  std::vector<int> modes;
  for (const int j : kept) {
    if (j >= basis.boundary()) modes.push_back(j - static_cast<int>(basis.boundary()));
  }
  source.fixed_interface_hz = source.fixed_interface_hz(modes).eval();
  basis.shapes = basis.shapes(Eigen::all, modes).eval();
  source.M_rr = source.M_rr(kept, kept).eval();
  source.K_rr = source.K_rr(kept, kept).eval();
  return dropped;
}

/// Rigid motions (n x m) in `size` reduced coordinates: their boundary rows; fixed-interface modes
/// do not contribute.
Eigen::MatrixXd boundary_rows(const PartitionedModel& part, const Eigen::MatrixXd& motions,
                              Eigen::Index size) {
  Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(size, motions.cols());
  const auto n_b = static_cast<Eigen::Index>(part.dofs.boundary.size());
  reduced.topRows(n_b) = motions(part.dofs.boundary, Eigen::all);
  return reduced;
}

std::map<std::string, Eigen::VectorXd> reduced_loads(const fe::FeModel& model,
                                                     const DofPartition& dofs,
                                                     const ReducedBasis& basis) {
  std::map<std::string, Eigen::VectorXd> loads;
  for (const auto& [name, load] : model.loads) loads[name] = project_load(load, dofs, basis);
  return loads;
}

/// What follows from several keys.
void finish(const Config& config, CondenseOptions& options) {
  const std::vector<std::string>& boundary = options.boundary;
  ModeRequest& modes = options.modes;
  if (options.method != "guyan" && modes.count == 0 && modes.fmax_hz == 0.0 &&
      modes.accurate_to_hz == 0.0)
    config.fail("fmax_hz", "give fmax_hz, count or accurate_to_hz");
  for (const std::string& name : options.rows)
    if (std::find(boundary.begin(), boundary.end(), name) != boundary.end())
      config.fail("rows", fmt::format("\"{}\" is retained already (boundary)", name));
  if (modes.accurate_to_hz > 0.0 && modes.frequency_error == 0.0)
    config.fail("accurate_to_hz", "needs frequency_error above 0, the error to reach");
  modes.own_modes = options.method == "craig-chang";
  options.modal_damping = damping_table(config, options.damping_rows);
  if (options.interface) choose_sets(config.table("interface"), boundary, *options.interface);
}

/// Whether modes are missing, and their accuracy.
std::string describe_modes(const rom::ReducedCertificate& c) {
  const bool proved = c.count_proved.value() > 0.0, counted = c.count_below.value() >= 0.0;
  const bool amls = c.eigen_frequency_error.has_value();
  const std::string count = fmt::format("inertia counts {:.0f} below {:.1f} Hz",
                                        c.count_below.value(), c.count_limit_hz.value());
  std::string text = "their number is not proved";
  if (proved) {
    text = fmt::format("none is missing ({})", count);
  } else if (counted && amls) {
    text += fmt::format(" ({}, inconclusive within the errors)", count);
  } else {
    text +=
        amls ? " (prove_count = false, or no gap wider than the errors)" : " (prove_count = false)";
  }
  text += fmt::format("; largest residual {:.1e}", c.eigen_residual_max.value());
  if (amls)
    text += fmt::format("; frequencies from above, largest error about {:.1e}",
                        c.eigen_frequency_error.value());
  return text;
}

std::string describe_spectrum(const rom::ReducedCertificate& c) {
  if (c.certified == 0.0) {
    return fmt::format(
        "not certified: rigid modes, spectrum and condition not checked; stiffness "
        "residue {:.1e}",
        c.rigid_stiffness_residue.value());
  }
  return fmt::format(
      "{:.0f} rigid modes, stiffness residue {:.1e}; first elastic mode {:.1f} Hz, "
      "highest frequency {:.4g} Hz; condition of M_rr {:.1e}",
      c.rigid_modes.value(), c.rigid_stiffness_residue.value(), c.first_elastic_hz.value(),
      c.max_frequency_hz.value(), c.condition_M_rr.value());
}

}  // namespace

const keys::Keys<CondenseOptions>& condense_keys() {
  static const keys::Keys<CondenseOptions> keys(
      "rom.toml", "what is retained of a part", [](auto& key, CondenseOptions& options) {
        ModeRequest& modes = options.modes;
        key.choice(
            "method", options.method, {"craig-bampton", "craig-chang", "guyan"},
            "fixed-interface modes, the body's own modes with residual flexibility, or no modes");
        key.texts("boundary", options.boundary,
                  "names of the sets whose coordinates are kept, in their order")
            .required();
        const keys::Values with_modes{"craig-bampton", "craig-chang"};
        const char* guyan = "guyan has no modes";
        key.integer("count", modes.count, Range::between(1.0, 1e6), "the lowest modes, this many")
            .needs("method", with_modes, guyan);
        key.number("fmax_hz", modes.fmax_hz, Range::positive(), "or all below this frequency")
            .needs("method", with_modes, guyan)
            .excludes("count");
        key.number("accurate_to_hz", modes.accurate_to_hz, Range::positive(),
                   "or as many as needed for the body's own frequencies below this to be within "
                   "frequency_error")
            .needs("method", with_modes, guyan)
            .excludes("count")
            .excludes("fmax_hz");
        key.number("frequency_error", modes.frequency_error, Range::between(0.0, 0.1),
                   "relative error of the body's own modes below half the cut-off, or below it "
                   "with own modes, at which residual modes aim; 0 for none");
        key.texts("load_shapes", modes.load_shapes,
                  "names of loads whose static response is added, so that it is exact everywhere");
        key.flag("prove_count", modes.prove_count,
                 "whether a count by inertia proves that no mode is missing");
        key.part(static_cast<sparse::EigenChoice&>(modes), sparse::eigen_choice_keys());
        key.texts("skin", options.skin,
                  "names of surfaces whose displacement can be recovered, [] for none");
        key.texts("rows", options.rows,
                  "names of further sets whose displacement can be recovered, as of sensors");
        key.flag("inertia_invariants", options.inertia_invariants,
                 "whether the file has the shape integrals that a body with a rotating or "
                 "accelerating frame needs");
        key.tables("modal_damping", options.damping_rows, damping_row_keys());
        key.table("interface", options.interface, interface_keys());
        key.check(finish);
      });
  return keys;
}

rom::ReducedModel condense(const fe::FeModel& model, const CondenseOptions& options,
                           StepClock& clock) {
  const PartitionedModel part = partition_model(model, options.boundary);
  clock.lap("partition");
  return condense(part, options, clock);
}

rom::ReducedModel condense(const PartitionedModel& part, const CondenseOptions& options,
                           StepClock& clock) {
  const fe::FeModel& model = part.full;
  report_repeated(part.dofs);
  SkinRecovery recovery(part, options.skin, options.rows);
  StaticPart statics = static_part(part, recovery.unknowns(), clock, options.order);
  SearchedBasis found = options.modes.accurate_to_hz > 0.0
                            ? search_cutoff(part, statics, options.modes, clock)
                            : SearchedBasis{craig_bampton(part, statics, options.modes, clock), {}};
  CraigBampton& source = found.basis;
  const int dropped = drop_dependent(source);

  std::map<std::string, Eigen::VectorXd> loads = reduced_loads(model, part.dofs, source.basis);
  RowMatrix& static_rows = statics.reduction.rows;
  Eigen::MatrixXd gathered;
  if (part.shared) {
    gathered = source.basis.shapes;
    recovery.gather(part, static_rows, gathered);
  }
  const Eigen::MatrixXd& shapes = part.shared ? gathered : source.basis.shapes;
  rom::Skin skin = recovery.recover(static_rows, shapes);
  RecoveredSets rows = recovery.recover_sets(static_rows, shapes);
  rows.sets.insert(part.dofs.sets.begin(), part.dofs.sets.end());
  rows.grids.insert(part.dofs.grids.begin(), part.dofs.grids.end());
  clock.lap("loads and skin rows");
  rom::InertiaInvariants inertia;
  if (options.inertia_invariants) {
    inertia = frame_inertia(part, source.basis);
    clock.lap("inertia invariants");
  }
  Eigen::MatrixXd of_frame;
  if (!part.free.all_free()) of_frame = inertia_force(part, source.basis);
  rom::ReducedModel reduced{.name = model.name,
                            .method = options.method,
                            .n_boundary = static_cast<int>(part.dofs.boundary.size()),
                            .M_rr = source.M_rr,
                            .K_rr = source.K_rr,
                            .alpha = model.alpha,
                            .beta = model.beta,
                            .modal_damping = options.modal_damping,
                            .rigid = boundary_rows(part, model.rigid, source.M_rr.rows()),
                            .inertia_force = std::move(of_frame),
                            .sets = std::move(rows.sets),
                            .grids = std::move(rows.grids),
                            .loads = std::move(loads),
                            .mass = model.mass,
                            .fixed_interface_hz = source.fixed_interface_hz,
                            .valid_to_hz = source.interior.cutoff_hz,
                            .skin = std::move(skin),
                            .inertia = std::move(inertia),
                            .combined = std::move(rows.combined),
                            .recovered_sets = std::move(rows.names),
                            .elimination = statics.order,
                            .certificate = {},
                            .deck = model.deck};
  if (found.search.tried > 0) record(found.search, reduced.certificate);
  Eigen::MatrixXd motions = boundary_rows(part, part.free.q, reduced.size());
  if (options.interface) {
    ReducedInterface interface =
        reduce_interface(reduced, *options.interface, motions, fe::characteristic_length(model),
                         source.interior.accurate_to_hz);
    reduced = std::move(interface.model);
    motions = std::move(interface.motions);
    record(interface.report, reduced.certificate);
    clock.lap(fmt::format("{} interface modes", interface.report.modes));
  }
  certify(reduced, part, source, {motions, part.free.all_free()}, dropped, options.certificate);
  clock.lap("certificate");
  return reduced;
}

std::vector<std::string> describe(const rom::ReducedModel& reduced) {
  const rom::ReducedCertificate& c = reduced.certificate;
  const Eigen::Index n_k = reduced.fixed_interface_hz.size();
  const Eigen::Index n_z = reduced.size() - reduced.n_boundary - n_k;
  std::vector<std::string> lines;
  const bool own = reduced.method == "craig-chang";
  const std::string loads = c.load_shapes.value() > 0.0
                                ? fmt::format(" + {:.0f} load shapes", c.load_shapes.value())
                                : std::string{};
  const double shapes = static_cast<double>(n_k) - c.residual_modes.value() - c.load_shapes.value();
  const std::string interface = n_z > 0 ? fmt::format(" + {} interface modes", n_z) : std::string{};
  lines.push_back(fmt::format(
      "{}: {} boundary coordinates{} + {:.0f} {}{} + {:.0f} residual modes = {} ({})", reduced.name,
      reduced.n_boundary, interface, shapes, own ? "shapes of own modes" : "fixed-interface modes",
      loads, c.residual_modes.value(), reduced.size(), reduced.method));
  const std::string accuracy =
      c.frequency_error_estimate
          ? fmt::format("frequencies up to {:.0f} Hz within {:.2g} % (estimated)",
                        c.accurate_to_hz.value(), 100.0 * c.frequency_error_estimate.value())
          : std::string("errors not estimated (--no-certificate, frequency_error = 0)");
  lines.push_back(fmt::format("basis holds modes to {:.0f} Hz; {}", c.cutoff_hz.value(), accuracy));
  if (c.cutoffs_tried) lines.push_back(cutoff_line(c));
  if (n_k > 0)
    lines.push_back((own ? "own modes: " : "fixed-interface modes: ") + describe_modes(c));
  if (c.interface_modes) lines.push_back(interface_line(c));
  lines.push_back(describe_spectrum(c));
  if (c.mass_error) {
    lines.push_back(
        fmt::format("mass {:.6g} kg, ten mass properties within {:.1e} of the full model",
                    reduced.mass.mass, c.mass_error.value()));
  }
  if (!reduced.modal_damping.empty()) {
    const rom::DampingTable& table = reduced.modal_damping;
    lines.push_back(
        fmt::format("modal damping by table, {} rows, ratios {:g} to {:g}{}", table.hz.size(),
                    table.ratio.minCoeff(), table.ratio.maxCoeff(),
                    reduced.alpha > 0.0 || reduced.beta > 0.0 ? "; alpha and beta add to it" : ""));
  }
  return lines;
}

JsonMembers json_of(const rom::ReducedModel& reduced) {
  const auto& c = reduced.certificate;
  return {{"method", json_text(reduced.method)},
          {"boundary", json_number(reduced.n_boundary)},
          {"size", json_number(reduced.size())},
          {"valid_to_hz", json_number(reduced.valid_to_hz)},
          {"count_proved", json_number(c.count_proved.value())},
          {"rigid_modes", json_number(c.rigid_modes.value_or(std::nan("")))},
          {"certified", json_number(c.certified.value())}};
}

}  // namespace clatter::condense
