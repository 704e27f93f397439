#pragma once
// Text in XML.
#include <string>
#include <string_view>

namespace clatter {

/// With & < > " as entities, for attributes and content.
std::string escape_xml(std::string_view text);

}  // namespace clatter
