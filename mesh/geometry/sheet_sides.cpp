// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/sheet_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::mesh {
namespace {

constexpr double kSame = 0.05;       // of the thickness, and of the volume
constexpr double kMixed = 0.75;      // of a face's points: fewer are not of a side as a whole
constexpr double kSmallFace = 0.02;  // of the area of all faces
constexpr double kThickest = 0.2;    // of the root of the area of a side: more is no sheet
const char* const kWayOut =
    "; a sheet of several thicknesses or with ribs is meshed by its faces: [sheet.faces]";

double weighted_median(std::vector<std::pair<double, double>> values) {
  std::sort(values.begin(), values.end());
  double all = 0.0, sum = 0.0;
  for (const auto& value : values) all += value.second;
  for (const auto& [value, weight] : values)
    if ((sum += weight) >= 0.5 * all) return value;
  return values.back().first;
}

double median_depth(const std::vector<FaceDepths>& faces) {
  std::vector<std::pair<double, double>> depths;
  for (const FaceDepths& face : faces)
    for (const double depth : face.depth)
      depths.emplace_back(depth, face.area / static_cast<double>(face.depth.size()));
  return weighted_median(std::move(depths));
}

/// Of the points of a face, those with the sheet behind them.
double share_at(const FaceDepths& face, double thickness) {
  if (face.depth.empty()) return 0.0;
  const auto at = std::ranges::count_if(
      face.depth, [&](double depth) { return std::abs(depth - thickness) <= kSame * thickness; });
  return static_cast<double>(at) / static_cast<double>(face.depth.size());
}

std::string place_of(const FaceDepths& face) {
  return fmt::format("face {} at ({:.4g}, {:.4g}, {:.4g})", face.face, face.centre.x(),
                     face.centre.y(), face.centre.z());
}

}  // namespace

std::vector<std::vector<int>> groups_of(const std::vector<int>& faces,
                                        const std::map<int, std::vector<int>>& curves) {
  std::map<int, std::vector<int>> faces_at;
  for (const int face : faces)
    for (const int curve : curves.at(face)) faces_at[curve].push_back(face);
  std::set<int> left(faces.begin(), faces.end());
  std::vector<std::vector<int>> groups;
  while (!left.empty()) {
    std::vector<int>& group = groups.emplace_back();
    group.push_back(*left.begin());
    left.erase(left.begin());
    for (size_t i = 0; i < group.size(); ++i)
      for (const int curve : curves.at(group[i]))
        for (const int next : faces_at[curve])
          if (left.erase(next) > 0) group.push_back(next);
    std::sort(group.begin(), group.end());
  }
  return groups;
}

void take_outward(const std::vector<FaceDepths>& depths, SheetFaces& sheet) {
  constexpr size_t kPoints = 4;  // of a face
  for (const FaceDepths& face : depths) {
    if (!std::ranges::binary_search(sheet.faces, face.face)) continue;
    const size_t step = std::max<size_t>(1, face.points.size() / kPoints);
    for (size_t i = 0; i < face.points.size(); i += step) {
      sheet.outward.push_back({face.face, face.points[i], face.outward[i]});
    }
  }
}

SheetSides find_sides(const std::vector<FaceDepths>& faces,
                      const std::map<int, std::vector<int>>& curves, double volume,
                      std::optional<double> thickness, const std::string& unit) {
  SheetSides out;
  const double t = out.thickness = thickness ? *thickness : median_depth(faces);
  std::map<int, double> area_of;
  double area = 0.0;
  for (const FaceDepths& face : faces) area += area_of[face.face] = face.area;
  std::vector<int> sides;
  for (const FaceDepths& face : faces) {
    const double share = share_at(face, t);
    if (share > 1.0 - kMixed && share < kMixed && face.area > kSmallFace * area) {
      const auto [low, high] = std::ranges::minmax(face.depth);
      throw NumericsError(
          fmt::format("the sheet is not {:.4g} {} thick everywhere: {:.4g} to "
                      "{:.4g} behind {}{}",
                      t, unit, low, high, place_of(face), kWayOut));
    }
    (share > 0.5 ? sides : out.rims).push_back(face.face);
  }
  std::vector<std::vector<int>> groups = groups_of(sides, curves);
  const auto area_of_group = [&](const std::vector<int>& group) {
    double sum = 0.0;
    for (const int face : group) sum += area_of.at(face);
    return sum;
  };
  std::ranges::stable_sort(groups, std::greater<>(), area_of_group);
  if (groups.size() != 2)
    throw NumericsError(fmt::format(
        "found {} connected sides of {:.4g} {} of thickness, expected the two of one sheet{}",
        groups.size(), t, unit, kWayOut));
  if (t > kThickest * std::sqrt(area_of_group(groups[1])))
    throw NumericsError(
        fmt::format("found a solid of {:.4g} {} between sides of {:.4g} {}2, "
                    "expected a sheet: kind = \"cad\" meshes solids",
                    t, unit, area_of_group(groups[1]), unit));
  const double expected = 0.5 * t * (area_of_group(groups[0]) + area_of_group(groups[1]));
  if (std::abs(volume / expected - 1.0) > kSame) {
    const auto thickest = std::ranges::max_element(faces, {}, [&](const FaceDepths& face) {
      return std::ranges::binary_search(out.rims, face.face) ? face.area : 0.0;
    });
    throw NumericsError(fmt::format(
        "the solid is no sheet of {:.4g} {}: its volume is {:+.2g} of its area times that, and {} "
        "is of no side{}",
        t, unit, volume / expected - 1.0, place_of(*thickest), kWayOut));
  }
  constexpr double kHeavy = 0.03;
  if (const double more = t * area_of_group(groups[0]) / volume - 1.0; more > kHeavy)
    warn(fmt::format(
        "sheet of {:.4g} {}: its larger side, which is meshed, is {:.2g} % larger than the "
        "mid-surface, as at sharp corners: it weighs so much more and is softer by about as much; "
        "kind = \"cad\" meshes the solid, and a mid-surface of the CAD program has neither error",
        t, unit, 100.0 * more));
  out.outer = std::move(groups[0]);
  out.inner = std::move(groups[1]);
  return out;
}

}  // namespace clatter::mesh
