// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Grooves, holes and windows of skirt and liner: [[contact.recess]].
#include <vector>

#include "core/base/config.hpp"
#include "dynamics/film/recess.hpp"

namespace clatter::dynamics {

/// Reads all entries of `contact`.recess. InputError "file:line: key: ...".
std::vector<film::Recess> read_recesses(const Config& contact);

}  // namespace clatter::dynamics
