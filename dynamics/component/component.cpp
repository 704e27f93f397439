// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/component.hpp"

#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

void Component::record(const System& system, const StageState&, History& history) const {
  for (int e = elements_.first; e < elements_.end; ++e) system.element(e).record(history);
}

}  // namespace clatter::dynamics
