#include "fem_reference/fields.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "fem_reference/kernel/gauss_lobatto.h"

namespace ddem::fem {
namespace {

using Place = std::array<double, 2>;

// A straight-sided element maps (xi, eta) bilinearly.
Place place_in(const std::array<Place, 4>& corners, double xi, double eta) {
  Place place{};
  for (int c = 0; c < 2; ++c) {
    place[c] = (1.0 - eta) * ((1.0 - xi) * corners[0][c] + xi * corners[1][c]) + eta * ((1.0 - xi) * corners[2][c] + xi * corners[3][c]);
  }
  return place;
}

// The points of a mesh: a node away from where the model has it is a second point.
class Points {
 public:
  Points(const StripModel& model, FieldMesh& mesh) : mesh_(mesh) {
    mesh_.x = model.x;
    mesh_.y = model.y;
    for (std::uint32_t node = 0; node < model.x.size(); ++node) mesh_.nodes.push_back(node);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const auto& corners : model.corners) {
      for (const Place& corner : corners) {
        low = std::min(low, corner[1]);
        high = std::max(high, corner[1]);
      }
    }
    half_height_ = 0.5 * (high - low);
  }

  std::uint32_t at(std::uint32_t node, const Place& place) {
    if (std::abs(place[1] - mesh_.y[node]) < half_height_) return node;  // else at the opposite edge
    const auto [found, is_new] = second_.try_emplace(node, static_cast<std::uint32_t>(mesh_.x.size()));
    if (is_new) {
      mesh_.nodes.push_back(node);
      mesh_.x.push_back(place[0]);
      mesh_.y.push_back(place[1]);
    }
    return found->second;
  }

 private:
  FieldMesh& mesh_;
  double half_height_ = 0.0;
  std::unordered_map<std::uint32_t, std::uint32_t> second_;
};

}  // namespace

FieldMesh field_mesh(const StripModel& model) {
  FieldMesh mesh;
  Points points(model, mesh);
  const auto p = static_cast<std::size_t>(model.mesh.degree), row = p + 1;
  const std::vector<double> rule = gauss_lobatto(model.mesh.degree).points;
  std::vector<std::uint32_t> local(row * row);
  for (std::size_t element = 0; element < model.mesh.element_count(); ++element) {
    for (std::size_t k = 0; k < local.size(); ++k) {
      local[k] = points.at(model.mesh.nodes[element * local.size() + k], place_in(model.corners[element], rule[k % row], rule[k / row]));
    }
    for (std::size_t j = 0; j < p; ++j) {
      for (std::size_t i = 0; i < p; ++i) {
        const std::size_t k = j * row + i;
        mesh.quadrilaterals.push_back({local[k], local[k + 1], local[k + row + 1], local[k + row]});
      }
    }
  }
  return mesh;
}

}  // namespace ddem::fem
