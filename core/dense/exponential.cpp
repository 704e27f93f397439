// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dense/exponential.hpp"

#include <cmath>

#include "core/dense/lapack_call.hpp"
#include "core/dense/solve.hpp"

namespace clatter::dense {

using Eigen::MatrixXd;

MatrixXd exponential(MatrixXd A) {
  if (!A.allFinite()) return no_answer(A.rows(), A.cols());
  if (A.size() == 0) return A;
  // Up to this norm the rational function is exact to rounding (Higham 2005, table 2.3).
  constexpr double kReach = 5.371920351148152;
  // Coefficients of the numerator, by powers of A; the denominator has those of -A.
  constexpr double b[] = {64764752532480000.0,
                          32382376266240000.0,
                          7771770303897600.0,
                          1187353796428800.0,
                          129060195264000.0,
                          10559470521600.0,
                          670442572800.0,
                          33522128640.0,
                          1323241920.0,
                          40840800.0,
                          960960.0,
                          16380.0,
                          182.0,
                          1.0};
  int squarings = 0;
  const double norm = A.cwiseAbs().colwise().sum().maxCoeff();
  if (norm > kReach) std::frexp(norm / kReach, &squarings);
  A *= std::ldexp(1.0, -squarings);
  const MatrixXd unit = MatrixXd::Identity(A.rows(), A.cols());
  const MatrixXd A2 = A * A, A4 = A2 * A2, A6 = A2 * A4;
  const MatrixXd high_odd = b[13] * A6 + b[11] * A4 + b[9] * A2;
  const MatrixXd high_even = b[12] * A6 + b[10] * A4 + b[8] * A2;
  const MatrixXd low_odd = A6 * high_odd + b[7] * A6 + b[5] * A4 + b[3] * A2 + b[1] * unit;
  const MatrixXd odd = A * low_odd;
  const MatrixXd even = A6 * high_even + b[6] * A6 + b[4] * A4 + b[2] * A2 + b[0] * unit;
  MatrixXd out = solve(even - odd, even + odd);
  for (int k = 0; k < squarings; ++k) out = (out * out).eval();
  return out;
}

}  // namespace clatter::dense
