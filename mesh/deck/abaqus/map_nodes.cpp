// SPDX-License-Identifier: GPL-3.0-or-later
// *NMAP: the coordinates of nodes are in a system of their own, whose basic ones replace them.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "mesh/deck/abaqus/generator.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr double kFlat = 1e-9;  // volume of unit vectors: coordinates have few digits

class NodeMapping : Generator {
 public:
  using Generator::Generator;

  void run() {
    keyword_.allow({"NSET", "TYPE", "DEFINITION"}, source_, ignore_);
    type_ = keyword_.choice("TYPE", "");
    if (keyword_.choice("DEFINITION", "COORDINATES") != "COORDINATES")
      source_.fail(card_.origin(), "*NMAP: expected DEFINITION=COORDINATES");
    if (type_ != "RECTANGULAR" && type_ != "CYLINDRICAL" && type_ != "SPHERICAL" &&
        type_ != "DIAMOND")
      source_.fail(card_.origin(),
                   fmt::format("*NMAP: TYPE={} is not supported, expected RECTANGULAR, "
                               "CYLINDRICAL, SPHERICAL or DIAMOND; *NODE with the mapped "
                               "coordinates replaces others",
                               keyword_.required("TYPE", source_)));
    if (card_.size() < 1 || card_.size() > 3)
      source_.fail(card_.origin(), fmt::format("*NMAP: found {} data lines, expected one to three: "
                                               "points a and b, point c, scales",
                                               card_.size()));
    read_axes();
    const std::vector<int32_t> ids = set(scope_.node_sets, keyword_.required("NSET", source_));
    for (size_t row = 0; row < scope_.nodes.ids.size(); ++row)
      if (std::binary_search(ids.begin(), ids.end(), scope_.nodes.ids[row])) {
        Eigen::Map<Eigen::Vector3d> x(scope_.nodes.xyz.data() + 3 * row);
        x = mapped(x);
      }
  }

 private:
  // Points a, b; c, of DIAMOND d as well; scales, of which blank or 0 is 1.
  void read_axes() {
    const Fields first = card_.line(0, source_);
    first.at_most(6, "points a and b");
    origin_ = point(first, 0);
    if (card_.size() > 2) {
      const Fields third = card_.line(2, source_);
      third.at_most(3, "scales");
      for (size_t k = 0; k < 3; ++k)
        if (const double scale = third.number_or(k, "scale", 0.0); scale != 0.0)
          scale_[static_cast<int>(k)] = scale;
    }
    if (type_ == "RECTANGULAR" && first.size() <= 3 &&
        (card_.size() < 2 || card_.line(1, source_).size() == 0))
      return;  // a shift
    if (first.size() <= 3 || card_.size() < 2)
      source_.fail(card_.origin(),
                   "*NMAP: expected the points a and b in the first line and c in "
                   "the second");
    const Fields second = card_.line(1, source_);
    second.at_most(type_ == "DIAMOND" ? 6 : 3, type_ == "DIAMOND" ? "points c and d" : "point c");
    const Eigen::Vector3d b = (point(first, 3) - origin_).normalized(),
                          c = (point(second, 0) - origin_).normalized();
    if (type_ == "DIAMOND") {
      axes_ << b, c, (point(second, 3) - origin_).normalized();
    } else {
      const Eigen::Vector3d normal = b.cross(c).normalized();
      // c lies in the plane of the axis b and of the first or second one.
      if (type_ == "RECTANGULAR")
        axes_ << b, normal.cross(b), normal;
      else
        axes_ << normal.cross(b), normal, b;
      if (!(b.cross(c).norm() > kFlat)) axes_.setZero();
    }
    if (!(std::abs(axes_.determinant()) > kFlat))
      source_.fail(card_.origin(), "*NMAP: its points lie on a line or in a plane, expected axes");
  }

  static Eigen::Vector3d point(const Fields& fields, size_t first) {
    Eigen::Vector3d x;
    for (size_t k = 0; k < 3; ++k)
      x[static_cast<int>(k)] = fields.number_or(first + k, "coordinate", 0.0);
    return x;
  }

  Eigen::Vector3d mapped(const Eigen::Vector3d& x) const {
    const char kind = type_ == "CYLINDRICAL" ? 'C' : type_ == "SPHERICAL" ? 'S' : 'R';
    return origin_ + axes_ * cartesian(kind, x.cwiseProduct(scale_));
  }

  std::string type_;
  Eigen::Vector3d origin_, scale_ = Eigen::Vector3d::Ones();
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();
};

}  // namespace

void map_nodes(const Card& card, Scope& scope, const Source& source, Ignore& ignore) {
  NodeMapping(card, scope, source, ignore).run();
}

}  // namespace clatter::mesh::deck::abaqus
