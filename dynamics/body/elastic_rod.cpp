// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/elastic_rod.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/error.hpp"
#include "core/dense/cholesky.hpp"

namespace clatter::dynamics {

using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Unit rigid motions about `centre` as sums of those about the origin.
Matrix6 motions_about(const Vector3d& centre) {
  Matrix6 motions = Matrix6::Identity();
  for (int k = 0; k < 3; ++k)
    motions.topRightCorner<3, 3>().col(k) = centre.cross(Vector3d::Unit(k));
  return motions;
}

/// Mass-normalised rigid motions without mass in common, as sums of unit motions about the centre
/// of mass: y, z, rx; then x, ry, rz, each with the rx that products of inertia give it.
Matrix6 normal_motions(const Matrix6& mass) {
  const int axes[] = {1, 2, 3, 0, 4, 5};
  Matrix6 order = Matrix6::Zero();
  for (int k = 0; k < 6; ++k) order(axes[k], k) = 1.0;
  const Matrix6 ordered = order.transpose() * mass * order;
  return order * Matrix6(dense::Cholesky(ordered).solve_upper(Matrix6::Identity()));
}

RodCoupling coupling_of(const ElasticRod& rod, const rom::InertiaInvariants& invariants) {
  const rom::InertiaInvariants by = invariants.in(rod.shapes);
  RodCoupling found;
  found.stretch =
      by.moment[4] + by.moment[8] - rod.centre.y() * by.first[1] - rod.centre.z() * by.first[2];
  found.square = by.product[4] + by.product[8];
  found.circulation = by.product[5] - by.product[7];
  found.inertia = rod.inertia;
  return found;
}

}  // namespace

ElasticRod make_elastic_rod(const rom::ReducedModel& model, const ModalBody& free) {
  if (free.rigid_modes != kRodRigid)
    throw InputError(
        fmt::format("{}: found {} rigid modes, expected the 6 of a rod without supports", free.name,
                    free.rigid_modes));
  if (model.inertia.empty())
    throw InputError(fmt::format(
        "{}: found no inertia invariants, expected those of a body that turns: condense "
        "the part with inertia_invariants = true",
        free.name));
  const int elastic = free.modes() - kRodRigid, n = free.modes() - kRodPlanar;
  // Of the six rigid motions about the origin.
  const Matrix6 at_origin = free.rigid.transpose() * free.rigid;
  ElasticRod rod;
  rod.centre = Vector3d(at_origin(1, 5), -at_origin(0, 5), at_origin(0, 4)) / at_origin(0, 0);
  const Matrix6 motions = motions_about(rod.centre);
  const Matrix6 mass = motions.transpose() * at_origin * motions, normal = normal_motions(mass);
  rod.inertia = mass(3, 3);
  rod.shapes.resize(model.size(), n);
  rod.shapes.leftCols<kRodPlanar>() = model.rigid * motions * normal.rightCols<kRodPlanar>();
  rod.shapes.rightCols(elastic) = free.shapes.rightCols(elastic);
  rod.coupling = coupling_of(rod, model.inertia);

  rod.body = free;
  rod.body.shapes.setZero(kRodPlanar + model.size(), free.modes());
  rod.body.shapes.topLeftCorner<kRodPlanar, kRodPlanar>() =
      mass.diagonal().segment<kRodPlanar>(1).cwiseSqrt().cwiseInverse().asDiagonal();
  rod.body.shapes.bottomRightCorner(model.size(), n) = rod.shapes;
  if (model.combined.rows() > 0) {
    rod.body.combined.setZero(model.combined.rows(), free.modes());
    rod.body.combined.rightCols(n) = model.combined * rod.shapes;
  }
  rod.body.rigid.setZero(free.modes(), 6);
  rod.body.rigid.topRows<kRodRigid>() = normal.transpose() * mass;
  rod.body.is_rotation.insert(rod.body.is_rotation.begin(), {0, 0, 1});
  rod.body.mass = mass(0, 0);
  return rod;
}

RodProperties rod_properties(const ElasticRod& rod, const Vector3d& big, const Vector3d& small) {
  const Vector3d centre = rod.centre - big;
  return {(small - big).norm(), rod.body.mass, rod.inertia, centre.z(), centre.y()};
}

}  // namespace clatter::dynamics
