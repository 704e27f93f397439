// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/add_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "core/base/error.hpp"
#include "core/dense/svd.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr const char* kRequest = "request/text";

/// Rows of two skins at the same position; positions that occur twice in a skin are omitted.
std::vector<std::pair<Index, Index>> common_points(const rom::Skin& a, const rom::Skin& b) {
  using Position = std::array<double, 3>;
  const auto positions = [](const rom::Skin& skin) {
    std::map<Position, Index> out;  // -1: twice
    for (Index p = 0; p < skin.nodes.rows(); ++p) {
      const auto [at, first] =
          out.try_emplace(Position{skin.nodes(p, 0), skin.nodes(p, 1), skin.nodes(p, 2)}, p);
      if (!first) at->second = -1;
    }
    return out;
  };
  const std::map<Position, Index> other = positions(b);
  std::vector<std::pair<Index, Index>> pairs;
  for (const auto& [position, row] : positions(a)) {
    const auto at = other.find(position);
    if (row >= 0 && at != other.end() && at->second >= 0) pairs.emplace_back(row, at->second);
  }
  return pairs;
}

/// Data that both models hold about their coordinates, row by row, each kind scaled to unit size.
struct Evidence {
  MatrixXd fresh, stored;

  void append(const MatrixXd& f, const MatrixXd& s) {
    const double size = s.size() > 0 ? s.cwiseAbs().maxCoeff() : 0.0;
    if (size == 0.0) return;
    const Index n = fresh.rows();
    fresh.conservativeResize(n + f.rows(), s.cols());
    stored.conservativeResize(n + s.rows(), s.cols());
    fresh.bottomRows(f.rows()) = f / size;
    stored.bottomRows(s.rows()) = s / size;
  }
};

Evidence evidence(const rom::ReducedModel& fresh, const rom::ReducedModel& stored) {
  Evidence out;
  const Index n_b = stored.n_boundary;
  out.append(fresh.M_rr.topRows(n_b), stored.M_rr.topRows(n_b));
  for (const auto& [name, load] : stored.loads)
    out.append(fresh.loads.at(name).transpose(), load.transpose());
  const Index c = std::min(fresh.combined.rows(), stored.combined.rows());
  if (c > 0) out.append(fresh.combined.topRows(c), stored.combined.topRows(c));
  const auto pairs = common_points(fresh.skin, stored.skin);
  MatrixXd f(3 * static_cast<Index>(pairs.size()), stored.size()), s(f.rows(), f.cols());
  for (size_t k = 0; k < pairs.size(); ++k) {
    f.middleRows(3 * static_cast<Index>(k), 3) = fresh.skin.T.middleRows(3 * pairs[k].first, 3);
    s.middleRows(3 * static_cast<Index>(k), 3) = stored.skin.T.middleRows(3 * pairs[k].second, 3);
  }
  out.append(f, s);
  return out;
}

/// Orthogonal Q, block by block, with fresh Q nearest to stored.
MatrixXd turn(const Evidence& known, const rom::ReducedModel& stored) {
  const Index r = stored.size();
  MatrixXd Q = MatrixXd::Identity(r, r);
  for (Index first = stored.n_boundary, end = 0; first < r; first = end) {
    const auto near = [&](Index j) {
      return std::abs(stored.K_rr(j, j) - stored.K_rr(j - 1, j - 1)) <= 1e-6 * stored.K_rr(j, j);
    };
    for (end = first + 1; end < r && near(end);) ++end;
    const Index m = end - first;
    const MatrixXd cross =
        known.fresh.middleCols(first, m).transpose() * known.stored.middleCols(first, m);
    const dense::Svd svd = dense::svd(cross);
    Q.block(first, first, m, m) = svd.U * svd.V.transpose();
  }
  return Q;
}

double scaled_difference(const MatrixXd& fresh, const MatrixXd& stored) {
  const Eigen::VectorXd unit = stored.diagonal().cwiseSqrt().cwiseInverse();
  return (unit.asDiagonal() * (fresh - stored) * unit.asDiagonal()).cwiseAbs().maxCoeff();
}

void unite(std::vector<std::string>& names, const std::vector<std::string>& more) {
  for (const std::string& name : more)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

/// Names of sets that `stored` has besides its boundary.
std::vector<std::string> sets_beside(const rom::ReducedModel& stored,
                                     const std::vector<std::string>& boundary) {
  std::vector<std::string> names;
  for (const std::string& name : stored.recovered_sets)
    if (std::find(boundary.begin(), boundary.end(), name) == boundary.end()) names.push_back(name);
  return names;
}

}  // namespace

