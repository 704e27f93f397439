#include "mesh/deck/abaqus/reading.hpp"

namespace clatter::mesh::deck::abaqus {

Places::Places(const Model* model, Deck* deck, std::vector<int32_t> mesh_node)
    : model_(model), deck_(deck), mesh_node_(std::move(mesh_node)) {}

Place Places::find(int32_t row) const {
  const auto point = point_of_.find(row);
  return point != point_of_.end() ? point->second : mesh_node(row);
}

Place Places::of(int32_t row) {
  const Place place = find(row);
  return place != kNone ? place : add_point(row);
}

bool Places::is_point(Place place) const {
  return place >= static_cast<Place>(deck_->mesh.nodes.rows());
}

Place Places::add_point(int32_t row) {
  const auto place =
      static_cast<Place>(deck_->mesh.nodes.rows() + static_cast<int64_t>(deck_->points.size()));
  deck_->points.push_back({model_->node_ids()[static_cast<size_t>(row)], model_->at(row)});
  point_of_[row] = place;
  return place;
}

Place Places::point_upon(int32_t row) {
  const auto point = point_of_.find(row);
  return point != point_of_.end() ? point->second : add_point(row);
}

Place Places::rotation_of(int32_t row) const {
  const auto at = rotation_of_.find(row);
  return at != rotation_of_.end() ? at->second : kNone;
}

void Places::set_system(const std::vector<int32_t>& rows, const std::string& name) {
  if (system_of_.empty()) system_of_.assign(static_cast<size_t>(model_->nodes()), 0);
  for (const int32_t row : rows) {
    system_of_[static_cast<size_t>(row)] = static_cast<int32_t>(system_names_.size());
  }
  system_names_.push_back(name);
}

const std::string& Places::system(int32_t row) const {
  return system_of_.empty()
             ? system_names_.front()
             : system_names_[static_cast<size_t>(system_of_[static_cast<size_t>(row)])];
}

}  // namespace clatter::mesh::deck::abaqus
