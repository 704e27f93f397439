// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/cycle_scale.hpp"

#include <utility>

namespace clatter::film {

void CycleScales::add(std::function<ScaleState(double time)> scale) {
  laws_.push_back(std::move(scale));
  now_.emplace_back();
  rates_.push_back({});
}

ScaleState CycleScales::law_at(size_t law, double time,
                               const dynamics::Motion<double>& lead) const {
  ScaleState state = laws_[law](time + lead.position);
  state.rate *= 1.0 + lead.velocity;
  return state;
}

const std::vector<ScaleState>& CycleScales::at(const dynamics::Stage& stage,
                                               const dynamics::CrankLead& lead) {
  for (size_t k = 0; k < laws_.size(); ++k) {
    const ScaleState start = law_at(k, stage.begin(), lead.begin);
    const double rate = law_at(k, stage.time, lead.now).rate;
    double value = start.value + stage.kappa * rate;
    for (size_t j = 0; j < stage.weights.size(); ++j)
      value += stage.weights[j] * (j == 0 ? start.rate : rates_[k].at(j));
    now_[k] = {value, rate};
  }
  return now_;
}

std::vector<ScaleState> CycleScales::exact(double time,
                                           const dynamics::Motion<double>& lead) const {
  std::vector<ScaleState> all;
  for (size_t k = 0; k < laws_.size(); ++k) all.push_back(law_at(k, time, lead));
  return all;
}

void CycleScales::finish_stage(const dynamics::Stage& stage) {
  for (size_t k = 0; k < laws_.size(); ++k) rates_[k].at(stage.index) = now_[k].rate;
}

void ScaledGap::add_skirt(const LinerShape& shape) {
  Eigen::ArrayXd value = Eigen::ArrayXd::Zero(pad_.size()), slope = value;
  LinerShapeMap(shape, pad_).add(0.0, value, slope);
  skirt_.push_back(std::move(value));
}

void ScaledGap::add(double height, const std::vector<ScaleState>& scales, Eigen::ArrayXd& gap,
                    Eigen::ArrayXd& slope) {
  rate_.setZero(pad_.size());
  rate_slope_.setZero(pad_.size());
  for (size_t k = 0; k < bore_.size(); ++k) {
    value_.setZero(pad_.size());
    value_slope_.setZero(pad_.size());
    bore_[k].add(height, value_, value_slope_);
    gap += scales[k].value * value_;
    slope += scales[k].value * value_slope_;
    rate_ += scales[k].rate * value_;
    rate_slope_ += scales[k].rate * value_slope_;
  }
  for (size_t k = 0; k < skirt_.size(); ++k) {
    const ScaleState& scale = scales[bore_.size() + k];
    gap -= scale.value * skirt_[k];
    rate_ -= scale.rate * skirt_[k];
  }
}

}  // namespace clatter::film
