// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/modes/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/base/error.hpp"
#include "core/dense/qr.hpp"
#include "core/modes/analysis.hpp"

namespace clatter::modes {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNear = 5e-3;  // modes this near (relative) are compared as one subspace

/// Rows of both models for the same displacements.
struct CommonRows {
  MatrixXd full;     // rows x n modes
  MatrixXd reduced;  // rows x m modes
};

using Place = std::tuple<double, double, double>;

/// Skin nodes are copies of the full model's nodes, so coordinates are compared exactly.
std::vector<std::pair<Index, Index>> shared_nodes(const RowMatrix& full, const RowMatrix& skin) {
  std::map<Place, Index> at;
  for (Index a = 0; a < full.rows(); ++a) at.emplace(Place(full(a, 0), full(a, 1), full(a, 2)), a);
  std::vector<std::pair<Index, Index>> pairs;
  for (Index a = 0; a < skin.rows(); ++a) {
    const auto found = at.find(Place(skin(a, 0), skin(a, 1), skin(a, 2)));
    if (found != at.end()) pairs.emplace_back(found->second, a);
  }
  return pairs;
}

/// DoF pairs of displacement coordinates in sets of the same name.
std::vector<std::pair<Index, Index>> shared_coordinates(const fe::FeModel& full,
                                                        const rom::ReducedModel& reduced) {
  std::vector<std::pair<Index, Index>> pairs;
  for (const auto& [name, set] : reduced.sets) {
    const auto other = full.sets.find(name);
    if (other == full.sets.end() || other->second.dofs.size() != set.dofs.size()) continue;
    for (size_t k = 0; k < set.dofs.size(); ++k) {
      if (k < set.is_rotation.size() && set.is_rotation[k] != 0) continue;
      pairs.emplace_back(other->second.dofs[k], set.dofs[k]);
    }
  }
  return pairs;
}

CommonRows common_rows(const fe::FeModel& full, const PartModes& full_modes,
                       const rom::ReducedModel& reduced, const PartModes& reduced_modes) {
  const auto nodes = shared_nodes(full.nodes, reduced.skin.nodes);
  const auto coordinates = shared_coordinates(full, reduced);
  const auto count = static_cast<Index>(3 * nodes.size() + coordinates.size());
  if (count == 0) {
    throw InputError(fmt::format("{} and {}: found no node or set in both, expected the same part",
                                 full.name, reduced.name));
  }
  CommonRows rows{MatrixXd(count, full_modes.modes.size()),
                  MatrixXd(count, reduced_modes.modes.size())};
  const MatrixXd full_shapes = full_modes.shapes(0, full_modes.modes.size());
  const MatrixXd reduced_shapes = reduced_modes.shapes(0, reduced_modes.modes.size());
  Index row = 0;
  for (const auto& [a, b] : nodes) {
    rows.full.middleRows(row, 3) = full_shapes.middleRows(3 * a, 3);
    rows.reduced.middleRows(row, 3) = reduced_shapes.middleRows(3 * b, 3);
    row += 3;
  }
  for (const auto& [p, q] : coordinates) {
    rows.full.row(row) = full_modes.modes.vectors.row(p);
    rows.reduced.row(row) = reduced.row_of(static_cast<int>(q)) * reduced_modes.modes.vectors;
    ++row;
  }
  return rows;
}

double subspace_mac(const VectorXd& shape, const MatrixXd& basis) {
  return (dense::qr(basis).Q.transpose() * shape).squaredNorm() / shape.squaredNorm();
}

/// |x^T y|^2 / (|x|^2 |y|^2) of the columns of both (Allemang and Brown 1982).
MatrixXd mac_of(const Eigen::Ref<const MatrixXd>& full, const Eigen::Ref<const MatrixXd>& reduced) {
  return (full.colwise().normalized().transpose() * reduced.colwise().normalized()).cwiseAbs2();
}

/// Reduced modes near `hz`, always including `partner`.
std::vector<int> near_modes(const VectorXd& hz_of, double hz, int rigid, int partner) {
  std::vector<int> near;
  for (int j = rigid; j < hz_of.size(); ++j) {
    if (j == partner || std::abs(hz_of[j] - hz) <= kNear * hz) near.push_back(j);
  }
  return near;
}

/// The unpaired reduced mode with the most similar shape within 5 % of the frequency; by order when
/// none is similar.
int find_partner(const CommonRows& rows, const VectorXd& hz_of, double hz, int j,
                 std::vector<char>& taken) {
  int best = -1;
  double likeness = 0.5;
  const VectorXd shape = rows.full.col(j).normalized();
  for (int k = 0; k < hz_of.size(); ++k) {
    if (taken[k] != 0 || std::abs(hz_of[k] - hz) > 0.05 * hz) continue;
    const double mac = std::pow(shape.dot(rows.reduced.col(k).normalized()), 2);
    if (mac <= likeness) continue;
    best = k;
    likeness = mac;
  }
  if (best < 0) return j;
  taken[best] = 1;
  return best;
}

ModesOptions request(const CompareOptions& options, const rom::ReducedModel& reduced) {
  ModesOptions modes;
  modes.count = options.count;
  if (options.count > 0) return modes;
  const double stated = reduced.certificate.accurate_to_hz.value_or(0.0);
  modes.fmax_hz =
      options.fmax_hz > 0.0 ? options.fmax_hz : (stated > 0.0 ? stated : reduced.valid_to_hz);
  return modes;
}

/// @param analyse_full gives modes of the full model.
template <class Analyse>
[[noreturn]] void refuse_nothing(const fe::FeModel& full, const ModesOptions& requested, int rigid,
                                 const Analyse& analyse_full) {
  ModesOptions first;
  first.count = rigid + 1;
  const PartModes found = analyse_full(first);
  const std::string range = requested.count > 0
                                ? fmt::format("among the {} lowest", requested.count)
                                : fmt::format("below {:.6g} Hz", requested.fmax_hz);
  throw NothingCompared(fmt::format(
      "{}: nothing was compared: found no elastic mode {} (the first is at {:.6g} Hz{}), expected "
      "a larger --fmax-hz or --count",
      full.name, range, found.modes.frequencies_hz()[rigid],
      rigid > 0 ? fmt::format(", after {} rigid ones", rigid) : ""));
}

/// The modes for which `keep(full_hz)` is true.
template <class Keep>
Comparison part_of(const Comparison& comparison, const Keep& keep) {
  Comparison part = comparison;
  std::erase_if(part.modes, [&](const ComparedMode& mode) { return !keep(mode.full_hz); });
  return part;
}

std::string sum_of(const Comparison& part, const std::string& which) {
  return fmt::format(
      "{} elastic ones{}: largest error {:.2e} %, smallest MAC {:.6f} on {} "
      "displacements",
      part.modes.size(), which, 100.0 * part.largest_error(), part.smallest_mac(), part.rows);
}

}  // namespace

