// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// docs/cards.md: the cards and keywords of both readers, from their own tables.
#include <string>
#include <vector>

namespace clatter::mesh::deck {

/// Lines of Markdown.
std::vector<std::string> cards_page();

}  // namespace clatter::mesh::deck
