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
film::LinerShape of_file(const Config& entry, const std::filesystem::path& path) {
  const H5File file = open_artefact(path, kShapeSchema);
  const std::vector<std::string> cases = file.list(kShapeCases);
  const std::string name = entry.text("case");
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

std::vector<double> ascending(const Config& entry, const char* key, double factor) {
  std::vector<double> values = entry.numbers(key);
  for (size_t k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]))
      entry.fail(key, fmt::format("found {:g} after {:g}, expected ascending values", values[k],
                                  values[k - 1]));
  if (values.empty()) entry.fail(key, "found none, expected at least one value");
  for (double& value : values) value *= factor;
  return values;
}

/// A measured shape: a table over the height with a column for each angle.
film::LinerShape of_table(const Config& entry, const std::filesystem::path& path) {
  const std::vector<std::string> columns = entry.texts("columns");
  const std::vector<double> angle = ascending(entry, "angle_deg", kDegree);
  if (columns.size() != angle.size())
    entry.fail("columns", fmt::format("found {}, expected one for each of {} angles",
                                      columns.size(), angle.size()));
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
film::LinerShape of_order(const Config& entry) {
  const auto order = static_cast<double>(entry.integer_or("order", 0, Range::between(0.0, 20.0)));
  const double phase = entry.number_or("phase_deg", 0.0, Range::between(-360.0, 360.0)) * kDegree;
  const std::vector<double> height = ascending(entry, "height_mm", kMilli);
  const std::vector<double> amplitude = entry.numbers("amplitude_um");
  if (amplitude.size() != height.size())
    entry.fail("amplitude_um", fmt::format("found {} values, expected one for each of {} heights",
                                           amplitude.size(), height.size()));
  const int n = order == 0.0 ? 1 : kAngles;
  film::LinerShape shape{Eigen::VectorXd(n),
                         Eigen::Map<const Eigen::VectorXd>(height.data(), std::ssize(height)),
                         Eigen::MatrixXd(n, std::ssize(height))};
  for (int i = 0; i < n; ++i) {
    shape.angle(i) = kTurn * i / n;
    for (size_t k = 0; k < amplitude.size(); ++k)
      shape.deviation(i, static_cast<Eigen::Index>(k)) =
          amplitude[k] * kMicro * std::cos(order * (shape.angle(i) - phase));
  }
  return shape;
}

}  // namespace

SurfaceShapes read_surface_shapes(const Config& contact, const char* key) {
  SurfaceShapes found;
  for (const Config& entry : contact.tables(key)) {
    const int kinds = entry.has("file") + entry.has("table") + entry.has("order");
    if (kinds != 1)
      entry.fail(kinds == 0 ? "file" : "order",
                 fmt::format("found {} of file, table and order, expected one of them", kinds));
    film::LinerShape shape;
    if (entry.has("order")) {
      shape = of_order(entry);
    } else {
      const bool is_file = entry.has("file");
      found.files.push_back(entry.path(is_file ? "file" : "table"));
      shape = is_file ? of_file(entry, found.files.back()) : of_table(entry, found.files.back());
    }
    shape.deviation *= entry.number_or("factor", 1.0, Range::between(-1e3, 1e3));
    constexpr double kLargest = 0.01;  // [m]
    if (!(shape.deviation.cwiseAbs().maxCoeff() <= kLargest))
      entry.fail("factor",
                 fmt::format("found deviations of {:.3g} mm, expected at most {:g}",
                             shape.deviation.cwiseAbs().maxCoeff() / kMilli, kLargest / kMilli));
    if (auto scale = read_shape_scale(entry)) {
      if (!scale->table.empty()) found.files.push_back(scale->table);
      found.scaled.push_back({std::move(shape), std::move(*scale)});
    } else {
      found.shapes.push_back(std::move(shape));
    }
  }
  return found;
}

}  // namespace clatter::dynamics
