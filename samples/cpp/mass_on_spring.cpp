// SPDX-License-Identifier: GPL-3.0-or-later
// A scene without a file: a mass on a spring, let go 1 mm from rest.
//   mass_on_spring mass.run.h5
#include <cstdio>
#include <exception>
#include <memory>

#include "core/base/write_artefact.hpp"
#include "dynamics/component/rigid_body_component.hpp"
#include "dynamics/component/spring_component.hpp"
#include "dynamics/run/bodies.hpp"
#include "dynamics/run/run_file.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: mass_on_spring mass.run.h5\n", stderr);
    return 2;
  }
  try {
    using namespace clatter;
    using namespace clatter::dynamics;
    RigidBodySpec mass;
    mass.name = "mass";
    mass.motion = RigidBodySpec::Freedom::kSlide;
    mass.mass = 2.0;
    SpringSpec spring;
    spring.name = "spring";
    spring.a.body = "mass";
    spring.a.at = Eigen::Vector3d::Zero();
    spring.b.at = Eigen::Vector3d(0.1, 0.0, 0.0);
    spring.stiffness = 8e4;
    spring.length = 0.101;

    Scene scene;
    scene.time.end = 0.1;
    scene.steps.largest = 2e-5;
    scene.components = {std::make_shared<RigidBodyComponent>(mass),
                        std::make_shared<SpringComponent>(std::vector{spring})};

    StepClock clock;
    const LoadedBodies bodies = load_bodies(scene);
    RunControl control;
    control.output = argv[1];
    const RunResult result = simulate(scene, bodies, control);
    write_run(scene, bodies, result);
    finish_artefact(*result.file, argv[1], provenance_of(scene), clock, {});
    std::printf("energy residue %.1e\n", result.energy_residue);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mass_on_spring: %s\n", error.what());
    return 2;
  }
}
