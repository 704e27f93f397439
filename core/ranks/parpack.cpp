// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ranks/parpack.hpp"

#include <parpack.h>

#include <algorithm>

namespace clatter::ranks {

using sparse::ArpackArrays;

static_assert(sizeof(a_int) == 4,
              "Debian's PARPACK has 32-bit integers; a wider build would corrupt memory");

void ParpackRoutines::iterate(ArpackArrays& a) const {
  pdsaupd_c(all_, &a.ido, &ArpackArrays::kMassInProduct, a.n, ArpackArrays::kLargestMagnitude,
            a.nev, a.tolerance, a.resid.data(), a.ncv, a.v.data(), std::max(a.n, 1),
            a.iparam.data(), a.ipntr.data(), a.workd.data(), a.workl.data(), a.lworkl, &a.info);
}

void ParpackRoutines::extract(ArpackArrays& a) const {
  pdseupd_c(all_, 1, "A", a.select.data(), a.d.data(), a.z.data(), std::max(a.n, 1), a.sigma,
            &ArpackArrays::kMassInProduct, a.n, ArpackArrays::kLargestMagnitude, a.nev, a.tolerance,
            a.resid.data(), a.ncv, a.v.data(), std::max(a.n, 1), a.iparam.data(), a.ipntr.data(),
            a.workd.data(), a.workl.data(), a.lworkl, &a.info);
}

}  // namespace clatter::ranks
