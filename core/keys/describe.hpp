// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Tables of keys as text for people and as JSON for programs.
#include <string>
#include <vector>

#include "core/base/command_line.hpp"
#include "core/keys/table.hpp"

namespace clatter::keys {

/// The table with all below it, as one JSON object: name, meaning, one_of, complete (false: what it
/// lacks may come from elsewhere), and keys with name,
/// type, types (of either), unit, min, max, above (the least value itself is refused), count,
/// choices, default, required, ascending, rules, meaning, shape, table.
std::string json_of(const Table& table);

/// A line or two for each key: "  bore_mm  number above 0, required: diameter of the bore".
std::string text_of(const Table& table);

/// The same for what `path` names, keys and tables separated by dots: "window.taper"; for "" all.
/// InputError with the nearest names when there is no such key.
std::string text_of(const Table& table, const std::string& path);

/// Adds the command `keys` that prints what may be in the program's TOML files: all tables, one, or
/// one key; with --json the whole as one line {"files": [...]} of json_of().
void add_keys_command(CommandLine& program, std::vector<const Table*> files);

}  // namespace clatter::keys
