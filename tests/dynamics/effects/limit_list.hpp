// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Which effects have a limit, in which test, and why the others have none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <vector>

namespace clatter::dynamics::testing {

/// Those of cylinder_limit_test.
inline const std::vector<std::string>& effects_of_the_cylinder_limits() {
  static const std::vector<std::string> names{"gas pressure",
                                              "inertia of the rod",
                                              "friction of the rod joint",
                                              "oil film",
                                              "cavitation",
                                              "viscosity over temperature",
                                              "viscosity over pressure",
                                              "viscosity over shear rate",
                                              "friction factors",
                                              "asperity contact",
                                              "damping of the contact",
                                              "friction",
                                              "shapes of bore and skirt",
                                              "shapes scaled over the cycle",
                                              "ends of the liner",
                                              "friction of the rings",
                                              "friction in the ring grooves",
                                              "elastic body",
                                              "main bearings",
                                              "gyroscopic moments of the crank",
                                              "unbalance of the crank",
                                              "free rotation of the crank"};
  return names;
}

/// Those of mechanism_limit_test.
inline const std::vector<std::string>& effects_of_the_mechanism_limits() {
  static const std::vector<std::string> names{"elastic joints",
                                              "springs",
                                              "mounts",
                                              "stops",
                                              "gravity",
                                              "torsion of a shaft",
                                              "bending of a shaft",
                                              "bearings of a shaft",
                                              "unbalance of a disc",
                                              "rolling discs",
                                              "phaser",
                                              "torques over angle",
                                              "cam torque",
                                              "hydraulic element",
                                              "check valve",
                                              "relief valve",
                                              "valve spring",
                                              "torque of valves"};
  return names;
}

/// Those without a strength that goes to zero, and why.
inline const std::map<std::string, std::string>& effects_without_a_strength() {
  static const std::map<std::string, std::string> reasons{
      {"large motion of a reduced part", "a frame: it moves or it does not"},
      {"rigid body", "a body of the scene"},
      {"drive", "a motion that is given"},
      {"piston and rod", "a parked cylinder has none"},
      {"inertia of the piston", "always on"},
      {"rod guide", "an elastic rod needs it"},
      {"inertia of the block", "never on"},
      {"balance by other cylinders", "a definition: all of the forces or none"},
      {"rod joint", "always on"},
      {"pin guide", "always on"},
      {"oil layer on the liner", "another supply of oil"},
      {"gap around the entire skirt", "another part of the skirt"},
      {"grooves and windows", "an area; one without a cell is refused"},
      {"minimum warm clearance", "another way to give the clearance"},
      {"crankshaft", "a body of the scene; its bearings and rotation have limits"},
      {"shaft", "a body of the scene"},
      {"gyroscopic moments of a shaft", "on with the bending, of any moment of inertia"},
      {"chain", "bodies of the scene"},
      {"chain on a sprocket or guide", "what the chain runs over"},
      {"oil of the chamber", "the chamber is full of oil or of air"},
      {"valve train", "bodies of the scene"},
      {"lash adjuster of valves", "one device or another"},
      {"roller on cam", "what the follower runs on"},
      {"contacts of valve and follower", "what holds a valve"},
      {"follower", "a body of the scene"}};
  return reasons;
}

/// "ViscosityOverPressure" of a parameter.
inline std::string name_of_effect(const ::testing::TestParamInfo<std::string>& info) {
  std::string name;
  bool first = true;
  for (const char c : info.param) {
    if (!std::isalnum(static_cast<unsigned char>(c))) {
      first = true;
      continue;
    }
    name += first ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    first = false;
  }
  return name;
}

}  // namespace clatter::dynamics::testing
