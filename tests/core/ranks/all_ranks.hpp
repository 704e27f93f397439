// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The ranks under which the tests of this folder run.
#include "core/ranks/ranks.hpp"

namespace clatter::test {

/// All ranks, from the start of main() on; every test is collective.
const ranks::Ranks& all_ranks();

}  // namespace clatter::test
