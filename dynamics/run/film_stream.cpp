// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/film_stream.hpp"

#include <numbers>

#include "core/run/run_layout.hpp"

namespace clatter::dynamics {

void FilmStream::add() {
  for (const film::PadSnapshot& pad : contact_->snapshot()) {
    const std::string group = run::path(group_, pad.name);
    if (first_) {
      file_->write(run::path(group, "angle_deg"),
                   Eigen::VectorXd(pad.angle * (180.0 / std::numbers::pi)));
      file_->write(run::path(group, "axial"), pad.axial);
      if (pad.liner_height.size() > 0)
        file_->write(run::path(group, "liner_height"), pad.liner_height);
    }
    fields_.add(run::path(group, "gap"), pad.gap);
    fields_.add(run::path(group, "pressure"), pad.pressure);
    fields_.add(run::path(group, "fill"), pad.fill);
    fields_.add(run::path(group, "contact_pressure"), pad.contact_pressure);
    fields_.add(run::path(group, "liner_oil"), pad.liner_oil);
  }
  first_ = false;
}

}  // namespace clatter::dynamics