double Comparison::largest_error() const {
  double largest = 0.0;
  for (const ComparedMode& mode : modes) largest = std::max(largest, std::abs(mode.error));
  return largest;
}

double Comparison::smallest_mac() const {
  double smallest = 1.0;
  for (const ComparedMode& mode : modes) smallest = std::min(smallest, mode.mac);
  return smallest;
}

Comparison Comparison::with_stated_error() const {
  return part_of(*this, [&](double hz) { return accurate_to_hz <= 0.0 || hz <= accurate_to_hz; });
}

Comparison Comparison::without_stated_error() const {
  return part_of(*this, [&](double hz) { return accurate_to_hz > 0.0 && hz > accurate_to_hz; });
}

namespace {

template <class Analyse>
Comparison compare_with(const fe::FeModel& full, const rom::ReducedModel& reduced,
                        const CompareOptions& options, const Analyse& analyse_full) {
  const ModesOptions requested = request(options, reduced);
  const PartModes a = analyse_full(requested);
  if (a.modes.size() <= a.modes.rigid) refuse_nothing(full, requested, a.modes.rigid, analyse_full);
  if (a.modes.vectors.cols() == 0) return {};  // another process has them
  ModesOptions all;
  all.count =
      std::min(reduced.size(), 2 * a.modes.size() + 10);  // with neighbours for the projection
  const PartModes b = analyse(reduced, all);
  Comparison out;
  out.rigid_full = a.modes.rigid;
  out.rigid_reduced = b.modes.rigid;
  out.accurate_to_hz = reduced.certificate.accurate_to_hz.value_or(0.0);
  if (out.rigid_full != out.rigid_reduced) {
    throw NumericsError(fmt::format("{}: the full model has {} rigid modes, the reduced one {}",
                                    full.name, out.rigid_full, out.rigid_reduced));
  }
  if (b.modes.size() < a.modes.size()) {
    throw NumericsError(
        fmt::format("{}: {} modes of the full model to compare, the reduced one has "
                    "{}",
                    full.name, a.modes.size(), b.modes.size()));
  }
  const CommonRows rows = common_rows(full, a, reduced, b);
  out.rows = static_cast<int>(rows.full.rows());
  const VectorXd full_hz = a.modes.frequencies_hz(), reduced_hz = b.modes.frequencies_hz();
  std::vector<char> taken(static_cast<size_t>(b.modes.size()), 0);
  for (int j = out.rigid_full; j < a.modes.size(); ++j) {
    const int partner = find_partner(rows, reduced_hz, full_hz[j], j, taken);
    ComparedMode mode;
    mode.full_hz = full_hz[j];
    mode.reduced_hz = reduced_hz[partner];
    mode.error = mode.reduced_hz / full_hz[j] - 1.0;
    const std::vector<int> near = near_modes(reduced_hz, full_hz[j], out.rigid_reduced, partner);
    mode.mac = subspace_mac(rows.full.col(j), rows.reduced(Eigen::all, near));
    out.modes.push_back(mode);
  }
  const Index first = out.rigid_full, elastic = a.modes.size() - first;
  out.mac_matrix = mac_of(rows.full.rightCols(elastic), rows.reduced.middleCols(first, elastic));
  out.column_hz = reduced_hz.segment(first, elastic);
  return out;
}

}  // namespace