StoredRequest read_request(const std::filesystem::path& rom) {
  const H5File file = open_artefact(rom, rom::kRomSchema);
  if (!file.has(kRequest) || !file.has("inputs/sha256"))
    throw InputError(
        fmt::format("{}: {}: found none, expected a part condensed by this version: condense the "
                    "part again to add rows",
                    rom.string(), kRequest));
  return {file.read_strings(kRequest).at(0), file.read_strings("inputs/path").at(0),
          file.read_strings("inputs/sha256").at(0)};
}

void write_request(H5File& file, const std::string& text) {
  file.write(kRequest, std::vector<std::string>{text});
}

double align_basis(rom::ReducedModel& fresh, const rom::ReducedModel& stored) {
  if (fresh.size() != stored.size() || fresh.n_boundary != stored.n_boundary)
    return std::numeric_limits<double>::infinity();
  const Evidence known = evidence(fresh, stored);
  const MatrixXd Q = turn(known, stored);
  fresh.M_rr = (Q.transpose() * fresh.M_rr * Q).eval();
  fresh.K_rr = (Q.transpose() * fresh.K_rr * Q).eval();
  for (auto& [name, load] : fresh.loads) load = (Q.transpose() * load).eval();
  if (fresh.combined.rows() > 0) fresh.combined = (fresh.combined * Q).eval();
  if (fresh.skin.T.rows() > 0) fresh.skin.T = (fresh.skin.T * Q).eval();
  double worst = std::max(scaled_difference(fresh.M_rr, stored.M_rr),
                          scaled_difference(fresh.K_rr, stored.K_rr));
  if (known.stored.rows() > 0)
    worst = std::max(worst, (known.fresh * Q - known.stored).cwiseAbs().maxCoeff());
  return worst;
}

rom::ReducedModel add_rows(const fe::FeModel& model, const rom::ReducedModel& stored,
                           CondenseOptions options, const RowRequest& request, StepClock& clock) {
  options.skin = stored.skin.surfaces;
  unite(options.skin, request.surfaces);
  options.rows = sets_beside(stored, options.boundary);
  for (const std::string& name : request.sets)
    if (!stored.sets.contains(name)) unite(options.rows, {name});
  // The count of modes is proved again, so that the solver takes identical steps. Otherwise its
  // rounding, 1e-14 of a mode, is amplified to 1e-4 of the weakest residual mode.
  options.certificate = options.inertia_invariants = options.modes.estimate_error = false;
  options.joined_error = false;
  rom::ReducedModel fresh = condense(model, options, clock);
  const double error = align_basis(fresh, stored);
  clock.lap("comparison with the stored basis");
  // The same steps give identical values; a rotation among equal frequencies leaves only rounding.
  const double limit = judgement_of<rom::ReducedCertificate>("rows_added_error").refused;
  if (!(error <= limit))
    throw NumericsError(
        fmt::format("{}: the basis solved for again differs by {:.1e} from the stored one, "
                    "expected at most {:.0e}: repeat with the threads and the BLAS kernel of that "
                    "run, or condense the part again with these rows",
                    stored.name, error, limit));
  rom::ReducedModel out = stored;
  out.skin = std::move(fresh.skin);
  out.combined = std::move(fresh.combined);
  out.sets = std::move(fresh.sets);
  out.grids = std::move(fresh.grids);
  out.recovered_sets = std::move(fresh.recovered_sets);
  out.elimination = std::move(fresh.elimination);
  out.certificate.rows_added_error = error;
  return out;
}

std::string describe_added_rows(const rom::ReducedModel& with_rows) {
  return fmt::format(
      "{}: {} skin nodes, {} sets besides the boundary; the basis solved for again "
      "differs by {:.1e} from the stored one",
      with_rows.name, with_rows.skin.nodes.rows(), with_rows.recovered_sets.size(),
      with_rows.certificate.rows_added_error.value());
}

JsonMembers json_of_added_rows(const rom::ReducedModel& with_rows) {
  return {{"skin_nodes", json_number(static_cast<double>(with_rows.skin.nodes.rows()))},
          {"recovered_sets", json_number(static_cast<double>(with_rows.recovered_sets.size()))},
          {"rows_added_error", json_number(with_rows.certificate.rows_added_error.value())}};
}

}  // namespace clatter::condense
