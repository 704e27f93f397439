// SPDX-License-Identifier: GPL-3.0-or-later
// Heat along sheets against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fe/heat.hpp"
#include "sheet.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

constexpr double kFinLong = 0.2, kFinWide = 0.05, kFinThick = 0.002;

/// A sheet with the surface "under" on its other side.
mesh::Mesh fin(int nx) {
  mesh::Mesh mesh = sheet(kFinLong, kFinWide, nx, 2);
  mesh.surfaces["under"] = mesh.surface("skin");
  for (mesh::FaceBlock& block : mesh.surfaces["under"].faces)
    block.nodes = block.nodes.rowwise().reverse().eval();
  return mesh;
}

std::string heated(const std::string& heat, double k = 50.0) {
  return fmt::format(
      "[material.steel]\nregions = [\"sheet\"]\nE = 2e11\nnu = 0.3\nrho = 7850.0\n"
      "conductivity = {}\nexpansion = 1e-5\n[[shell]]\nregions = [\"sheet\"]\nthickness = {}\n"
      "[[heat]]\nname = \"warm\"\n{}",
      k, kFinThick, heat);
}

const std::string kHotRoot = "[[heat.fixed]]\nnode_set = \"x0\"\ntemperature_c = 100.0\n";

std::string film(const std::string& surface, double h) {
  return fmt::format("[[heat.film]]\nsurface = \"{}\"\ncoefficient = {}\ntemperature_c = 20.0\n",
                     surface, h);
}

TEST(SheetHeat, AFinCoolsFromBothFaces) {
  // theta = cosh(m (L - x)) / cosh(m L), m^2 = (h1 + h2) / (k t); heat k t b m tanh(m L) of 80 K.
  const auto field = build_all(fin(40), heated(kHotRoot + film("skin", 12.0) + film("under", 8.0)))
                         .model.heat.at("warm");
  const double m = std::sqrt(20.0 / (50.0 * kFinThick));
  const double tip = 80.0 / std::cosh(m * kFinLong);
  EXPECT_NEAR(field.temperature(40) - 293.15, tip, 1e-3 * tip);
  const double heat = 80.0 * 50.0 * kFinThick * kFinWide * m * std::tanh(m * kFinLong);
  EXPECT_NEAR(field.heat(2), heat, 1e-3 * heat);
  EXPECT_NEAR(field.heat(0) / field.heat(1), 1.5, 1e-12);
  EXPECT_LT(field.balance, 1e-12);
  // Of order 2.
  const auto coarse =
      build_all(fin(20), heated(kHotRoot + film("skin", 12.0) + film("under", 8.0)));
  const double error = coarse.model.heat.at("warm").temperature(20) - 293.15 - tip;
  EXPECT_NEAR(error / (field.temperature(40) - 293.15 - tip), 4.0, 0.1);
}

TEST(SheetHeat, BetweenTwoFluidsItHasTheMeanByTheirFilms) {
  const std::string two = film("skin", 30.0) +
                          "[[heat.film]]\nsurface = \"under\"\ncoefficient = 10.0\n"
                          "temperature_c = 100.0\n";
  const auto field = build_all(fin(4), heated(two)).model.heat.at("warm");
  EXPECT_LT((field.temperature.array() - (273.15 + 40.0)).abs().maxCoeff(), 1e-9);
  EXPECT_NEAR(field.heat(1), 10.0 * 60.0 * kFinLong * kFinWide, 1e-9);
}

TEST(SheetHeat, ASourceHasItsVolume) {
  const auto field =
      build_all(fin(40), heated(kHotRoot + "[[heat.source]]\npower = 1e6\n")).model.heat.at("warm");
  const double tip = 1e6 * kFinLong * kFinLong / (2.0 * 50.0);
  EXPECT_NEAR(field.temperature(40) - 373.15, tip, 1e-3 * tip);
  EXPECT_NEAR(field.heat(0), 1e6 * kFinLong * kFinWide * kFinThick, 1e-9);
}

TEST(SheetConduction, AConstantGradientHasItsEnergyByLayers) {
  // Conductivities 10 and 1 along and across fibres at 30 degrees, and 3 of another layer.
  mesh::Mesh mesh = sheet(0.3, 0.2, 3, 2);
  mesh.nodes.row(5) += Eigen::RowVector3d(0.02, -0.03, 0.0);  // distorted
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1.0, 2.0, -1.0).normalized());
  mesh.nodes = (mesh.nodes * turn.toRotationMatrix().transpose()).eval();
  fe::Material fibres, other;
  fibres.conductivity = Eigen::Vector3d(10.0, 1.0, 1.0);
  other.conductivity.setConstant(3.0);
  fe::ShellSection section{.thickness = 0.003};
  section.layers = {{fibres, 0.001, std::numbers::pi / 6.0}, {other, 0.002, 0.0}};
  fe::Axes axes;
  axes.frame = turn.toRotationMatrix();
  section.axes = axes;
  const SparseMatrix lower = fe::sheet_conduction(mesh, {fibres}, {section});
  const Eigen::MatrixXd K = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
  const auto energy = [&](double along, double across) {
    const Eigen::Vector3d slope = turn * Eigen::Vector3d(along, across, 5.0);
    const Eigen::VectorXd T = mesh.nodes * slope;
    return T.dot(K * T) / (0.3 * 0.2);
  };
  const double c = std::cos(std::numbers::pi / 6.0), s = 0.5;
  EXPECT_NEAR(energy(1.0, 0.0), 0.001 * (10.0 * c * c + s * s) + 0.006, 1e-15);
  EXPECT_NEAR(energy(0.0, 1.0), 0.001 * (10.0 * s * s + c * c) + 0.006, 1e-15);
  EXPECT_NEAR(energy(1.0, 1.0) - energy(1.0, 0.0) - energy(0.0, 1.0), 2.0 * 0.001 * 9.0 * c * s,
              1e-15);
  EXPECT_LT((K * Eigen::VectorXd::Ones(K.rows())).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(SheetHeat, WhatItNeedsIsSaid) {
  const auto of = [](const std::string& toml) {
    return test::refusal_of([&] { build_all(fin(2), toml); });
  };
  test::expect_parts(
      of("[material.steel]\nE = 2e11\nnu = 0.3\nrho = 7850.0\n[[shell]]\nregions = [\"sheet\"]\n"
         "[[shell.layer]]\nmaterial = \"steel\"\nthickness = 0.001\n[[heat]]\nname = \"warm\"\n" +
         kHotRoot),
      {"found no conductivity of a material in the layers of region \"sheet\""});
  test::expect_parts(of(heated("")), {"found nothing that fixes the temperature of the body"});
}

}  // namespace
}  // namespace clatter::assembly::testing
