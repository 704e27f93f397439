// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Numbers of a command line.
#include <string>
#include <vector>

namespace clatter::modal {

/// The text as comma-separated numbers; empty when it contains anything else.
std::vector<double> numbers_in(const std::string& text);

}  // namespace clatter::modal
