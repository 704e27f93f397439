// SPDX-License-Identifier: GPL-3.0-or-later
// Action equals reaction over the entire engine with its crankshaft.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "dynamics/crank/crank_component.hpp"
#include "tests/dynamics/synthetic_engine.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::dynamics {
namespace {

using testing::EngineVariant;
using testing::SyntheticEngine;
using Vector6 = Eigen::Matrix<double, 6, 1>;

struct CrankVariant {
  std::string name;
  bool in_bearings, is_free;
};

void PrintTo(const CrankVariant& variant, std::ostream* out) { *out << variant.name; }

/// The synthetic engine with a crankshaft in bearings of three kinds.
SyntheticEngine engine_of(const CrankVariant& variant) {
  SyntheticEngine engine(EngineVariant{.name = variant.name, .elastic_piston = false});
  CrankSpec crank;
  crank.clock = engine.cylinder.engine.clock;
  crank.body.in_bearings = variant.in_bearings;
  crank.body.is_free = variant.is_free;
  crank.body.mass = 50.0;
  crank.body.polar = 0.8;
  crank.body.diametral = 3.0;
  crank.body.centre = 0.17;
  const BearingSize size{85e-3, 30e-3, 1e-3, 10e-3};
  if (variant.in_bearings) {
    JournalFilmOptions film;
    film.size = size;
    film.cells_around = 24;
    film.cells_along = 3;
    crank.bearings = {{"b4", "test", "main_4", std::nullopt, film},
                      {"b5", "test", "main_5", 0.262, ImpedanceSpec{size, BearingModel::kMoes}},
                      {"b6", "test", "main_5", std::nullopt, LinearBearingSpec{1e8, 1e4}}};
  }
  engine.cylinder.crankshaft = crank.body;
  engine.scene.components[0] = std::make_shared<CylinderComponent>(engine.cylinder);
  engine.scene.components.push_back(std::make_shared<CrankComponent>(crank));
  return engine;
}

/// All interface coordinates when all bodies move together as one rigid body, n_y x 6: the
/// crankshaft from its displaced position `at`, the others from those of their frames.
Eigen::MatrixXd motions_of_all(const Model& model, double time, const Eigen::VectorXd& at) {
  const System& system = model.system;
  std::map<int, Eigen::Vector3d> frames;
  for (const MovingFrames* moving : components_of<MovingFrames>(model))
    frames.merge(moving->frames(time));
  Eigen::MatrixXd modal(system.modes(), 6), V(system.interface_size(), 6);
  for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
    const ModalBody& body = system.bodies()[b];
    Eigen::Matrix<double, 6, 6> motion = Eigen::Matrix<double, 6, 6>::Identity();
    const auto frame = frames.find(b);
    for (int k = 0; k < 3 && frame != frames.end(); ++k)
      motion.topRightCorner<3, 3>().col(k) = Eigen::Vector3d::Unit(k).cross(frame->second);
    modal.middleRows(system.mode_offset(b), body.modes()) = body.rigid * motion;
  }
  for (int k = 0; k < 6; ++k) V.col(k) = system.interface(Eigen::VectorXd(modal.col(k)));
  // A rotation about x turns the crank's displacement and its tilt.
  const int crank = static_cast<int>(system.bodies().size()) - 1;
  const std::vector<int>& rows = system.rows(crank);
  if (rows.size() >= 4) {
    V(rows[0], 3) -= at(rows[1]);
    V(rows[1], 3) += at(rows[0]);
    V(rows[2], 3) -= at(rows[3]);
    V(rows[3], 3) += at(rows[2]);
  }
  return V;
}

class CrankBalance : public ::testing::TestWithParam<CrankVariant> {};

TEST_P(CrankBalance, RigidMotionsOfTheWholeDoNoWorkButThoseOfDriveAndLoad) {
  const CrankVariant variant = GetParam();
  const SyntheticEngine engine = engine_of(variant);
  const double omega = engine.cylinder.engine.clock.speed;
  int seen = 0;
  for (const double degrees : {-310.0, -90.0, 35.0, 130.0}) {
    const double time = degrees * std::numbers::pi / 180.0 / omega;
    const auto model = engine.model();
    const System& system = model->system;
    Eigen::VectorXd at = 3e-6 * test::random_vector(system.interface_size(), 3);
    for (const int row : system.rows(1)) at(row) = 0.0;  // of the block: levers at rest
    const Eigen::MatrixXd V = motions_of_all(*model, time, at);
    const Eigen::VectorXd rate = 0.02 * test::random_vector(system.interface_size(), 4);
    // Levers of pins are those of the ideal position: the crank pin and rod have not turned.
    at(system.rows(model->system.owner(model->system.element(0).coordinates().back()))[2]) = 0.0;
    for (int e = 0; e < system.elements(); ++e) {
      ForceElement& element = model->system.element(e);
      const std::string name = element.name();
      const bool on_crank = name == "crank_pin" || name.find("crankshaft") != std::string::npos;
      if (!on_crank && name != "crank load") continue;
      ++seen;
      const std::vector<int>& rows = element.coordinates();
      Eigen::VectorXd y = gather(at, rows), v = gather(rate, rows);
      if (variant.is_free && name == "crank_pin") y(y.size() - 1) = 0.0;
      Response response;
      element.begin_step(time - 1e-6);
      element.evaluate({time, 1e-6, 0, {}}, y, v, false, response);
      const Eigen::VectorXd& f = response.force;
      const Eigen::MatrixXd V_e = V(rows, Eigen::all);
      Vector6 work = V_e.transpose() * f;
      const Vector6 terms = V_e.cwiseAbs().transpose() * f.cwiseAbs();
      if (name == "crank load") continue;  // external
      EXPECT_GT(f.norm(), 1e-3) << name;
      if (!variant.is_free && name != "gyroscope crankshaft") {
        // The drive holds the moment about the crank's axis.
        EXPECT_GT(std::abs(work(3)), name == "bearing crankshaft b6" ? 0.0 : 1e-4) << name;
        work(3) = 0.0;
      }
      if (name == "gyroscope crankshaft") continue;  // no force between bodies: see below
      const double worst =
          (work.array().abs() / terms.array().max(1e-3 * terms.maxCoeff())).maxCoeff();
      // Bearings act at the journal; the pin's force has the lever of the ideal position, from
      // which both ends are some um away.
      const double small = name == "crank_pin" ? 1e-4 : 1e-9;
      EXPECT_LT(worst, small) << name << " at " << degrees << " deg: " << work.transpose() << " of "
                              << terms.transpose();
      std::printf("%-12s %-22s |f| %8.3g, relative work %.1e\n", variant.name.c_str(), name.c_str(),
                  f.norm(), worst);
    }
  }
  EXPECT_EQ(seen, 4 * (1 + (variant.in_bearings ? 4 : 0) + (variant.is_free ? 1 : 0)));
}

INSTANTIATE_TEST_SUITE_P(Cranks, CrankBalance,
                         ::testing::Values(CrankVariant{"free_ideal", false, true},
                                           CrankVariant{"bearings", true, false},
                                           CrankVariant{"bearings_free", true, true}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace clatter::dynamics
