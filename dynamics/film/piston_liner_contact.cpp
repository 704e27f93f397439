// SPDX-License-Identifier: GPL-3.0-or-later
// Asperity pressure of the piston-liner contact, elastic or damped.
#include "dynamics/film/pad_state.hpp"

namespace clatter::film {

void PistonLiner::update_contact(Pad& pad, const Eigen::VectorXd& v) {
  for (Eigen::Index c = 0; c < pad.gap.size(); ++c) {
    const Asperity::Contact contact = asperity_->at(pad.gap[c]);
    pad.contact[c] = contact.pressure;
    pad.contact_slope[c] = contact.slope;
    pad.contact_energy[c] = contact.energy;
  }
  pad.contact_elastic = pad.contact;
  if (damping_) damp_contact(pad, v);
  pad.load += pad.area * pad.contact;
}

// From the elastic pressure to the damped one, where there is any.
void PistonLiner::damp_contact(Pad& pad, const Eigen::VectorXd& v) {
  pad.contact_rate_slope.setZero();
  pad.contact_loss.setZero();
  for (Eigen::Index c = 0; c < pad.gap.size(); ++c) {
    const double elastic = pad.contact[c];
    if (elastic == 0.0) continue;
    const double rate = pad.gap_by_y.row(c).dot(v) + pad.gap_by_height[c] * stroke_.velocity;
    const ContactDamping::Ratio ratio = damping_->at(rate);
    pad.contact[c] *= ratio.value;
    pad.contact_slope[c] *= ratio.value;
    pad.contact_rate_slope[c] = elastic * ratio.slope;
    pad.contact_loss[c] = elastic * (1.0 - ratio.value) * rate;
  }
}

// dh'/dy at fixed stage: v changes with y / kappa, and the liner's weights move with the stroke.
void PistonLiner::update_rate_tangent(Pad& pad, double kappa, const Eigen::VectorXd& v) {
  pad.rate_by_y = pad.gap_by_y / kappa;
  if (!pad.liner_map) return;
  const double sliding = stroke_height(stroke_.velocity, v);  // rate of the height
  const Eigen::VectorXd turning = pad.liner_slopes * v.segment(n_piston_, n_liner_);
  pad.rate_by_y.middleCols(n_piston_, n_liner_) += sliding * pad.liner_slopes;
  pad.rate_by_y += turning * height_by_y_.transpose();
}

}  // namespace clatter::film
