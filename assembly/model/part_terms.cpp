// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/model/part_terms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/error.hpp"

namespace clatter::assembly {
namespace {

constexpr double kNoPart = 1e-15;     // of a unit vector: rounding of its axes
constexpr double kUncoupled = 1e-11;  // of the diagonals: rounding of a zero

/// q = B u of one part: its coordinates as combinations of some ids.
struct Coordinates {
  std::vector<int32_t> ids;  // ascending
  SparseMatrix B;            // r x ids
};

Coordinates coordinates_of(const PartSpec& spec, const DofNumbers& numbers) {
  std::vector<Eigen::Triplet<double, int32_t>> entries;  // columns are ids at first
  Coordinates out;
  for (size_t j = 0; j < spec.coordinates.size(); ++j) {
    const PartCoordinate& one = spec.coordinates[j];
    const auto row = static_cast<int32_t>(j);
    const auto add = [&](int64_t id, double factor) {
      entries.emplace_back(row, static_cast<int32_t>(id), factor);
      out.ids.push_back(static_cast<int32_t>(id));
    };
    if (one.node < 0) add(numbers.first_own() + one.own, 1.0);
    for (int d = 0; one.node >= 0 && d < 3; ++d)
      if (std::abs(one.along(d)) > kNoPart)
        add(numbers.of(NodeOrPoint::of_node(one.node), d + (one.is_rotation ? 3 : 0)),
            one.along(d));
  }
  std::ranges::sort(out.ids);
  out.ids.erase(std::ranges::unique(out.ids).begin(), out.ids.end());
  for (auto& entry : entries)
    entry = {entry.row(),
             static_cast<int32_t>(std::ranges::lower_bound(out.ids, entry.col()) - out.ids.begin()),
             entry.value()};
  out.B.resize(spec.model.size(), static_cast<Eigen::Index>(out.ids.size()));
  out.B.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// K_rr without what rounding left between modal coordinates and others, which are not coupled: a
/// row of nothing else would seem to resist rigid motions.
Eigen::MatrixXd stiffness_of(const rom::ReducedModel& model) {
  Eigen::MatrixXd K = model.K_rr;
  for (Eigen::Index j = 0; j < K.cols(); ++j)
    for (Eigen::Index i = std::max<Eigen::Index>(model.n_boundary, j + 1); i < K.rows(); ++i)
      if (std::abs(K(i, j)) <= kUncoupled * std::sqrt(K(i, i) * K(j, j))) K(i, j) = K(j, i) = 0.0;
  return K;
}

using Triplets = std::vector<Eigen::Triplet<double, int32_t>>;

/// The lower triangle of B^T A B.
void append(const Eigen::MatrixXd& A, const Coordinates& part, Triplets& entries) {
  const Eigen::MatrixXd right = A * part.B;
  const Eigen::MatrixXd both = part.B.transpose() * right;
  for (Eigen::Index j = 0; j < both.cols(); ++j)
    for (Eigen::Index i = j; i < both.rows(); ++i)
      if (const double value = 0.5 * (both(i, j) + both(j, i)); value != 0.0)
        entries.emplace_back(part.ids[i], part.ids[j], value);
}

SparseMatrix from(const Triplets& entries, int64_t size) {
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// What the file of a part says of it.
fe::FePart known_of(const PartSpec& spec, const DofNumbers& numbers,
                    const Elimination& elimination) {
  const rom::ReducedModel& model = spec.model;
  const rom::ReducedCertificate& certificate = model.certificate;
  fe::FePart known{.name = spec.name,
                   .certified = certificate.certified.value_or(0.0) != 0.0,
                   .valid_to_hz = model.valid_to_hz,
                   .accurate_to_hz = certificate.accurate_to_hz.value_or(0.5 * model.valid_to_hz)};
  if (model.truncation.rows() == 0) return known;
  Triplets entries;
  append(model.truncation, coordinates_of(spec, numbers), entries);
  known.truncation = transform_with_supports(from(entries, numbers.count()), elimination).qq;
  return known;
}

/// Rows of a transformation, ids x coordinates.
SparseMatrix rows_of(const SparseMatrix& T, const std::vector<int32_t>& ids) {
  std::vector<int32_t> place(static_cast<size_t>(T.rows()), -1);
  for (size_t k = 0; k < ids.size(); ++k) place[ids[k]] = static_cast<int32_t>(k);
  Triplets entries;
  for (Eigen::Index j = 0; j < T.cols(); ++j)
    for (SparseMatrix::InnerIterator entry(T, j); entry; ++entry)
      if (const int32_t row = place[entry.row()]; row >= 0)
        entries.emplace_back(row, static_cast<int32_t>(j), entry.value());
  SparseMatrix rows(static_cast<Eigen::Index>(ids.size()), T.cols());
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

/// Rows for some columns of a matrix.
struct ColumnsOf {
  std::vector<int32_t> columns;  // ascending
  Eigen::MatrixXd values;        // rows x columns
};

/// T_skin B T of the columns with entries.
ColumnsOf skin_rows(const RowMatrix& T_skin, const SparseMatrix& of_coordinates) {
  ColumnsOf out;
  Triplets entries;
  for (Eigen::Index j = 0; j < of_coordinates.cols(); ++j) {
    bool any = false;
    for (SparseMatrix::InnerIterator entry(of_coordinates, j); entry; ++entry) {
      entries.emplace_back(static_cast<int32_t>(entry.row()),
                           static_cast<int32_t>(out.columns.size()), entry.value());
      any = true;
    }
    if (any) out.columns.push_back(static_cast<int32_t>(j));
  }
  SparseMatrix some(of_coordinates.rows(), static_cast<Eigen::Index>(out.columns.size()));
  some.setFromTriplets(entries.begin(), entries.end());
  out.values = T_skin * some;
  return out;
}

/// `top` with more rows below.
SparseMatrix stacked(const SparseMatrix& top, const std::vector<ColumnsOf>& below,
                     const std::string& name) {
  Eigen::Index rows = top.rows();
  int64_t count = top.nonZeros();
  for (const ColumnsOf& part : below) {
    rows += part.values.rows();
    count += part.values.size();
  }
  if (count > std::numeric_limits<int32_t>::max())
    throw InputError(
        fmt::format("{}: the skins of its parts have {} rows with {} entries, expected "
                    "at most 2147483647: reduce the parts with fewer skin surfaces",
                    name, rows - top.rows(), count));
  SparseMatrix all(rows, top.cols());
  all.reserve(static_cast<Eigen::Index>(count));
  std::vector<Eigen::Index> next(below.size(), 0);
  for (Eigen::Index j = 0; j < top.cols(); ++j) {
    all.startVec(j);
    for (SparseMatrix::InnerIterator entry(top, j); entry; ++entry)
      all.insertBack(entry.row(), j) = entry.value();
    Eigen::Index first = top.rows();
    for (size_t p = 0; p < below.size(); ++p) {
      const ColumnsOf& part = below[p];
      const auto at = next[p];
      if (at < part.values.cols() && part.columns[static_cast<size_t>(at)] == j) {
        for (Eigen::Index i = 0; i < part.values.rows(); ++i)
          if (part.values(i, at) != 0.0) all.insertBack(first + i, j) = part.values(i, at);
        ++next[p];
      }
      first += part.values.rows();
    }
  }
  all.finalize();
  return all;
}

/// Faces of a skin by their rows, or all, as nodes of the model.
mesh::Surface faces_of(const rom::Skin& skin, const std::vector<int32_t>* rows, int32_t first) {
  IndexMatrix nodes = rows ? IndexMatrix(skin.triangles(*rows, Eigen::all)) : skin.triangles;
  nodes.array() += first;
  return {{{mesh::FaceType::kTri6, std::move(nodes)}}};
}

/// The surfaces of a part's skin, whose nodes begin at `first`.
/// @param known names of earlier parts' surfaces.
void add_surfaces(fe::FeModel& model, const PartSpec& spec, int32_t first,
                  std::set<std::string>& known) {
  const rom::Skin& skin = spec.model.skin;
  const auto add = [&](const std::string& name, const std::vector<int32_t>* rows) {
    if (!known.insert(name).second)
      spec.source.fail("keeps_names",
                       fmt::format("found the surface \"{}\" twice, expected different names: "
                                   "without keeps_names",
                                   name));
    // A set of the same name has its own faces already.
    model.surfaces.emplace(name, faces_of(skin, rows, first));
  };
  add(spec.name + "_skin", nullptr);
  for (const auto& [name, rows] : skin.faces)
    if (name != "skin") add(spec.named(name), &rows);
}

IndexMatrix joined(const IndexMatrix& a, const IndexMatrix& b) {
  IndexMatrix all(a.rows() + b.rows(), 6);
  if (a.rows() > 0) all.topRows(a.rows()) = a;
  if (b.rows() > 0) all.bottomRows(b.rows()) = b;
  return all;
}

/// Zeros for the new nodes.
void lengthen(Eigen::VectorXd& values, Eigen::Index size) {
  const Eigen::Index before = values.size();
  values.conservativeResize(size);
  values.tail(size - before).setZero();
}

}  // namespace

PartMatrices part_matrices(const PartData& part) {
  Triplets K, M, loss;
  for (const PartSpec& spec : part.recipe.parts) {
    const Coordinates coordinates = coordinates_of(spec, part.numbers);
    append(stiffness_of(spec.model), coordinates, K);
    append(spec.model.M_rr, coordinates, M);
    if (spec.model.loss.rows() > 0) append(spec.model.loss, coordinates, loss);
  }
  const int64_t size = part.numbers.count();
  return {.M = from(M, size), .K = from(K, size), .loss = from(loss, loss.empty() ? 0 : size)};
}

void add_parts(MassMoments& moments, const PartData& part) {
  for (const PartSpec& spec : part.recipe.parts) {
    const rom::MassProperties& mass = spec.model.mass;
    add_point(moments, mass.mass, mass.centre, mass.inertia);
  }
}

void add_loads_of_parts(LoadVectors& loads, const PartData& part, const Elimination& elimination) {
  for (const PartSpec& spec : part.recipe.parts) {
    if (spec.model.loads.empty()) continue;
    const Coordinates coordinates = coordinates_of(spec, part.numbers);
    const SparseMatrix of_q = coordinates.B * rows_of(elimination.T, coordinates.ids);
    const SparseMatrix of_s = coordinates.B * rows_of(elimination.T_s, coordinates.ids);
    for (const auto& [name, load] : spec.model.loads) {
      loads.forces[spec.named(name)] = of_q.transpose() * load;
      loads.units[spec.named(name)] = "1";
      if (elimination.supports() > 0)
        loads.support_forces[spec.named(name)] = of_s.transpose() * load;
    }
  }
}

void add_skins(fe::FeModel& model, const PartData& part, const Elimination& elimination) {
  const std::vector<PartSpec>& parts = part.recipe.parts;
  if (parts.empty()) return;
  std::vector<ColumnsOf> of_q, of_s;
  const Eigen::Index own = model.nodes.rows();
  IndexMatrix all;
  std::set<std::string> surfaces;
  for (const PartSpec& spec : parts) {
    const rom::ReducedModel& reduced = spec.model;
    model.parts.list.push_back(known_of(spec, part.numbers, elimination));
    const rom::Skin& skin = reduced.skin;
    if (skin.nodes.rows() == 0) continue;
    const Coordinates coordinates = coordinates_of(spec, part.numbers);
    of_q.push_back(skin_rows(skin.T, coordinates.B * rows_of(elimination.T, coordinates.ids)));
    of_s.push_back(skin_rows(skin.T, coordinates.B * rows_of(elimination.T_s, coordinates.ids)));
    const auto node = static_cast<int32_t>(model.nodes.rows());
    model.nodes.conservativeResize(node + skin.nodes.rows(), 3);
    model.nodes.bottomRows(skin.nodes.rows()) = skin.nodes;
    add_surfaces(model, spec, node, surfaces);
    const mesh::Surface whole = faces_of(skin, nullptr, node);
    all = joined(all, whole.faces[0].nodes);
    if (!skin.sheet.empty())
      model.parts.sheet =
          joined(model.parts.sheet, faces_of(skin, &skin.sheet, node).faces[0].nodes);
  }
  if (all.rows() > 0) {
    mesh::Surface skin;
    skin.faces.push_back({mesh::FaceType::kTri6, std::move(all)});
    model.surfaces.emplace("skin", std::move(skin));
  }
  model.T = stacked(model.T, of_q, model.name);
  model.supports.T = stacked(model.supports.T, of_s, model.name);
  for (auto& [name, rise] : model.temperature_rise) lengthen(rise, model.nodes.rows());
  for (auto& [name, field] : model.heat) lengthen(field.temperature, model.nodes.rows());
  std::vector<int32_t>& ids = model.cells.node_ids;
  int32_t number = ids.empty() ? 0 : std::ranges::max(ids);
  for (Eigen::Index a = own; !ids.empty() && a < model.nodes.rows(); ++a) ids.push_back(++number);
}

}  // namespace clatter::assembly
