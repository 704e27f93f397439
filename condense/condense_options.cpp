// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/condense_options.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clatter::condense {
namespace {

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
        key.number("verify_hz", options.verify_hz, Range::not_negative(),
                   "compares with modes of the full model up to this frequency, which costs their "
                   "computation, and puts the largest error and the smallest MAC into the "
                   "certificate; 0 for up to accurate_to_hz");
        key.part(static_cast<sparse::EigenChoice&>(modes), sparse::eigen_choice_keys());
        key.texts("skin", options.skin,
                  "names of surfaces whose displacement can be recovered, [] for none");
        key.texts("rows", options.rows,
                  "names of further sets whose displacement can be recovered, as of sensors");
        key.flag("inertia_invariants", options.inertia_invariants,
                 "whether the file has the shape integrals that a body with a rotating or "
                 "accelerating frame needs");
        key.flag("joined_error", options.joined_error,
                 "whether the file has what an assembly of reduced parts needs to estimate the "
                 "error of its frequencies by the modes that this part lacks; costs some three "
                 "solves for each coordinate of the boundary")
            .excludes("interface");
        key.tables("modal_damping", options.damping_rows, damping_row_keys());
        key.table("interface", options.interface, interface_keys());
        key.check(finish);
      });
  return keys;
}

}  // namespace clatter::condense
