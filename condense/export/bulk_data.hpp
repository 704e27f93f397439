// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Nastran bulk data entries of a reduced part (MSC Nastran Quick Reference Guide: GRID, SPOINT,
// DMIG).
#include <ostream>
#include <string>
#include <vector>

#include "condense/export/exported_part.hpp"

namespace clatter::condense {

/// Highest number of a GRID or SPOINT.
inline constexpr int kLargestGrid = 99'999'999;

/// A number in a field of 16 columns, with a D exponent and as many digits as fit.
std::string nastran_number(double value);

/// "$ row node component label" of each coordinate, after `lines` of text.
void write_bulk_head(std::ostream& out, const ExportedPart& part,
                     const std::vector<std::string>& lines);

/// A GRID for each node, permanently constrained (PS) in the components that no coordinate has.
/// @param deck_nodes false: those that the deck has get a comment instead.
void write_grids(std::ostream& out, const ExportedPart& part, bool deck_nodes);

/// An SPOINT for each coordinate of component 0. InputError for numbers above kLargestGrid.
void write_spoints(std::ostream& out, const ExportedPart& part);

/// "DMIG* name" of the lower triangle, form 6, type 2 (double). A field of 16 columns has 10 to 12
/// digits of a negative or small number: relative errors are at most 5e-10.
void write_dmig(std::ostream& out, const std::string& name, const Eigen::MatrixXd& matrix,
                const ExportedPart& part);

/// Numbers in fields of 8 columns, eight a line, the first line begun with `head`.
void write_fields(std::ostream& out, const std::string& head, const std::vector<int>& numbers);

}  // namespace clatter::condense
