// A body over time for ParaView: vtu/tick_000000.vtu and so on, and body.pvd, which lists them.
#pragma once

#include "output/vtu_file.hpp"
#include "simulation/body_fields.hpp"

namespace palpate::sim {

/// Points where they are now; displacement_mm, velocity_mm_s and force_mN of nodes; level, region,
/// rotation_tet, volume_ratio and von_mises_Pa of tets.
UnstructuredGrid grid_of(const BodyFields& fields);

class VtuSeries {
 public:
  static constexpr const char* kFolder = "vtu";
  static constexpr const char* kList = "body.pvd";

  /// Creates `folder`/vtu. Throws EnvironmentError when that cannot be done.
  explicit VtuSeries(const std::filesystem::path& folder);

  /// A tick is 1 ms.
  void add(const BodyFields& fields, uint32_t tick);
  /// Writes the list.
  void close() const;

  /// Whether this is a name that add gives.
  [[nodiscard]] static bool is_file_name(const std::string& name);

 private:
  std::filesystem::path folder_;
  std::vector<PvdEntry> entries_;
};

}  // namespace palpate::sim
