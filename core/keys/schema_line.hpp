// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The first line of a TOML file that clatter writes: editors then complete and explain its keys.
#include <string>

namespace clatter::keys {

/// "#:schema file:///usr/share/clatter/schemas/fe.schema.json\n" for "fe", from the installation or
/// build of the running program; "" where there are no schemas.
std::string schema_line(const std::string& kind);

}  // namespace clatter::keys
