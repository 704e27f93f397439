// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced coordinates of a piece of a run.
#include <optional>
#include <string>

#include "recover/options/piece.hpp"
#include "recover/run/run_input.hpp"

namespace clatter::recover {

/// "q" [m], "v" [m/s] or "a" [m/s2] of values `offset` to `offset` + `count` of a piece, count x r:
/// samples of the run, or over the angle values between them (resample.hpp). A negative offset is
/// before the piece. Nothing when the run does not cover them.
std::optional<RowMatrix> piece_samples(const RunBody& body, const Piece& piece,
                                       const std::string& quantity, int64_t offset, int64_t count);

/// All values of a piece, which the run covers.
RowMatrix piece_samples(const RunBody& body, const Piece& piece, const std::string& quantity);

}  // namespace clatter::recover
