// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-mesh cards
#include "core/base/command_line.hpp"

namespace clatter::mesh {

/// Adds the command `cards`: what the readers of decks read, pass over and refuse.
void declare_cards(CommandLine& program);

}  // namespace clatter::mesh
