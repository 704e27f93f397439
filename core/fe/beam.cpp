// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/beam.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "core/base/error.hpp"
#include "core/dense/solve.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::fe {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Shape = Eigen::Matrix<double, 6, 12>;

// Gauss points on [0, 1]: exact to degree 9, as the mass of a constant section needs.
constexpr std::array<double, 5> kPoints = {0.046910077030668004, 0.23076534494715845, 0.5,
                                           0.76923465505284155, 0.953089922969332};
constexpr std::array<double, 5> kWeights = {0.11846344252809454, 0.23931433524968324,
                                            0.28444444444444444, 0.23931433524968324,
                                            0.11846344252809454};

/// Section forces N Vy Vz T My Mz by forces and moments at a distance ahead; its transpose moves
/// displacements.
Matrix6 arm(double distance) {
  Matrix6 A = Matrix6::Identity();
  A(4, 2) = -distance;
  A(5, 1) = distance;
  return A;
}

BeamSection mix(const BeamSection& a, const BeamSection& b, double t) {
  const auto at = [&](double BeamSection::*value) { return (1.0 - t) * a.*value + t * b.*value; };
  return {at(&BeamSection::EA),       at(&BeamSection::GJ),       at(&BeamSection::EI1),
          at(&BeamSection::EI2),      at(&BeamSection::EI12),     at(&BeamSection::shear1),
          at(&BeamSection::shear2),   at(&BeamSection::mass),     at(&BeamSection::inertia1),
          at(&BeamSection::inertia2), at(&BeamSection::inertia12)};
}

/// Compliance of a section; zero along what it does not resist.
Matrix6 compliance(const BeamSection& s) {
  Matrix6 C = Matrix6::Zero();
  if (s.EA > 0.0) C(0, 0) = 1.0 / s.EA;
  if (s.GJ > 0.0) C(3, 3) = 1.0 / s.GJ;
  if (s.EI1 > 0.0) C(1, 1) = s.shear1;
  if (s.EI2 > 0.0) C(2, 2) = s.shear2;
  if (s.EI1 > 0.0 && s.EI2 > 0.0) {
    Eigen::Matrix2d bending;
    bending << s.EI2, -s.EI12, -s.EI12, s.EI1;
    C.bottomRightCorner<2, 2>() = bending.inverse();
  } else if (s.EI1 > 0.0) {
    C(5, 5) = 1.0 / s.EI1;
  } else if (s.EI2 > 0.0) {
    C(4, 4) = 1.0 / s.EI2;
  }
  return C;
}

/// One beam in the frame of its axes, without offsets.
class Theory {
 public:
  explicit Theory(const BeamElement& beam) : L_(beam.length), stations_(beam.stations) {
    if (stations_.size() == 1) stations_.push_back({1.0, stations_[0].section});
    const BeamSection& s = stations_.front().section;
    for (const int d : {0, 3})
      if ((d == 0 ? s.EA : s.GJ) > 0.0) resisted_.push_back(d);
    if (s.EI1 > 0.0) resisted_.insert(resisted_.end(), {1, 5});
    if (s.EI2 > 0.0) resisted_.insert(resisted_.end(), {2, 4});
    const Matrix6 F = deflection(L_);
    S_ = Matrix6::Zero();
    const auto n = static_cast<Eigen::Index>(resisted_.size());
    S_(resisted_, resisted_) =
        dense::solve_symmetric(F(resisted_, resisted_), Eigen::MatrixXd::Identity(n, n));
  }

  BeamMatrix stiffness() const { return motion().transpose() * S_ * motion(); }

  /// Forces at end b by the motions of both.
  Shape forces() const { return S_ * motion(); }

  /// int v'^T v' + w'^T w' dx.
  BeamMatrix slopes() const {
    BeamMatrix G = BeamMatrix::Zero();
    integrate(L_, [&](double x, double weight, const BeamSection& s) {
      const auto along_y = slope(x, 1, s), along_z = slope(x, 2, s);
      G += weight * (along_y.transpose() * along_y + along_z.transpose() * along_z);
    });
    return G;
  }

  BeamMatrix consistent_mass() const {
    BeamMatrix M = BeamMatrix::Zero();
    integrate(L_, [&](double x, double weight, const BeamSection& s) {
      Matrix6 m = Matrix6::Zero();
      m.diagonal() << s.mass, s.mass, s.mass, s.inertia1 + s.inertia2, s.inertia2, s.inertia1;
      m(4, 5) = m(5, 4) = -s.inertia12;
      const Shape N = shape(x);
      M += weight * N.transpose() * m * N;
    });
    return M;
  }

  BeamMatrix lumped_mass() const {
    BeamMatrix M = BeamMatrix::Zero();
    integrate(L_, [&](double x, double weight, const BeamSection& s) {
      M.diagonal().segment<3>(0).array() += weight * s.mass * (1.0 - x / L_);
      M.diagonal().segment<3>(6).array() += weight * s.mass * x / L_;
    });
    return M;
  }

 private:
  /// Of end b beside that of the rigid beam on end a.
  Shape motion() const {
    Shape out;
    out << -arm(L_).transpose(), Matrix6::Identity();
    return out;
  }

