// SPDX-License-Identifier: GPL-3.0-or-later
// Asperity pressure of the piston-liner contact, elastic or damped.
#include "dynamics/film/pad_state.hpp"

namespace clatter::film {

void PistonLiner::update_contact(Pad& pad) {
  for (Eigen::Index c = 0; c < pad.gap.size(); ++c) {
    const Asperity::Contact contact = asperity_->at(pad.gap[c]);
    pad.contact[c] = contact.pressure;
    pad.contact_slope[c] = contact.slope;
    pad.contact_energy[c] = contact.energy;
  }
  if (pad.recesses)
    for (Eigen::ArrayXd* values : {&pad.contact, &pad.contact_slope, &pad.contact_energy})
      *values *= 1.0 - pad.recesses->cells.share;
  pad.contact_elastic = pad.contact;
  if (damping_) damp_contact(pad);
  pad.load += pad.area * pad.contact;
}

// From the elastic pressure to the damped one, where there is any.
void PistonLiner::damp_contact(Pad& pad) {
  pad.contact_rate_slope.setZero();
  pad.contact_loss.setZero();
  if ((pad.contact == 0.0).all()) return;
  const Eigen::VectorXd rates = pad.gap_by_y * pad.v;
  for (Eigen::Index c = 0; c < pad.gap.size(); ++c) {
    const double elastic = pad.contact[c];
    if (elastic == 0.0) continue;
    double rate = rates[c] + pad.gap_by_height[c] * stroke_.velocity;
    if (pad.scaled) rate += pad.scaled->rate()[c];
    const ContactDamping::Ratio ratio = damping_->at(rate);
    pad.contact[c] *= ratio.value;
    pad.contact_slope[c] *= ratio.value;
    pad.contact_rate_slope[c] = elastic * ratio.slope;
    pad.contact_loss[c] = elastic * (1.0 - ratio.value) * rate;
  }
}

// dh'/dy at fixed stage: v changes with y / kappa, and the liner's weights move with the stroke.
void PistonLiner::update_rate_tangent(Pad& pad, double kappa, const Eigen::VectorXd& v) {
  Eigen::ArrayXd turning = pad.gap_by_height / kappa;
  pad.map.add_slope(v, turning);
  if (pad.scaled) turning += pad.scaled->rate_slope();
  pad.map.rows(1.0 / kappa, stroke_height(stroke_.velocity, v), turning, pad.rate_by_y);
}

}  // namespace clatter::film
