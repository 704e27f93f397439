// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cards_command.hpp"

#include "core/base/log.hpp"
#include "mesh/deck/cards_page.hpp"

namespace clatter::mesh {

void declare_cards(CommandLine& program) {
  CommandLine& line = program.command(
      "cards", "Lists the cards and keywords of decks: read, passed over, refused (Markdown).",
      "sample: clatter-mesh cards > docs/cards.md");
  line.action([](const CommonOptions&) {
    for (const std::string& text : deck::cards_page()) print_result(text);
  });
}

}  // namespace clatter::mesh
