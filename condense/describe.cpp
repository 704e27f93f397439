// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/describe.hpp"

#include <fmt/format.h>

#include <cmath>

#include "condense/basis/cutoff_search.hpp"
#include "condense/interface/interface_modes.hpp"

namespace clatter::condense {
namespace {

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
  if (c.frequency_error_parts)
    lines.push_back(
        fmt::format("the modes that its reduced parts lack raise these frequencies by "
                    "at most {:.2g} % (estimated)",
                    100.0 * c.frequency_error_parts.value()));
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
