// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/sid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "condense/export/floating_frame.hpp"
#include "core/base/artefact.hpp"
#include "core/base/whole_file.hpp"

namespace clatter::condense {
namespace {

using Eigen::MatrixXd;

/// m0 + sum_k m1[k] q_k.
struct Taylor {
  const char* name;
  MatrixXd m0;
  std::vector<MatrixXd> m1{};  // of each coordinate; empty: order 0
};

void write_taylor(std::ostream& out, const std::string& indent, Eigen::Index nq,
                  const Taylor& taylor) {
  constexpr int kZero = 0, kFull = 3;  // structures
  const bool zero = taylor.m0.isZero(0.0) && taylor.m1.empty();
  const std::string inner = indent + "    ";
  out << indent << taylor.name << '\n';
  const auto line = [&](const char* key, int64_t value) {
    out << fmt::format("{}{:<12} = {}\n", inner, key, value);
  };
  line("order", taylor.m1.empty() ? 0 : 1);
  line("nrow", taylor.m0.rows());
  line("ncol", taylor.m0.cols());
  line("nq", nq);
  line("nqn", 0);
  line("structure", zero ? kZero : kFull);
  for (Eigen::Index i = 0; !zero && i < taylor.m0.rows(); ++i)
    for (Eigen::Index j = 0; j < taylor.m0.cols(); ++j)
      out << fmt::format("{}m0({:3},{:3}) = {:.16e}\n", inner, i + 1, j + 1, taylor.m0(i, j));
  for (Eigen::Index i = 0; !taylor.m1.empty() && i < taylor.m0.rows(); ++i)
    for (Eigen::Index j = 0; j < taylor.m0.cols(); ++j)
      for (size_t k = 0; k < taylor.m1.size(); ++k)
        out << fmt::format("{}m1({:3},{:3},{:3}) = {:.16e}\n", inner, i + 1, j + 1, k + 1,
                           taylor.m1[k](i, j));
  out << indent << "end " << taylor.name << '\n';
}

void write_node(std::ostream& out, const NodeShape& node) {
  const Eigen::Index nq = node.shape.cols();
  const MatrixXd phi = node.shape.topRows(3), psi = node.shape.bottomRows(3);
  Taylor origin{"origin", node.position, {}}, AP{"AP", Eigen::Matrix3d::Identity(), {}};
  for (Eigen::Index k = 0; k < nq; ++k) {
    origin.m1.push_back(phi.col(k));
    AP.m1.push_back(tilde(psi.col(k)));
  }
  const std::string indent(20, ' ');
  out << fmt::format("                new node = {}\n{}rframe = body ref\n", node.number, indent);
  for (const Taylor& taylor : {origin, Taylor{"phi", phi}, Taylor{"psi", psi}, AP})
    write_taylor(out, indent, nq, taylor);
  out << "                end node\n";
}

/// Columns of Oe: products of the angular velocities a and b.
constexpr int kProducts[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};

/// The coefficient of w_a w_b in phi . w x (w x y), from the matrix of the integrals of y_l phi_k.
double centrifugal(const Eigen::Matrix3d& S, int a, int b) {
  return a == b ? S(a, a) - S.trace() : S(a, b) + S(b, a);
}

/// The integrals over the mass, by tables of FloatingFrame.
std::vector<Taylor> mass_integrals(const FloatingFrame& frame) {
  const Eigen::Index n = frame.modes();
  Taylor mdCM{"mdCM", frame.mass * frame.centre, {}}, J{"J", frame.inertia, {}};
  Taylor Ct{"Ct", frame.first.transpose()}, Cr{"Cr", MatrixXd(n, 3), {}};
  Taylor Gr{"Gr", MatrixXd(3, 3 * n)}, Ge{"Ge", MatrixXd(n, 3 * n)}, Oe{"Oe", MatrixXd(n, 6), {}};
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Matrix3d S = frame.moment(k);
    mdCM.m1.push_back(frame.first.col(k));
    J.m1.push_back(2.0 * S.trace() * I - S - S.transpose());
    Cr.m0.row(k) = axial(S);
    Gr.m0.middleCols<3>(3 * k) = 2.0 * (S.trace() * I - S.transpose());
    for (int c = 0; c < 6; ++c) Oe.m0(k, c) = centrifugal(S, kProducts[c][0], kProducts[c][1]);
    Cr.m1.emplace_back(n, 3);
    Oe.m1.emplace_back(n, 6);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Matrix3d P = frame.product(k, i);  // of phi_k,l phi_i,m
      Cr.m1.back().row(i) = axial(P);
      Ge.m0.block<1, 3>(i, 3 * k) = 2.0 * axial(P);
      for (int c = 0; c < 6; ++c)
        Oe.m1.back()(i, c) = centrifugal(P, kProducts[c][0], kProducts[c][1]);
    }
  }
  return {mdCM, J, Ct, Cr, {"Me", MatrixXd::Identity(n, n)}, Gr, Ge, Oe};
}

}  // namespace

void export_sid(const ExportedPart& part, const std::filesystem::path& path) {
  const PencilModes modes = elastic_modes_of(part.model);
  const FloatingFrame frame = floating_frame(part, modes, "SID");
  const Eigen::Index n = frame.modes();
  WholeFile file(path);
  std::ostream& out = file.stream();
  out << fmt::format("clatter {}: {} ({}), {}\n", version(), part.model.name, part.model.method,
                     text_of(part.units));
  out << "part\n    new modal\n        refmod\n";
  out << fmt::format("            mass         = {:.16e}\n            nelastq      = {}\n",
                     frame.mass, n);
  for (Eigen::Index k = 0; k < n; ++k)
    out << fmt::format("            ielastq ({:4}) = Eigen Mode {:4} : {:.9g} Hz\n", k + 1, k + 1,
                       std::sqrt(modes.Lambda[k]) / (2.0 * std::numbers::pi));
  out << "        end refmod\n        frame\n";
  for (const NodeShape& node : node_shapes(part, modes)) write_node(out, node);
  out << "        end frame\n";
  std::vector<Taylor> taylors = mass_integrals(frame);
  taylors.push_back({"ksigma", MatrixXd::Zero(n, 1)});
  taylors.push_back({"Ke", modes.Lambda.asDiagonal()});
  taylors.push_back({"De", part.model.damping_rates(modes.Lambda, modes.Phi).asDiagonal()});
  for (const Taylor& taylor : taylors) write_taylor(out, "        ", n, taylor);
  out << "    end modal\nend part\n";
  file.commit();
}

}  // namespace clatter::condense