  /// The derivative of the deflection along y (1) or z (2): the rotation and the shear strain; of
  /// what the beam does not resist that of a string.
  Eigen::Matrix<double, 1, 12> slope(double x, int d, const BeamSection& s) const {
    Eigen::Matrix<double, 1, 12> out = Eigen::Matrix<double, 1, 12>::Zero();
    if (std::ranges::count(resisted_, d) == 0) {
      out(d) = -1.0 / L_;
      out(d + 6) = 1.0 / L_;
      return out;
    }
    const Shape at = arm(L_ - x) * forces(), N = shape(x);
    out = compliance(s)(d, d) * at.row(d);
    d == 1 ? out += N.row(5) : out -= N.row(4);
    return out;
  }

  /// Calls body(x, weight, section) at the points of a rule on [0, end].
  template <class Body>
  void integrate(double end, const Body& body) const {
    for (size_t k = 0; k + 1 < stations_.size(); ++k) {
      const BeamStation &a = stations_[k], &b = stations_[k + 1];
      const double from = a.at * L_, width = std::min(b.at * L_, end) - from;
      if (!(width > 0.0)) continue;
      for (size_t g = 0; g < kPoints.size(); ++g) {
        const double x = from + width * kPoints[g];
        body(x, width * kWeights[g], mix(a.section, b.section, (x / L_ - a.at) / (b.at - a.at)));
      }
    }
  }

  /// Displacements at x of the cantilever by the forces at its end b.
  Matrix6 deflection(double x) const {
    Matrix6 D = Matrix6::Zero();
    integrate(x, [&](double at, double weight, const BeamSection& s) {
      D += weight * arm(x - at).transpose() * compliance(s) * arm(L_ - at);
    });
    return D;
  }

  /// Displacements at x by those of the ends; linear along what the beam does not resist.
  Shape shape(double x) const {
    const Matrix6 D = deflection(x) * S_;
    Shape N;
    N << arm(x).transpose() - D * arm(L_).transpose(), D;
    for (int d = 0; d < 6; ++d) {
      if (std::ranges::count(resisted_, d) > 0) continue;
      N.row(d).setZero();
      if (d >= 3) continue;  // the section does not turn with the ends
      N(d, d) = 1.0 - x / L_;
      N(d, d + 6) = x / L_;
    }
    return N;
  }

  double L_;
  std::vector<BeamStation> stations_;
  std::vector<int> resisted_;
  Matrix6 S_;  // forces at b by its displacements, a held
};

/// Every motion has a stiffness, in units in which the diagonal is 1.
bool is_stiff(const Eigen::MatrixXd& K) {
  constexpr double kSoft = 1e-12;
  if (!(K.diagonal().minCoeff() > 0.0)) return false;
  const Eigen::VectorXd scale = K.diagonal().cwiseSqrt().cwiseInverse();
  return dense::symmetric_eigen(scale.asDiagonal() * K * scale.asDiagonal(),
                                dense::EigenParts::kValues)
             .values(0) > kSoft;
}

/// Motions of the ends by those of the ends as the nodes move them: released DoFs adjust so that
/// they carry no force.
BeamMatrix release(const BeamElement& beam, const BeamMatrix& K) {
  std::vector<int> released, kept;
  for (int end = 0; end < 2; ++end)
    for (int d = 0; d < 6; ++d)
      (std::ranges::count(beam.released[end], d) > 0 ? released : kept).push_back(6 * end + d);
  BeamMatrix T = BeamMatrix::Identity();
  if (released.empty()) return T;
  const Eigen::MatrixXd own = K(released, released);
  if (!is_stiff(own))
    throw InputError(
        "the released DoFs leave it a motion without stiffness, expected fewer of them, or a "
        "section that resists them");
  T(released, released).setZero();
  T(released, kept) = -dense::solve_symmetric(own, K(released, kept));
  return T;
}

/// Motions of the ends along the axes by those of the nodes.
BeamMatrix at_nodes(const BeamElement& beam) {
  BeamMatrix T = BeamMatrix::Zero();
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d& w = beam.offset[end];
    Eigen::Matrix3d cross;  // theta x w
    cross << 0.0, w.z(), -w.y(), -w.z(), 0.0, w.x(), w.y(), -w.x(), 0.0;
    T.block<3, 3>(6 * end, 6 * end) = beam.axes.transpose();
    T.block<3, 3>(6 * end, 6 * end + 3) = beam.axes.transpose() * cross;
    T.block<3, 3>(6 * end + 3, 6 * end + 3) = beam.axes.transpose();
  }
  return T;
}

BeamMatrix form(const BeamMatrix& A, const BeamMatrix& T) {
  const BeamMatrix result = T.transpose() * A * T;
  return 0.5 * (result + result.transpose());
}

}  // namespace

BeamMatrix beam_stiffness(const BeamElement& beam, double tension) {
  const Theory theory(beam);
  BeamMatrix K = theory.stiffness();
  if (tension != 0.0) K += tension * theory.slopes();
  return form(K, release(beam, K) * at_nodes(beam));
}

double beam_tension(const BeamElement& beam, const Eigen::Vector<double, 12>& u) {
  const Theory theory(beam);
  const BeamMatrix ends = release(beam, theory.stiffness()) * at_nodes(beam);
  return (theory.forces() * ends * u)(0);
}

BeamMatrix beam_mass(const BeamElement& beam, MassForm form_of_mass) {
  const Theory theory(beam);
  const BeamMatrix M =
      form_of_mass == MassForm::kConsistent ? theory.consistent_mass() : theory.lumped_mass();
  return form(M, release(beam, theory.stiffness()) * at_nodes(beam));
}

}  // namespace clatter::fe
