// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/crank/film_bearing.hpp"

#include <algorithm>
#include <utility>

namespace clatter::dynamics {

FilmBearing::FilmBearing(std::string name, std::unique_ptr<Port> journal,
                         std::unique_ptr<Port> housing, const ShaftAxes& axes,
                         const Eigen::Vector3d& offset, const JournalFilmOptions& options)
    : FilmedBearing(std::move(name), std::move(journal), std::move(housing), axes, offset, {}),
      film_(options),
      pressure_name_(this->name() + "_pressure") {
  std::replace(pressure_name_.begin(), pressure_name_.end(), ' ', '_');
}

void FilmBearing::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                           bool with_tangent, Response& response) {
  stage_ = &stage;
  with_tangent_ = with_tangent;
  FilmedBearing::evaluate(stage, y, v, with_tangent, response);
  stage_ = nullptr;
}

FilmForce FilmBearing::film_force(const JournalMotion& motion) const {
  if (stage_ != nullptr) last_ = film_.force(motion, *stage_, with_tangent_, name());
  return last_;
}

void FilmBearing::begin_step(double time) {
  FilmedBearing::begin_step(time);
  stage_ = nullptr;  // a refused evaluation left it
  film_.begin_step();
}

void FilmBearing::finish_stage(const Stage& stage) {
  FilmedBearing::finish_stage(stage);
  film_.finish_stage(stage);
  finished_pressure_ = film_.film().pressure().maxCoeff();
}

void FilmBearing::accept_step(double time) {
  FilmedBearing::accept_step(time);
  film_.accept_step();
  pressure_ = finished_pressure_;
}

void FilmBearing::record(History& history) const {
  FilmedBearing::record(history);
  history.put(pressure_name_, "Pa", pressure_);
}

}  // namespace clatter::dynamics
