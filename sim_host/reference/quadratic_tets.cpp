#include "reference/quadratic_tets.hpp"

#include <algorithm>
#include <map>

namespace palpate::reference {
namespace {

constexpr uint32_t kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr double kNear = 0.58541019662496845;  // (5 + 3 sqrt 5) / 20
constexpr double kFar = 0.13819660112501051;   // (5 - sqrt 5) / 20

std::array<uint32_t, 10> nodes_of(Mesh& mesh, std::map<std::pair<uint32_t, uint32_t>, uint32_t>& middle,
                                  const std::array<uint32_t, 4>& corner) {
  std::array<uint32_t, 10> nodes{};
  std::copy(corner.begin(), corner.end(), nodes.begin());
  for (uint32_t e = 0; e < 6; ++e) {
    const std::pair<uint32_t, uint32_t> edge = std::minmax(corner[kEdges[e][0]], corner[kEdges[e][1]]);
    const auto next = static_cast<uint32_t>(mesh.rest.size());
    nodes[4 + e] = middle.emplace(edge, next).first->second;
    if (nodes[4 + e] != next) continue;
    const Vector at = 0.5 * (mesh.rest[edge.first] + mesh.rest[edge.second]);
    mesh.rest.push_back(at);
  }
  return nodes;
}

ElementOf<10> at_point(const Element& linear, const std::array<uint32_t, 10>& nodes, uint32_t point) {
  std::array<double, 4> l{kFar, kFar, kFar, kFar};
  l[point] = kNear;
  ElementOf<10> element{};
  element.node = nodes;
  element.volume = linear.volume / 4;
  element.region = linear.region;
  for (uint32_t i = 0; i < 4; ++i) element.gradient[i] = (4 * l[i] - 1) * linear.gradient[i];
  for (uint32_t e = 0; e < 6; ++e) {
    const uint32_t i = kEdges[e][0];
    const uint32_t j = kEdges[e][1];
    element.gradient[4 + e] = 4 * (l[i] * linear.gradient[j] + l[j] * linear.gradient[i]);
  }
  return element;
}

}  // namespace

QuadraticBody quadratic_body(const Mesh& mesh) {
  QuadraticBody body;
  body.mesh = mesh;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middle;
  const std::vector<Element> linear = elements_of(mesh);
  for (uint32_t t = 0; t < linear.size(); ++t) {
    const std::array<uint32_t, 10> nodes = nodes_of(body.mesh, middle, mesh.tet[t]);
    for (uint32_t point = 0; point < 4; ++point) body.elements.push_back(at_point(linear[t], nodes, point));
  }
  return body;
}

}  // namespace palpate::reference
