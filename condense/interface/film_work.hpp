// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Effect of an interface reduction on the work of film pressure.
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// Areas of the patches [m2], in the order of the grid's set.
Eigen::VectorXd patch_areas(const rom::ContactGrid& grid);

/// Pressures like those of a film between skirt and bore, at the patches, patches x 10: on each
/// side (the grid's zero angle and opposite) cos^2 of the angle within 90 deg, along the axis a
/// half sine over half of the grid's height, centred at 0.1, 0.3, 0.5, 0.7 and 0.9 of the height;
/// peak 1 Pa. A side without patches gives zeros.
Eigen::MatrixXd film_pressures(const rom::ContactGrid& grid);

/// Forces on the coordinates of `model` by these pressures on one of its grids, r x 10.
Eigen::MatrixXd film_forces(const rom::ReducedModel& model, const std::string& grid);

/// p^T A u of the static response u to each column of `forces`. Free motions are balanced by
/// inertia relief: (K + s M r r^T M) u = f - M r (r^T M r)^{-1} r^T f.
/// @param forces r x k; rigid r x m, the free motions. Returns k works [J].
Eigen::VectorXd static_work(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M,
                            const Eigen::MatrixXd& rigid, const Eigen::MatrixXd& forces);

}  // namespace clatter::condense
