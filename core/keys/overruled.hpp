// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Keys of a base that a file over it makes meaningless.
#include <map>
#include <string>

#include "core/keys/table.hpp"

namespace clatter::keys {

/// Keys of `config` that do not go with a key of a file over theirs, which holds: {key, that key}.
/// They exclude each other, or the upper one is a choice or flag without whose value the lower one
/// has no meaning. Keys of one file are not judged.
std::map<std::string, std::string> overruled_keys(const Table& table, const Config& config);

/// Says in a line each that they are left out, and why.
void report_overruled(const std::map<std::string, std::string>& overruled, const Config& config);

}  // namespace clatter::keys
