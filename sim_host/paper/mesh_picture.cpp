#include "paper/mesh_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "output/projection.hpp"

namespace palpate::sim {
namespace {

constexpr Point3 kTowardsMeshViewer = {-0.88, -0.38, 0.28};
constexpr Point3 kMeshLight = {-0.70, -0.10, 0.70};
constexpr double kMarginMm = 8.0;
constexpr int kCoarsest = 3;
constexpr int kFinest = 9;
// Of the coarsest and the finest level.
constexpr std::array<double, 3> kCoarseColour = {250, 246, 238};
constexpr std::array<double, 3> kFineColour = {60, 120, 190};

/// A triangle of the surface and the tet it belongs to.
struct Facet {
  std::array<uint32_t, 3> node;  // normal outwards
  uint32_t tet;
};

/// Faces that only one tet has.
std::vector<Facet> surface_of(const BodyFields& body) {
  constexpr std::array<std::array<std::size_t, 3>, 4> kFaces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  std::map<std::array<uint32_t, 3>, Facet> once;
  for (uint32_t t = 0; t < body.tets.size(); ++t) {
    for (const auto& face : kFaces) {
      const Facet facet{{body.tets[t][face[0]], body.tets[t][face[1]], body.tets[t][face[2]]}, t};
      auto key = facet.node;
      std::sort(key.begin(), key.end());
      const auto [found, is_new] = once.emplace(key, facet);
      if (!is_new) once.erase(found);
    }
  }
  std::vector<Facet> surface;
  surface.reserve(once.size());
  for (const auto& [key, facet] : once) surface.push_back(facet);
  return surface;
}

using Edge = std::pair<uint32_t, uint32_t>;

Edge edge_of(const Facet& facet, std::size_t i) {
  return std::minmax(facet.node[i], facet.node[(i + 1) % 3]);
}

class Panel {
 public:
  Panel(const MeshPanel& panel, const Projection& projection)
      : panel_(panel), projection_(projection), facets_(surface_of(*panel.body)) {
    for (const Facet& facet : facets_) {
      for (std::size_t i = 0; i < 3; ++i) tets_at_[edge_of(facet, i)].push_back(facet.tet);
    }
    for (const Point3& p : panel.body->now_mm) {
      left_ = std::min(left_, projection.right(p));
      right_ = std::max(right_, projection.right(p));
      bottom_ = std::min(bottom_, projection.up(p));
      top_ = std::max(top_, projection.up(p));
    }
  }

  [[nodiscard]] double width() const { return right_ - left_; }
  [[nodiscard]] double bottom() const { return bottom_; }
  [[nodiscard]] double top() const { return top_; }

  /// Objects, with the panel's left end at `x`.
  [[nodiscard]] std::string script(double x) const {
    std::string text;
    for (const Facet& facet : visible()) text += polygon(facet, x - left_) + lines(facet, x - left_);
    return text;
  }

 private:
  [[nodiscard]] const Point3& at(uint32_t node) const { return panel_.body->now_mm[node]; }

  [[nodiscard]] Point3 normal(const Facet& facet) const {
    const Point3 n =
        cross(minus(at(facet.node[1]), at(facet.node[0])), minus(at(facet.node[2]), at(facet.node[0])));
    const double size = std::max(length(n), 1e-12);
    return {n[0] / size, n[1] / size, n[2] / size};
  }

  /// Facets that face the viewer, the nearest last.
  [[nodiscard]] std::vector<Facet> visible() const {
    std::vector<Facet> front;
    for (const Facet& facet : facets_) {
      if (projection_.nearness(normal(facet)) > 0.0) front.push_back(facet);
    }
    const auto nearness = [&](const Facet& f) {
      return projection_.nearness(at(f.node[0])) + projection_.nearness(at(f.node[1])) +
             projection_.nearness(at(f.node[2]));
    };
    std::stable_sort(front.begin(), front.end(),
                     [&](const Facet& a, const Facet& b) { return nearness(a) < nearness(b); });
    return front;
  }

