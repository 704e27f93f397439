#pragma once
// Rows of T for more surfaces and sets of a part that is condensed already.
#include <string>
#include <vector>

#include "condense/condense.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fe/fe_model.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// How a reduced model was asked for, as its file keeps it.
struct StoredRequest {
  std::string text;          // the .rom.toml, word by word
  std::string model_path;    // the .fe.h5 ...
  std::string model_sha256;  // ... and its content
};

/// InputError when the file does not say (written by an older clatter).
StoredRequest read_request(const std::filesystem::path& rom);
void write_request(H5File& file, const std::string& text);

/// Names of what is wanted beside what the file has; names that it has already are passed over.
struct RowRequest {
  std::vector<std::string> surfaces, sets;
};

/// `stored` with more rows: the skin of its surfaces and the new ones, as if all had been asked for
/// at once, and the displacements of the new sets. All else stays as it is.
///
/// The basis is not in the file. It is solved for again: K_ii is factorised in the stored order,
/// Psi swept and the shapes iterated as `options` say. Rounding may turn a shape's sign, or shapes
/// of one frequency among each other: they are turned back by what both know (align_basis).
/// NumericsError when the two bases differ by more than 1e-7 then; certificate entry
/// `rows_added_error` keeps what was found.
/// @param model the one that `stored` was made from (the caller compares the hashes).
rom::ReducedModel add_rows(const fe::FeModel& model, const rom::ReducedModel& stored,
                           CondenseOptions options, const RowRequest& request, StepClock& clock);

/// Turns the modal coordinates of `fresh` into those of `stored`, orthogonally and only among
/// neighbours of equal stiffness (1e-6): the turn that brings mass coupling, loads and common rows
/// nearest (Schoenemann 1966, orthogonal Procrustes). Returns the largest difference that is left
/// in M_rr, K_rr, loads and rows, each relative to its own scale; infinity when the sizes differ.
double align_basis(rom::ReducedModel& fresh, const rom::ReducedModel& stored);

}  // namespace clatter::condense
