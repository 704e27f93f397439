#pragma once
// Inner side of config: the document behind all tables of one file. Only core/base/config*.cpp
// include this; nobody else sees a toml++ type.
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
  std::filesystem::path folder;              // relative paths start here
  std::vector<std::filesystem::path> files;  // that were read
  std::set<const toml::node*> known;         // values and tables that somebody asked for
  std::map<const toml::table*, std::set<std::string>> asked;  // keys asked for, found or not
  std::vector<std::pair<std::string, std::string>> resolved;  // in order of asking
};

struct Config::Node {
  const toml::table* table;
  std::string prefix;  // "contact.film." for messages
};

/// "file:line" of a node; the origin alone when the node stands in no file.
std::string place_in_file(const std::string& origin, const toml::node* node);

}  // namespace clatter
