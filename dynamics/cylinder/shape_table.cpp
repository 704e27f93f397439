// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/shape_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"
#include "core/base/radial_shape_layout.hpp"
#include "core/base/units.hpp"
#include "dynamics/given/csv_table.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr int kAngles = 180;  // of an order: 2 degrees apart

/// Angles within one turn in ascending order, and the rows of the deviations with them.
film::LinerShape sorted(const Eigen::VectorXd& angle, const Eigen::VectorXd& height,
                        const Eigen::MatrixXd& deviation) {
  const auto wrapped = [&](Eigen::Index i) {
    const double turned = std::fmod(angle(i), kTurn);
    return turned < -1e-12 ? turned + kTurn : std::max(turned, 0.0);
  };
  std::vector<Eigen::Index> order(static_cast<size_t>(angle.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return wrapped(a) < wrapped(b); });
  film::LinerShape shape{Eigen::VectorXd(angle.size()), height,
                         Eigen::MatrixXd(deviation.rows(), deviation.cols())};
  for (size_t i = 0; i < order.size(); ++i) {
    shape.angle(static_cast<Eigen::Index>(i)) = wrapped(order[i]);
    shape.deviation.row(static_cast<Eigen::Index>(i)) = deviation.row(order[i]);
  }
  return shape;
}

/// A case of a shape file, in the film's angles: from +y, right-handed about z.
film::LinerShape of_file(const Config& entry, const ShapeTable& table) {
  const std::filesystem::path& path = table.file;
  const std::string& name = table.name;
  const H5File file = open_artefact(path, kShapeSchema);
  const std::vector<std::string> cases = file.list(kShapeCases);
  if (std::find(cases.begin(), cases.end(), name) == cases.end())
    entry.fail("case", fmt::format("found \"{}\", expected one of {}: {}", name, path.string(),
                                   fmt::join(cases, ", ")));
  const Eigen::Vector3d point = file.read_vector(kShapeAxisPoint),
                        axis = file.read_vector(kShapeAxis),
                        zero = file.read_vector(kShapeZeroAngle);
  if (std::abs(std::abs(axis.z()) - 1.0) > 1e-6)
    entry.fail("file", fmt::format("found an axis along ({:g}, {:g}, {:g}), expected one along z",
                                   axis.x(), axis.y(), axis.z()));
  const double up = axis.z() > 0.0 ? 1.0 : -1.0;
  Eigen::VectorXd height = up * file.read_vector(kShapeHeight).array() + point.z();
  Eigen::VectorXd angle = file.read_vector(kShapeAngle);
  const double start = std::atan2(-zero.x(), zero.y());
  angle = (start + up * angle.array()).eval();
  Eigen::MatrixXd deviation =
      file.read_rows(std::string(kShapeCases) + "/" + name + "/" + kShapeDeviation).transpose();
  if (deviation.rows() != angle.size() || deviation.cols() != height.size() ||
      !deviation.allFinite())
    entry.fail("file", fmt::format("found {} x {} deviations in {}, expected {} heights x {} "
                                   "angles, all finite",
                                   deviation.cols(), deviation.rows(), path.string(), height.size(),
                                   angle.size()));
  if (up < 0.0) {
    height.reverseInPlace();
    deviation = deviation.rowwise().reverse().eval();
  }
  return sorted(angle, height, deviation);
}

/// A measured shape: a table over the height with a column for each angle.
film::LinerShape of_table(const Config& entry, const ShapeTable& table) {
  const std::filesystem::path& path = table.table;
  const std::vector<std::string>& columns = table.columns;
  const std::vector<double>& angle = table.angle;
  if (angle.back() - angle.front() >= kTurn)
    entry.fail("angle_deg", "found a turn or more, expected angles within one turn");
  Eigen::VectorXd height;
  Eigen::MatrixXd deviation;
  for (size_t i = 0; i < columns.size(); ++i) {
    const CsvColumns csv = read_csv(path, columns[i]);
    if (csv.abscissa_unit != "m" || csv.unit != "m")
      entry.fail("table", fmt::format("found heights in {} and {} in {}, expected lengths",
                                      csv.abscissa_unit, columns[i], csv.unit));
    const auto n = std::ssize(csv.x);
    if (i == 0) deviation.resize(std::ssize(columns), n);
    height = Eigen::Map<const Eigen::VectorXd>(csv.x.data(), n);
    deviation.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(csv.y.data(), n);
  }
  return sorted(Eigen::Map<const Eigen::VectorXd>(angle.data(), std::ssize(angle)), height,
                deviation);
}

/// amplitude(z) cos(m (angle - phase)).
film::LinerShape of_order(const ShapeTable& table) {
  const double order = *table.order, phase = table.phase;
  const std::vector<double>&height = table.height, &amplitude = table.amplitude;
  const int n = order == 0.0 ? 1 : kAngles;
  film::LinerShape shape{Eigen::VectorXd(n),
                         Eigen::Map<const Eigen::VectorXd>(height.data(), std::ssize(height)),
                         Eigen::MatrixXd(n, std::ssize(height))};
  for (int i = 0; i < n; ++i) {
    shape.angle(i) = kTurn * i / n;
    for (size_t k = 0; k < amplitude.size(); ++k)
      shape.deviation(i, static_cast<Eigen::Index>(k)) =
          amplitude[k] * std::cos(order * (shape.angle(i) - phase));
  }
  return shape;
}

void make_shape(const Config& entry, ShapeTable& found) {
  film::LinerShape& shape = found.shape;
  shape = found.order          ? of_order(found)
          : found.file.empty() ? of_table(entry, found)
                               : of_file(entry, found);
  shape.deviation *= found.factor;
  constexpr double kLargest = 0.01;  // [m]
  if (!(shape.deviation.cwiseAbs().maxCoeff() <= kLargest))
    entry.fail("factor",
               fmt::format("found deviations of {:.3g} mm, expected at most {:g}",
                           shape.deviation.cwiseAbs().maxCoeff() / kMilli, kLargest / kMilli));
}

}  // namespace

const keys::Keys<ShapeTable>& shape_keys() {
  static const keys::Keys<ShapeTable> keys(
      "shape", "a deviation of a surface: of a file, measured, or an order around",
      [](auto& key, ShapeTable& table) {
        key.path("file", table.file, "shape file, as clatter-modal writes it");
        key.text("case", table.name, "load case of the file").of("file");
        key.path("table", table.table, "CSV of deviations over the height, a column an angle");
        key.numbers("angle_deg", table.angle, Range::between(-1e6, 1e6),
                    "angle of each column, right-handed from the thrust side")
            .ascending()
            .of("table");
        key.texts("columns", table.columns, "columns of the table, one for each angle")
            .as_many_as("angle_deg")
            .of("table");
        key.integer("order", table.order, Range::between(0.0, 20.0),
                    "waves around the bore; 0: the same all around");
        key.one_of({"file", "table", "order"});
        key.number("phase_deg", table.phase, Range::between(-360.0, 360.0),
                   "angle of a crest of the order")
            .needs("order");
        key.numbers("height_mm", table.height, Range::between(-1e6, 1e6),
                    "heights of the amplitudes of the order")
            .ascending()
            .of("order");
        key.numbers("amplitude_um", table.amplitude, Range::between(-1e9, 1e9),
                    "amplitude of the order at each height, outward positive")
            .as_many_as("height_mm")
            .of("order");
        key.number("factor", table.factor, Range::between(-1e3, 1e3), "of all deviations");
        key.part(table.scale, shape_scale_keys());
        key.check(make_shape);
      });
  return keys;
}

}  // namespace clatter::dynamics
