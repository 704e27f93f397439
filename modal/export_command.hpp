// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-modal export part.modes.h5 shapes.vtu
#include "core/base/command_line.hpp"

namespace clatter::modal {

/// Adds the command `export`: files of modes and statics for ParaView.
void declare_export(CommandLine& program);

}  // namespace clatter::modal
