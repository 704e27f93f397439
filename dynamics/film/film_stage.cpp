// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/film_stage.hpp"

namespace clatter::film {

void FilmCells::resize(int n) {
  for (Eigen::ArrayXd* values : {&content, &d_content, &flow_angle, &d_flow_angle, &flow_axial,
                                 &d_flow_axial, &carry, &d_carry})
    values->setZero(n);
}

void FilmCells::set_smooth(const Eigen::ArrayXd& h) {
  for (Eigen::ArrayXd* values : {&content, &flow_angle, &flow_axial, &carry}) *values = h;
  for (Eigen::ArrayXd* values : {&d_content, &d_flow_angle, &d_flow_axial, &d_carry})
    values->setOnes(h.size());
}

}  // namespace clatter::film
