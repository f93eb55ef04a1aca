#include "output/vtu_series.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "scenario/errors.hpp"

namespace palpate::sim {
namespace {

using Vectors = std::vector<std::array<double, 3>>;

Vectors difference(const Vectors& a, const Vectors& b) {
  Vectors result = a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) result[i][axis] -= b[i][axis];
  }
  return result;
}

Vectors in_milli(Vectors values) {
  for (auto& value : values) {
    for (double& component : value) component *= 1e3;
  }
  return values;
}

std::string file_name(uint32_t tick) { return fmt::format("tick_{:06}.vtu", tick); }

}  // namespace

UnstructuredGrid grid_of(const BodyFields& fields) {
  return UnstructuredGrid{fields.now_mm,
                          fields.tets,
                          {{"displacement_mm", difference(fields.now_mm, fields.rest_mm)},
                           {"velocity_mm_s", fields.velocity_mm_s},
                           {"force_mN", in_milli(fields.force_n)}},
                          {{"level", fields.level},
                           {"region", fields.region},
                           {"rotation_tet", fields.rotation_tet},
                           {"volume_ratio", fields.volume_ratio},
                           {"von_mises_Pa", fields.von_mises_pa}}};
}

VtuSeries::VtuSeries(const std::filesystem::path& folder) : folder_(folder) {
  std::error_code error;
  std::filesystem::create_directory(folder_ / kFolder, error);
  if (error) {
    throw EnvironmentError(
        fmt::format("cannot write '{}': {}", (folder_ / kFolder).string(), error.message()));
  }
}

void VtuSeries::add(const BodyFields& fields, uint32_t tick) {
  const std::string file = fmt::format("{}/{}", kFolder, file_name(tick));
  write_vtu(folder_ / file, grid_of(fields));
  entries_.push_back({tick / 1000.0, file});
}

void VtuSeries::close() const { write_pvd(folder_ / kList, entries_); }

bool VtuSeries::is_file_name(const std::string& name) {
  uint32_t tick = 0;
  return std::sscanf(name.c_str(), "tick_%9u.vtu", &tick) == 1 && name == file_name(tick);
}

}  // namespace palpate::sim
