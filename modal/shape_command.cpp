// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/shape_command.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/whole_file.hpp"
#include "core/base/write_artefact.hpp"
#include "modal/number_list.hpp"
#include "modal/shape.hpp"

namespace clatter::modal {
namespace {

struct ShapeArguments {
  std::filesystem::path results, output, csv;
  std::string axis_point, axis, zero_angle, range;
  ShapeOptions options;
};

std::vector<double> numbers_of(const char* flag, const std::string& text, size_t count) {
  const std::vector<double> numbers = numbers_in(text);
  if (numbers.size() != count)
    throw InputError(fmt::format("command line: {}: found \"{}\", expected {} numbers with commas",
                                 flag, text, count));
  return numbers;
}

/// The axes of the options, unless none is given.
std::optional<CylinderAxes> axes_of(const ShapeArguments& a) {
  if (a.axis_point.empty() && a.axis.empty() && a.zero_angle.empty()) return std::nullopt;
  const auto vector = [](const char* flag, const std::string& text) {
    return Eigen::Vector3d(numbers_of(flag, text, 3).data());
  };
  CylinderAxes axes{vector("--axis-point", a.axis_point), vector("--axis", a.axis),
                    vector("--zero-angle", a.zero_angle)};
  axes.axis.normalize();
  axes.zero_angle -= axes.zero_angle.dot(axes.axis) * axes.axis;
  if (!axes.axis.allFinite() || !(axes.axis.norm() > 0.5) || !(axes.zero_angle.norm() > 1e-6))
    throw InputError(
        fmt::format("command line: --zero-angle: found {} about the axis {}, expected "
                    "a direction across the axis",
                    a.zero_angle, a.axis));
  axes.zero_angle.normalize();
  return axes;
}

void compute_shape(const ShapeArguments& a, const CommonOptions& common) {
  StepClock clock;
  ShapeOptions options = a.options;
  options.axes = axes_of(a);
  if (!a.range.empty()) {
    const std::vector<double> ends = numbers_of("--range", a.range, 2);
    options.range = {ends[0], ends[1]};
  }
  const Shape shape = shape_from_file(a.results, options);
  clock.lap("shape");
  for (const std::string& line : describe(shape)) print_result(line);
  write_artefact(a.output, {kShapeSchema, "", {a.results}}, clock, common,
                 [&](H5File& file) { write_shape(file, shape); });
  if (!a.csv.empty()) write_whole_file(a.csv, csv_of(shape));
  print_json_result(a.output, json_of(shape), clock, common);
}

}  // namespace

void declare_shape(CommandLine& program) {
  CommandLine& line = program.command(
      "shape", "The radial shape of a bore or skirt in static results, and its Fourier orders.",
      "samples: clatter-modal shape block.static.h5 --surface liner_4_bore --case warm -o "
      "liner_4.shape.h5\n"
      "         clatter-modal shape part.static.h5 --surface bore --axis-point 0,0,0 --axis 0,0,1\n"
      "           --zero-angle 1,0,0 --csv bore.csv -o bore.shape.h5");
  const auto a = std::make_shared<ShapeArguments>();
  line.positional("results", a->results, "static results (.static.h5)");
  line.output("-o,--output", a->output, "the shape to write (.shape.h5)", true);
  line.option("--surface", a->options.surface, "cylinder surface of the part");
  line.option("--case", a->options.cases, "case to evaluate (repeatable); default: all");
  line.option("--axis-point", a->axis_point,
              "x,y,z [m] of a point of the axis; heights count from it. Default of the three: the "
              "axes of the contact grid on the surface");
  line.option("--axis", a->axis, "x,y,z: direction of the axis");
  line.option("--zero-angle", a->zero_angle, "x,y,z: direction of angle 0, right-handed about it");
  line.option("--range", a->range, "heights from,to [m]; default: the entire surface");
  line.option("--heights", a->options.heights, "number of heights, default 41");
  line.option("--angles", a->options.angles, "number of angles, default 72");
  line.option("--orders", a->options.orders, "highest Fourier order, default 8");
  line.flag("--keep-rigid", a->options.keep_rigid, "keep translation and tilt in the deviation");
  line.output("--csv", a->csv, "also write the deviations as comma-separated values");
  line.action([a](const CommonOptions& common) { compute_shape(*a, common); });
}

}  // namespace clatter::modal
