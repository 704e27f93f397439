// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cad/step_names.hpp"

#include <Interface_Static.hxx>
#include <STEPCAFControl_Controller.hxx>

namespace clatter::mesh {

void keep_step_names() {
  STEPCAFControl_Controller::Init();  // defines the option
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
}

}  // namespace clatter::mesh