  [[nodiscard]] std::string place(uint32_t node, double shift) const {
    return fmt::format("{:.2f},{:.2f}", projection_.right(at(node)) + shift, projection_.up(at(node)));
  }

  [[nodiscard]] std::string polygon(const Facet& facet, double shift) const {
    const int level = std::clamp(panel_.body->level[facet.tet], kCoarsest, kFinest);
    const double part = static_cast<double>(level - kCoarsest) / (kFinest - kCoarsest);
    const double shade = 0.78 + 0.22 * std::max(0.0, dot(normal(facet), kMeshLight));
    const auto channel = [&](std::size_t i) {
      return static_cast<int>(shade * (kCoarseColour[i] + part * (kFineColour[i] - kCoarseColour[i])));
    };
    return fmt::format(
        "set object polygon from {} to {} to {} to {} fc rgb '#{:02x}{:02x}{:02x}' fs solid 1.0 border rgb "
        "'#77818c' lw 0.4\n",
        place(facet.node[0], shift), place(facet.node[1], shift), place(facet.node[2], shift),
        place(facet.node[0], shift), channel(0), channel(1), channel(2));
  }

  /// Bold where the next facet belongs to another rotation tet. Polygons of two corners, since objects cover
  /// each other in their order and arrows do not.
  [[nodiscard]] std::string lines(const Facet& facet, double shift) const {
    if (!panel_.shows_rotation_tets) return "";
    std::string text;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge edge = edge_of(facet, i);
      const auto& tets = tets_at_.at(edge);
      const auto group = [&](uint32_t tet) { return panel_.body->rotation_tet[tet]; };
      const bool same =
          std::all_of(tets.begin(), tets.end(), [&](uint32_t tet) { return group(tet) == group(facet.tet); });
      if (same) continue;
      text += fmt::format("set object polygon from {0} to {1} to {0} fs empty border rgb '#c41e32' lw 1.6\n",
                          place(edge.first, shift), place(edge.second, shift));
    }
    return text;
  }

  const MeshPanel& panel_;
  const Projection& projection_;
  std::vector<Facet> facets_;
  std::map<Edge, std::vector<uint32_t>> tets_at_;
  double left_ = 1e9, right_ = -1e9, bottom_ = 1e9, top_ = -1e9;
};

}  // namespace

std::string mesh_picture_script(const std::string& file, const std::vector<MeshPanel>& panels) {
  constexpr double kPixelsPerMm = 1.9;
  constexpr double kTitleMm = 22.0;
  constexpr double kGapMm = 26.0;
  const Projection projection(kTowardsMeshViewer);
  std::vector<Panel> drawn;
  double bottom = 1e9;
  double top = -1e9;
  for (const MeshPanel& panel : panels) {
    drawn.emplace_back(panel, projection);
    bottom = std::min(bottom, drawn.back().bottom());
    top = std::max(top, drawn.back().top());
  }
  std::string objects;
  double x = kMarginMm;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    objects += drawn[i].script(x);
    objects += fmt::format("set label \"{}\" at {:.2f},{:.2f} center\n", panels[i].title,
                           x + drawn[i].width() / 2.0, top + kTitleMm * 0.7);
    x += drawn[i].width() + kGapMm;
  }
  const double width = x - kGapMm + kMarginMm;
  const double height = top - bottom + kMarginMm + kTitleMm;
  return fmt::format(
             "reset\nset terminal svg size {:.0f},{:.0f} font 'Helvetica,14' background '#ffffff'\nset "
             "output "
             "'{}'\nunset border\nunset tics\nunset key\nset margins screen 0, screen 1, screen 0, screen 1\n"
             "set xrange [0:{:.2f}]\nset yrange [{:.2f}:{:.2f}]\n",
             width * kPixelsPerMm, height * kPixelsPerMm, file, width, bottom - kMarginMm, top + kTitleMm) +
         objects + "plot NaN notitle\nunset output\n";
}

}  // namespace palpate::sim
