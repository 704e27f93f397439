// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A closed surface around a body by CGAL.
#include "core/base/matrix.hpp"

namespace clatter::recover {

/// Flat triangles.
struct FlatTriangles {
  RowMatrix nodes;        // n x 3 [m]
  IndexMatrix triangles;  // m x 3
};

/// The alpha wrap of a body (Portaneri et al. 2022), closed and outward.
///
/// A sphere of diameter `opening` rolls around the body: what it cannot enter is closed. The wrap
/// lies between the body and `offset` outside of it.
/// @param opening, offset [m]
FlatTriangles alpha_wrap(const FlatTriangles& body, double opening, double offset);

/// A closed surface of nearly equilateral triangles (Botsch and Kobbelt 2004) that keep edges
/// sharper than 45 degrees.
/// @param edge length of the triangles' edges [m], within a third
FlatTriangles remeshed(const FlatTriangles& surface, double edge);

}  // namespace clatter::recover
