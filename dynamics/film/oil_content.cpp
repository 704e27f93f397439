// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/oil_content.hpp"

#include <algorithm>

namespace clatter::film {

OilContent::OilContent(const Reynolds& film, bool by_flows) : by_flows_(by_flows) {
  const int n = film.grid().size();
  for (Eigen::ArrayXd* values : {&content_, &profile_, &before_, &stage_content_, &stage_profile_})
    values->setZero(n);
  for (Eigen::ArrayXd& rate : rates_) rate.setZero(n);
  for (Eigen::ArrayXd& flow : flows_) flow.setZero(film.flows().size());
  sent_.setZero(film.flows().size());
}

void OilContent::start(const Eigen::ArrayXd& content) {
  content_ = content;
  for (Eigen::ArrayXd& rate : rates_) rate.setZero();
  for (Eigen::ArrayXd& flow : flows_) flow.setZero();
}

const Eigen::ArrayXd& OilContent::before(const Reynolds& film, const std::vector<double>& weights) {
  before_ = content_;
  for (size_t j = 0; j < weights.size(); ++j) before_ += weights[j] * rates_[j];
  limited_ = film.cavitation() && before_.minCoeff() < 0.0;
  if (limited_) {
    sent_.setZero();
    for (size_t j = 0; j < weights.size(); ++j) sent_ += weights[j] * flows_[j];
    film.pad().limit_outflow(content_, sent_, before_);
  }
  return before_;
}

void OilContent::volumes(const Reynolds& film, const std::vector<double>& weights, double kappa,
                         Eigen::ArrayXd& moved) const {
  moved = kappa * film.flows();
  if (limited_) {
    moved += sent_;
    return;
  }
  for (size_t j = 0; j < weights.size(); ++j) moved += weights[j] * flows_[j];
}

void OilContent::finish_stage(const Reynolds& film, const Eigen::ArrayXd& space, int index,
                              double kappa) {
  if (by_flows_) {
    film.pad().leaving(film.flows(), stage_content_);
    stage_content_ = (before_ - kappa * stage_content_).max(0.0);  // below by rounding
  } else {
    stage_content_ = film.density() * space;
  }
  stage_profile_ = film.profile();
  rates_.at(index) = (stage_content_ - before_) / kappa;
  flows_.at(index) = film.flows();
  last_ = index;
}

void OilContent::accept_step() {
  content_ = stage_content_;
  profile_ = stage_profile_;
  if (last_ == 0) return;
  rates_[0] = rates_[last_];
  flows_[0] = flows_[last_];
}

void OilContent::save(std::vector<double>& state) const {
  for (const Eigen::ArrayXd* values : {&content_, &profile_, &rates_[0], &flows_[0]})
    state.insert(state.end(), values->begin(), values->end());
}

size_t OilContent::saved_size() const {
  return static_cast<size_t>(3 * content_.size() + flows_[0].size());
}

std::vector<double>::const_iterator OilContent::restore(std::vector<double>::const_iterator next) {
  for (Eigen::ArrayXd* values : {&content_, &profile_, &rates_[0], &flows_[0]}) {
    std::copy(next, next + values->size(), values->begin());
    next += values->size();
  }
  return next;
}

}  // namespace clatter::film
