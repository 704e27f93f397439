// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Implementation of config: the document shared by all tables of one file. Included by
// core/base/config*.cpp only, so that toml++ types stay hidden.
#include <toml++/toml.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/config.hpp"

namespace clatter {

struct Config::Document {
  toml::table root;
  std::string origin;                        // file name for messages
  std::filesystem::path folder;              // relative paths refer to it
  std::vector<std::filesystem::path> files;  // files read
  double metre = 1.0;                        // lengths of the file [m]
  std::set<const toml::node*> known;         // values and tables that were read
  std::map<const toml::table*, std::set<std::string>> requested;  // keys read, found or not
  std::vector<std::pair<std::string, std::string>> resolved;      // in order of reading
};

struct Config::Node {
  const toml::table* table;
  std::string prefix;                     // "contact.film." for messages
  std::shared_ptr<Node> below = nullptr;  // has the keys that this table lacks
};

/// "file:line" of a node; only the origin when the node has no source position.
std::string position_in_file(const std::string& origin, const toml::node* node);

}  // namespace clatter
