// Tetrahedral bodies as VTK's XML files, which ParaView and VTK read: a .vtu holds a body at one time, a .pvd
// lists those of a series.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace palpate::sim {

/// A value a point or a cell; the name carries the unit.
struct DataArray {
  std::string name;
  std::variant<std::vector<double>, std::vector<std::array<double, 3>>, std::vector<int32_t>> values;
};

struct UnstructuredGrid {
  std::vector<std::array<double, 3>> points;
  /// Places of points; (p1 - p0) x (p2 - p0) . (p3 - p0) > 0, as VTK_TETRA wants it.
  std::vector<std::array<uint32_t, 4>> tets;
  std::vector<DataArray> point_data, cell_data;
};

/// Numbers are base64 of their bytes, so they are exact. The file appears complete or not at all. Throws
/// EnvironmentError when it cannot be written, std::invalid_argument when an array has not one value a point
/// or cell.
void write_vtu(const std::filesystem::path& path, const UnstructuredGrid& grid);

struct PvdEntry {
  double time_s;
  std::string file;  // relative to the .pvd
};

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries);

}  // namespace palpate::sim
