// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/block_table.hpp"

#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {

const Keys<BoreSpec>& bore_keys() {
  static const Keys<BoreSpec> keys(
      "block", "where a cylinder is on the block", [](auto& key, BoreSpec& bore) {
        key.text("liner", bore.liner, "contact grid of the bore");
        key.text("liner_axial", bore.liner_axial,
                 "set of the liner's displacement along its axis; without it the rigid frame");
        key.texts("bearings", bore.bearings,
                  "sets of the main bearings beside the crank pin; without them the rigid frame");
        key.text("gas_load", bore.gas_load, "unit load of the gas on the head, per Pa");
      });
  return keys;
}

const Keys<BlockTable>& block_keys() {
  static const Keys<BlockTable> keys("block", "the engine block, a reduced part; rigid: the ground",
                                     [](auto& key, BlockTable& block) {
                                       key.part(block.body, body_keys());
                                       key.part(block.bore, bore_keys());
                                     });
  return keys;
}

bool has_elastic_block(const Config& root) {
  const auto table = root.find_table("block");
  return table && block_keys().read(*table).body.elastic;
}

}  // namespace clatter::dynamics
