// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// XML escapes.
#include <string>
#include <string_view>

namespace clatter {

/// Replaces & < > " by entities, for attributes and content.
std::string escape_xml(std::string_view text);

}  // namespace clatter
