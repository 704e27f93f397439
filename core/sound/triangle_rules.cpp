// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/triangle_rules.hpp"

#include <array>
#include <cmath>

namespace clatter::sound {
namespace {

/// Adds the three points with shape functions (a, b, b) and permutations.
void add_orbit(double a, double b, double weight, int first, TriangleRule& rule) {
  for (int corner = 0; corner < 3; ++corner) {
    rule.shape.col(first + corner).setConstant(b);
    rule.shape(corner, first + corner) = a;
    rule.weight[first + corner] = weight;
  }
}

TriangleRule make_three_points() {
  TriangleRule rule{Eigen::Matrix3Xd(3, 3), Eigen::VectorXd(3)};
  add_orbit(2.0 / 3.0, 1.0 / 6.0, 1.0 / 3.0, 0, rule);
  return rule;
}

TriangleRule make_six_points() {
  TriangleRule rule{Eigen::Matrix3Xd(3, 6), Eigen::VectorXd(6)};
  add_orbit(0.816847572980459, 0.091576213509771, 0.109951743655322, 0, rule);
  add_orbit(0.108103018168070, 0.445948490915965, 0.223381589678011, 3, rule);
  return rule;
}

/// Gauss points on [0, 1].
constexpr std::array<double, 4> kPoint = {0.069431844202973712, 0.330009478207571868,
                                          0.669990521792428132, 0.930568155797026288};
constexpr std::array<double, 4> kWeight = {0.173927422568726929, 0.326072577431273071,
                                           0.326072577431273071, 0.173927422568726929};

/// A point of the reference triangle 0 <= v <= u <= 1 with corners (0, 0), (1, 0), (1, 1).
struct Reference {
  double u, v;
  Eigen::Vector3d shape() const { return {1.0 - u, u - v, v}; }
};

/// Collects pairs of points; the weight of the reference triangles is 1/4.
class PairBuilder {
 public:
  void add(const Reference& x, const Reference& y, double weight) {
    x_.push_back(x.shape());
    y_.push_back(y.shape());
    weight_.push_back(4.0 * weight);
  }
  PairRule rule() const {
    const auto n = static_cast<Eigen::Index>(weight_.size());
    PairRule rule{Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n), Eigen::VectorXd(n)};
    for (Eigen::Index k = 0; k < n; ++k) {
      rule.shape_x.col(k) = x_[k];
      rule.shape_y.col(k) = y_[k];
      rule.weight[k] = weight_[k];
    }
    return rule;
  }

 private:
  std::vector<Eigen::Vector3d> x_, y_;
  std::vector<double> weight_;
};

/// Calls visit(s, a, b, c, weight) at the Gauss points of the unit cube of four dimensions.
template <class Visit>
void each_point(const Visit& visit) {
  for (size_t i = 0; i < 4; ++i)
    for (size_t j = 0; j < 4; ++j)
      for (size_t k = 0; k < 4; ++k)
        for (size_t l = 0; l < 4; ++l)
          visit(kPoint[i], kPoint[j], kPoint[k], kPoint[l],
                kWeight[i] * kWeight[j] * kWeight[k] * kWeight[l]);
}

PairRule same_triangle() {
  PairBuilder pairs;
  each_point([&](double s, double a, double b, double c, double gauss) {
    const double w = gauss * s * s * s * a * a * b;
    const Reference halves[3][2] = {
        {{s, s * (1 - a + a * b)}, {s * (1 - a * b * c), s * (1 - a)}},
        {{s, s * a * (1 - b + b * c)}, {s * (1 - a * b), s * a * (1 - b)}},
        {{s * (1 - a * b * c), s * a * (1 - b * c)}, {s, s * a * (1 - b)}}};
    for (const auto& half : halves) {
      pairs.add(half[0], half[1], w);
      pairs.add(half[1], half[0], w);
    }
  });
  return pairs.rule();
}

PairRule common_edge() {
  PairBuilder pairs;
  each_point([&](double s, double a, double b, double c, double gauss) {
    const double w = gauss * s * s * s * a * a;
    pairs.add({s, s * a * c}, {s * (1 - a * b), s * a * (1 - b)}, w);
    pairs.add({s, s * a}, {s * (1 - a * b * c), s * a * b * (1 - c)}, w * b);
    pairs.add({s * (1 - a * b), s * a * (1 - b)}, {s, s * a * b * c}, w * b);
    pairs.add({s * (1 - a * b * c), s * a * b * (1 - c)}, {s, s * a}, w * b);
    pairs.add({s * (1 - a * b * c), s * a * (1 - b * c)}, {s, s * a * b}, w * b);
  });
  return pairs.rule();
}

PairRule common_vertex() {
  PairBuilder pairs;
  each_point([&](double s, double a, double b, double c, double gauss) {
    const double w = gauss * s * s * s * b;
    const Reference whole{s, s * a}, part{s * b, s * b * c};
    pairs.add(whole, part, w);
    pairs.add(part, whole, w);
  });
  return pairs.rule();
}

}  // namespace

const TriangleRule& three_points() {
  static const TriangleRule rule = make_three_points();
  return rule;
}

const TriangleRule& six_points() {
  static const TriangleRule rule = make_six_points();
  return rule;
}

const PairRule& touching_rule(Contact contact) {
  static const PairRule same = same_triangle(), edge = common_edge(), vertex = common_vertex();
  if (contact == Contact::kSame) return same;
  return contact == Contact::kEdge ? edge : vertex;
}

}  // namespace clatter::sound
