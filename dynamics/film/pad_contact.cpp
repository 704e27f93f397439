// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/pad_contact.hpp"

namespace clatter::film {

PadContact::PadContact(const ContactModel& model, int cells)
    : asperity_(*model.asperity), damping_(model.damping) {
  for (Eigen::ArrayXd* values : {&pressure_, &slope_, &energy_}) values->setZero(cells);
  if (!damping_) return;
  for (Eigen::ArrayXd* values : {&rate_slope_, &loss_}) values->setZero(cells);
}

void PadContact::set(const PadGap& gap, const PadState& state) {
  for (Eigen::Index c = 0; c < pressure_.size(); ++c) {
    const Asperity::Contact contact = asperity_.at(gap.value()[c]);
    pressure_[c] = contact.pressure;
    slope_[c] = contact.slope;
    energy_[c] = contact.energy;
  }
  if (const RecessCells* recesses = gap.recesses())
    for (Eigen::ArrayXd* values : {&pressure_, &slope_, &energy_}) *values *= 1.0 - recesses->share;
  elastic_ = pressure_;
  if (damping_) damp(gap, state);
}

// From the elastic pressure to the damped one, where there is any.
void PadContact::damp(const PadGap& gap, const PadState& state) {
  rate_slope_.setZero();
  loss_.setZero();
  if ((pressure_ == 0.0).all()) return;
  const Eigen::ArrayXd rates = gap.rate(state.v, state.pin.clock.velocity);
  for (Eigen::Index c = 0; c < pressure_.size(); ++c) {
    const double elastic = elastic_[c];
    if (elastic == 0.0) continue;
    const ContactDamping::Ratio ratio = damping_->at(rates[c]);
    pressure_[c] *= ratio.value;
    slope_[c] *= ratio.value;
    rate_slope_[c] = elastic * ratio.slope;
    loss_[c] = elastic * (1.0 - ratio.value) * rates[c];
  }
}

double PadContact::end_force(const PadGap& gap) const {
  return gap.cover() != nullptr ? -(gap.area_slope() * energy_).sum() : 0.0;
}

double PadContact::end_slope(const PadGap& gap) const {
  const PadGrid& grid = gap.grid();
  const Eigen::ArrayXd area_curve =
      grid.area() * gap.cover()->share_curve.replicate(grid.n_angle(), 1);
  return -(area_curve * energy_).sum();
}

double PadContact::groove_force(const PadGap& gap) const {
  double force = 0.0;
  const RecessCells& recesses = *gap.recesses();
  for (Eigen::Index c = 0; c < pressure_.size(); ++c)
    if (recesses.share_slope[c] != 0.0)
      force -= gap.area()[c] * recesses.share_slope[c] * asperity_.at(gap.value()[c]).energy;
  return force;
}

}  // namespace clatter::film
