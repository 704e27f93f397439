// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/oil_content.hpp"

#include <algorithm>

namespace clatter::film {

OilContent::OilContent(const Reynolds& film) {
  const int n = film.grid().size();
  for (Eigen::ArrayXd* values : {&content_, &profile_, &before_, &stage_content_, &stage_profile_})
    values->setZero(n);
  for (auto* stages : {&flows_, &carried_})
    for (Eigen::ArrayXd& flow : *stages) flow.setZero(film.flows().size());
  for (Eigen::ArrayXd* volumes : {&sent_, &moved_, &carried_moved_})
    volumes->setZero(film.flows().size());
}

void OilContent::start(const Eigen::ArrayXd& content) {
  content_ = content;
  for (auto* stages : {&flows_, &carried_})
    for (Eigen::ArrayXd& flow : *stages) flow.setZero();
}

const Eigen::ArrayXd& OilContent::before(const Reynolds& film, const std::vector<double>& weights,
                                         const KnownFlows* known) {
  sent_.setZero();
  for (size_t j = 0; j < weights.size(); ++j) sent_ += weights[j] * flows_[j];
  for (size_t k = 0; known != nullptr && k < known->at.size(); ++k) {
    if (!known->at[k]) continue;
    const auto flow = static_cast<Eigen::Index>(k);
    sent_[flow] += known->volume[flow];
    for (size_t j = 0; j < weights.size(); ++j) sent_[flow] -= weights[j] * carried_[j][flow];
  }
  film.pad().leaving(sent_, before_);
  before_ = content_ - before_;
  if (film.cavitation() && before_.minCoeff() < 0.0)
    film.pad().limit_outflow(content_, sent_, before_);
  return before_;
}

void OilContent::finish_stage(const Reynolds& film, int index, double kappa,
                              const std::vector<double>& weights, const KnownFlows* known) {
  film.pad().leaving(film.flows(), stage_content_);
  stage_content_ = before_ - kappa * stage_content_;
  if (film.cavitation()) stage_content_ = stage_content_.max(0.0);  // below by rounding
  stage_profile_ = film.profile();
  Eigen::ArrayXd &flows = flows_.at(index), &carried = carried_.at(index);
  flows = film.flows();
  carried = film.carried();
  moved_ = sent_ + kappa * flows;
  carried_moved_ = kappa * carried;
  for (size_t j = 0; j < weights.size(); ++j) carried_moved_ += weights[j] * carried_[j];
  for (size_t k = 0; known != nullptr && k < known->at.size(); ++k) {
    if (!known->at[k]) continue;
    const auto flow = static_cast<Eigen::Index>(k);
    carried_moved_[flow] = known->volume[flow];
    carried[flow] = known->rate[flow];
    flows[flow] += carried[flow];
  }
  last_ = index;
}

void OilContent::accept_step() {
  content_ = stage_content_;
  profile_ = stage_profile_;
  if (last_ == 0) return;
  flows_[0] = flows_[last_];
  carried_[0] = carried_[last_];
}

void OilContent::save(std::vector<double>& state) const {
  for (const Eigen::ArrayXd* values : {&content_, &profile_, &flows_[0], &carried_[0]})
    state.insert(state.end(), values->begin(), values->end());
}

size_t OilContent::saved_size() const {
  return static_cast<size_t>(2 * (content_.size() + flows_[0].size()));
}

std::vector<double>::const_iterator OilContent::restore(std::vector<double>::const_iterator next) {
  for (Eigen::ArrayXd* values : {&content_, &profile_, &flows_[0], &carried_[0]}) {
    std::copy(next, next + values->size(), values->begin());
    next += values->size();
  }
  return next;
}

}  // namespace clatter::film
