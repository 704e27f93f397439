// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/bearing/film_bearing.hpp"

namespace clatter::dynamics {

void FilmBearing::finish_stage(const Stage& stage) {
  film_.finish_stage(stage);
  finished_pressure_ = film_.film().pressure().maxCoeff();
}

void FilmBearing::accept_step() {
  film_.accept_step();
  pressure_ = finished_pressure_;
}

void FilmBearing::record(const std::string& name, const PairMotion& motion, const PairForce& force,
                         History& history) const {
  FilmedBearing::record(name, motion, force, history);
  history.put(name + "_pressure", "Pa", pressure_);
}

}  // namespace clatter::dynamics
