// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/first_frequency.hpp"

#include "core/base/plausible.hpp"

namespace clatter::modal {

void warn_of_first_frequency(const modes::PartModes& part) {
  const Eigen::VectorXd hz = part.modes.frequencies_hz();
  if (hz.size() <= part.modes.rigid || part.nodes.rows() < 2) return;
  const double length =
      (part.nodes.colwise().maxCoeff() - part.nodes.colwise().minCoeff()).maxCoeff();
  warn_implausible(part.name, {first_frequency_warning(hz[part.modes.rigid], length)});
}

}  // namespace clatter::modal
