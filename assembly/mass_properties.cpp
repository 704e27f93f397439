#include "assembly/mass_properties.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "assembly/element.hpp"
#include "assembly/quadrature.hpp"
#include "assembly/shape.hpp"

namespace clatter::assembly {
namespace {

template <int N>
std::vector<ShapeAt<N, 3>> shapes_at(const TetRule& rule) {
  std::vector<ShapeAt<N, 3>> shapes;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    shapes.push_back(tet_shape<N>(rule.points.row(q).transpose()));
  return shapes;
}

template <int N>
void add_block(const mesh::Mesh& mesh, const mesh::CellBlock& block, double density,
               MassMoments& sum) {
  // x x^T has degree 2 on a straight cell, 4 with det J of degree 3 on a curved one.
  static const std::vector<ShapeAt<N, 3>> straight = shapes_at<N>(tet_rule_4());
  static const std::vector<ShapeAt<N, 3>> curved = shapes_at<N>(tet_rule_64());
  for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
    CellNodes<N> x;
    for (int a = 0; a < N; ++a) x.row(a) = mesh.nodes.row(block.nodes(c, a));
    const bool simple = is_straight<N>(x);
    const std::vector<ShapeAt<N, 3>>& shapes = simple ? straight : curved;
    const Eigen::VectorXd& weights = simple ? tet_rule_4().weights : tet_rule_64().weights;
    for (size_t q = 0; q < shapes.size(); ++q) {
      const Eigen::Vector3d at = x.transpose() * shapes[q].value;
      const double dm = density * weights(static_cast<Eigen::Index>(q)) *
                        (x.transpose() * shapes[q].gradient).determinant();
      sum.mass += dm;
      sum.first += dm * at;
      sum.second += dm * at * at.transpose();
    }
  }
}

Eigen::Matrix3d inertia_of(const Eigen::Matrix3d& second) {
  return second.trace() * Eigen::Matrix3d::Identity() - second;
}

}  // namespace

MassMoments integrate_mass(const mesh::Mesh& mesh, const std::vector<Material>& materials) {
  MassMoments sum;
  for (const mesh::CellBlock& block : mesh.cells) {
    const double density = materials.at(static_cast<size_t>(block.region)).density;
    if (block.type == mesh::CellType::kTet4)
      add_block<4>(mesh, block, density, sum);
    else
      add_block<10>(mesh, block, density, sum);
  }
  return sum;
}

void add_point(MassMoments& moments, double mass, const Eigen::Vector3d& place,
               const Eigen::Matrix3d& inertia) {
  moments.mass += mass;
  moments.first += mass * place;
  // J = tr(S) I - S has the inverse S = tr(J)/2 I - J.
  moments.second += mass * place * place.transpose() +
                    0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia;
}

MassProperties properties_of(const MassMoments& moments) {
  MassProperties out;
  out.mass = moments.mass;
  out.centre = moments.first / moments.mass;
  out.inertia = inertia_of(moments.second - moments.mass * out.centre * out.centre.transpose());
  return out;
}

MassProperties properties_of(const SparseMatrix& M, const Eigen::MatrixXd& rigid) {
  const Eigen::Matrix<double, 6, 6> mass = rigid.transpose() * multiply_symmetric(M, rigid);
  MassProperties out;
  out.mass = mass.topLeftCorner<3, 3>().trace() / 3.0;
  // Column 3 + j holds the momentum of a unit spin about j: e_j x (m c).
  out.centre =
      Eigen::Vector3d(mass(1, 5) - mass(2, 4), mass(2, 3) - mass(0, 5), mass(0, 4) - mass(1, 3)) /
      (2.0 * out.mass);
  const double m = out.mass;
  out.inertia = mass.bottomRightCorner<3, 3>() -
                inertia_of(Eigen::Matrix3d(m * out.centre * out.centre.transpose()));
  return out;
}

MassDifference compare(const MassProperties& a, const MassProperties& b) {
  const double gyration = std::sqrt(b.inertia.trace() / (2.0 * b.mass));
  return {std::abs(a.mass - b.mass) / b.mass, (a.centre - b.centre).norm() / gyration,
          (a.inertia - b.inertia).cwiseAbs().maxCoeff() / b.inertia.trace()};
}

}  // namespace clatter::assembly
