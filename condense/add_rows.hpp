// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rows of T for more surfaces and sets of a part that is already condensed.
#include <string>
#include <vector>

#include "condense/condense.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fe/fe_model.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// The request of a reduced model, as stored in its file.
struct StoredRequest {
  std::string text;          // the .rom.toml, verbatim
  std::string model_path;    // the .fe.h5 ...
  std::string model_sha256;  // ... and its hash
};

/// InputError when the file has no request (written by an older version).
StoredRequest read_request(const std::filesystem::path& rom);
void write_request(H5File& file, const std::string& text);

/// Surfaces and sets to add; those already in the file are ignored.
struct RowRequest {
  std::vector<std::string> surfaces, sets;
};

/// `stored` with more rows: the skin of its surfaces and the new ones, as if all had been requested
/// at once, and the displacements of the new sets. All else is unchanged.
///
/// The basis is not in the file and is computed again: K_ii is factorised with the stored
/// permutation, Psi swept and the shapes iterated with the same `options`. Rounding may change a
/// shape's sign, or rotate shapes of equal frequency: align_basis undoes this.
/// NumericsError when the two bases then differ by more than 1e-7; certificate entry
/// `rows_added_error` records the difference.
/// @param model the model that `stored` was condensed from (the caller compares the hashes).
rom::ReducedModel add_rows(const fe::FeModel& model, const rom::ReducedModel& stored,
                           CondenseOptions options, const RowRequest& request, StepClock& clock);

/// A line for the user on the result of add_rows(), and its members for --json: skin_nodes,
/// recovered_sets, rows_added_error.
std::string describe_added_rows(const rom::ReducedModel& with_rows);
JsonMembers json_of_added_rows(const rom::ReducedModel& with_rows);

/// Rotates the modal coordinates of `fresh` into those of `stored`, only among neighbours of equal
/// stiffness (1e-6), so that mass coupling, loads and common rows agree best (Schoenemann 1966,
/// orthogonal Procrustes). Returns the largest remaining difference in M_rr, K_rr, loads and rows,
/// each relative to its own scale; infinity when the sizes differ.
double align_basis(rom::ReducedModel& fresh, const rom::ReducedModel& stored);

}  // namespace clatter::condense
