#include "assembly/centrifugal_load.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "mesh/quadrature.hpp"
#include "mesh/shape.hpp"
#include "mesh/validity.hpp"

namespace clatter::assembly {

Eigen::VectorXd centrifugal_load(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                                 const RotationAxis& axis, const std::vector<int32_t>& regions) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * mesh.nodes.rows());
  for (const mesh::CellBlock& block : mesh.cells) {
    if (!regions.empty() &&
        std::find(regions.begin(), regions.end(), block.region) == regions.end())
      continue;
    const double density = materials.at(static_cast<size_t>(block.region)).density;
    const mesh::CellRule& rule = mesh::fine_rule(block.type);
    std::vector<mesh::CellShape> shapes;
    for (const auto& point : rule.points.rowwise())
      shapes.push_back(mesh::cell_shape(block.type, point.transpose()));
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const mesh::CellNodes x = mesh::cell_nodes(mesh, block, c);
      for (size_t q = 0; q < shapes.size(); ++q) {
        const Eigen::Vector3d at = x.transpose() * shapes[q].value;
        const Eigen::Matrix3d J = x.transpose() * shapes[q].gradient;
        const double dm = density * rule.weights(static_cast<Eigen::Index>(q)) * J.determinant();
        const Eigen::Vector3d body = dm * axis.arm(at);
        for (Eigen::Index a = 0; a < x.rows(); ++a)
          force.segment<3>(3 * block.nodes(c, a)) += shapes[q].value(a) * body;
      }
    }
  }
  return force;
}

Eigen::Matrix<double, 6, 1> centrifugal_force(const PointMassSpec& mass,
                                              const Eigen::Vector3d& place,
                                              const RotationAxis& axis) {
  Eigen::Matrix<double, 6, 1> out;
  const Eigen::Vector3d& n = axis.direction;
  const Eigen::Vector3d force = mass.mass * axis.arm(place + mass.offset);
  out.head<3>() = force;
  out.tail<3>() = mass.offset.cross(force) - n.cross(Eigen::Vector3d(mass.inertia * n));
  return out;
}

}  // namespace clatter::assembly