Comparison compare(const fe::FeModel& full, const rom::ReducedModel& reduced,
                   const CompareOptions& options) {
  return compare_with(full, reduced, options,
                      [&](const ModesOptions& modes) { return analyse(full, modes); });
}

Comparison compare(const fe::FeModel& full, const rom::ReducedModel& reduced,
                   const CompareOptions& options, const ModeSolver& solve) {
  return compare_with(full, reduced, options,
                      [&](const ModesOptions& modes) { return analyse(full, modes, solve); });
}

std::vector<std::string> table_of(const Comparison& comparison) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{:>5} {:>14} {:>14} {:>11} {:>10}", "mode", "full [Hz]",
                              "reduced [Hz]", "error [%]", "MAC"));
  int number = comparison.rigid_full;
  for (const ComparedMode& mode : comparison.modes) {
    lines.push_back(fmt::format("{:>5} {:>14.4f} {:>14.4f} {:>11.5f} {:>10.6f}", ++number,
                                mode.full_hz, mode.reduced_hz, 100.0 * mode.error, mode.mac));
  }
  const Comparison stated = comparison.with_stated_error();
  const Comparison above = comparison.without_stated_error();
  const std::string limit = fmt::format("{:.6g} Hz", comparison.accurate_to_hz);
  if (!above.modes.empty())
    lines.push_back(sum_of(above, fmt::format(" above {}, where no accuracy is stated", limit)));
  if (!stated.modes.empty())
    lines.push_back(fmt::format("{} rigid modes in both; {}", comparison.rigid_full,
                                sum_of(stated, above.modes.empty() ? "" : " up to " + limit)));
  return lines;
}

std::string matrix_text(const Comparison& comparison) {
  std::string text =
      "# MAC of the full model's elastic modes (rows) with those of the reduced one [Hz]\nfull_hz";
  for (double hz : comparison.column_hz) text += fmt::format(",{:.4f}", hz);
  for (Index j = 0; j < comparison.mac_matrix.rows(); ++j) {
    text += fmt::format("\n{:.4f}", comparison.modes[j].full_hz);
    for (double mac : comparison.mac_matrix.row(j)) text += fmt::format(",{:.6f}", mac);
  }
  return text + "\n";
}

JsonMembers json_of(const Comparison& comparison) {
  std::string modes = "[";
  for (const ComparedMode& mode : comparison.modes) {
    if (modes.size() > 1) modes += ", ";
    modes += fmt::format("{{\"full_hz\": {}, \"reduced_hz\": {}, \"error\": {}, \"mac\": {}}}",
                         json_number(mode.full_hz), json_number(mode.reduced_hz),
                         json_number(mode.error), json_number(mode.mac));
  }
  const Comparison stated = comparison.with_stated_error();
  const bool none = stated.modes.empty();
  return {{"modes", modes + "]"},
          {"rigid", json_number(comparison.rigid_full)},
          {"largest_error", json_number(comparison.largest_error())},
          {"smallest_mac", json_number(comparison.smallest_mac())},
          {"accurate_to_hz", json_number(comparison.accurate_to_hz)},
          {"modes_up_to_it", json_number(static_cast<double>(stated.modes.size()))},
          {"largest_error_up_to_it", json_number(none ? std::nan("") : stated.largest_error())},
          {"smallest_mac_up_to_it", json_number(none ? std::nan("") : stated.smallest_mac())}};
}

}  // namespace clatter::modes
