// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// *SHELL SECTION and *NODAL THICKNESS.
#include <string>
#include <vector>

#include "mesh/deck/abaqus/cells.hpp"
#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {

/// Node indices of an element of two dimensions, by its row.
ShellFace face_of_shell(const Model& model, size_t thin);

/// A line of *SHELL SECTION, COMPOSITE.
struct Ply {
  std::string material;  // name in Deck::materials
  double thickness = 0.0;
  std::string system;  // of its own, or
  double angle = 0.0;  // from that of the section [rad]
};

/// What a section gives to its shells.
struct ShellGift {
  Origin origin = 0;
  double thickness = 0.0;
  double offset = 0.0;           // OFFSET: from the mid-surface to the nodes, over the thickness
  bool is_nodal = false;         // NODAL THICKNESS
  bool has_directions = false;   // a material is not isotropic
  std::string system, material;  // names in the deck, or empty
  std::vector<Ply> plies;
};

class ShellSections {
 public:
  explicit ShellSections(Model& model) : model_(model) {}

  /// Adds a region and a recipe::Shell for each.
  void read();
  /// A shell by its row.
  ShellCell cell_of(size_t thin) const;

 private:
  void read_thickness(size_t use, const Card& card);
  double nodal(const ThinElement& element, size_t i) const;
  ShellGift gift_of(size_t use, const Card& card) const;
  std::vector<Ply> plies_of(size_t use, const Card& card) const;
  bool is_isotropic(const std::string& material) const;
  double angle_of(const Ply& ply, const ShellGift& gift, int32_t section) const;
  double offset_of(const Card& card) const;
  int32_t add_region(size_t use, const Card& card, int32_t section);
  int32_t new_region(size_t use, const std::string& set, Origin origin,
                     const std::string& material);
  std::string material_of(const std::string& wanted, Origin origin) const;

  Model& model_;
  std::vector<ShellGift> gifts_;
  std::vector<double> nodal_;  // by row; NaN: none
};

}  // namespace clatter::mesh::deck::abaqus
