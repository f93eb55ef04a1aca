// Bodies for ParaView: the files, and what a run puts into them. tests/paper/read_vtu.py reads them with VTK.
#include "output/vtu_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <pugixml.hpp>

#include "program.hpp"
#include "text/base64.hpp"

namespace palpate::test {
namespace {

using sim::UnstructuredGrid;

constexpr const char* kRun = "run cuboid-sine --level 3 --substeps 2 --ticks 50 --plots off --out run";

std::string bytes_of(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  uint32_t bits = 0;
  uint32_t count = 0;
  for (const char digit : base64) {
    if (digit == '=') break;
    bits = bits << 6 | static_cast<uint32_t>(digits.find(digit));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xffu);
  }
  return bytes;
}

class Vtu {
 public:
  explicit Vtu(const std::filesystem::path& path) {
    EXPECT_TRUE(document_.load_file(path.c_str())) << path;
    piece_ = document_.child("VTKFile").child("UnstructuredGrid").child("Piece");
  }
  [[nodiscard]] std::size_t points() const { return piece_.attribute("NumberOfPoints").as_uint(); }
  [[nodiscard]] std::size_t cells() const { return piece_.attribute("NumberOfCells").as_uint(); }

  [[nodiscard]] std::vector<std::string> names(const char* group) const {
    std::vector<std::string> all;
    for (const auto& array : piece_.child(group)) all.emplace_back(array.attribute("Name").value());
    return all;
  }
  template <class Number>
  [[nodiscard]] std::vector<Number> array(const char* group, const char* name) const {
    const auto node = piece_.child(group).find_child_by_attribute("Name", name);
    const std::string bytes = bytes_of(node.text().get());
    uint64_t size = 0;
    if (bytes.size() < sizeof size) return {};
    std::memcpy(&size, bytes.data(), sizeof size);
    EXPECT_EQ(size + sizeof size, bytes.size());
    std::vector<Number> values(size / sizeof(Number));
    std::memcpy(values.data(), bytes.data() + sizeof size, size);
    return values;
  }
  [[nodiscard]] double volume_of_tet(std::size_t tet) const {
    const auto at = array<double>("Points", "Points");
    const auto nodes = array<int64_t>("Cells", "connectivity");
    const auto point = [&](std::size_t i) {
      return Eigen::Vector3d(&at[3 * static_cast<std::size_t>(nodes[4 * tet + i])]);
    };
    return (point(1) - point(0)).cross(point(2) - point(0)).dot(point(3) - point(0)) / 6.0;
  }

 private:
  pugi::xml_document document_;
  pugi::xml_node piece_;
};

/// Times and files.
std::vector<std::string> entries_of(const std::filesystem::path& pvd) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_file(pvd.c_str()));
  std::vector<std::string> entries;
  for (const auto& entry : document.child("VTKFile").child("Collection")) {
    entries.push_back(
        fmt::format("{} {}", entry.attribute("timestep").value(), entry.attribute("file").value()));
  }
  return entries;
}

TEST(Base64, IsThatOfTheStandard) {
  const char* cases[][2] = {{"", ""},
                            {"f", "Zg=="},
                            {"fo", "Zm8="},
                            {"foo", "Zm9v"},
                            {"foob", "Zm9vYg=="},
                            {"fooba", "Zm9vYmE="},
                            {"foobar", "Zm9vYmFy"},
                            {"\xff\xfe", "//4="}};
  for (const auto& [bytes, text] : cases) {
    EXPECT_EQ(sim::base64(bytes), text);
    EXPECT_EQ(bytes_of(text), bytes);
  }
}

UnstructuredGrid one_tet() {
  return UnstructuredGrid{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}},
                          {{0, 1, 2, 3}},
                          {{"force", std::vector<std::array<double, 3>>(4, {1, 2, 3})}},
                          {{"a<b", std::vector<int32_t>{-7}}}};
}

TEST(VtuFile, HoldsTheGridExactly) {
  const TemporaryFolder folder;
  sim::write_vtu(folder / "tet.vtu", one_tet());
  const Vtu vtu(folder / "tet.vtu");
  EXPECT_EQ(vtu.points(), 4U);
  EXPECT_EQ(vtu.cells(), 1U);
  EXPECT_EQ(vtu.array<double>("Points", "Points"),
            (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1}));
  EXPECT_EQ(vtu.array<int64_t>("Cells", "connectivity"), (std::vector<int64_t>{0, 1, 2, 3}));
  EXPECT_EQ(vtu.array<int64_t>("Cells", "offsets"), std::vector<int64_t>{4});
  EXPECT_EQ(vtu.array<uint8_t>("Cells", "types"), std::vector<uint8_t>{10});
  EXPECT_EQ(vtu.array<double>("PointData", "force").size(), 12U);
  EXPECT_EQ(vtu.array<int32_t>("CellData", "a<b"), std::vector<int32_t>{-7});
}

TEST(VtuFile, RefusesAnArrayOfAnotherLength) {
  const TemporaryFolder folder;
  UnstructuredGrid grid = one_tet();
  grid.cell_data.push_back({"level", std::vector<int32_t>{1, 2}});
  EXPECT_THROW(sim::write_vtu(folder / "tet.vtu", grid), std::invalid_argument);
  EXPECT_TRUE(folder.contents().empty());
}

TEST(VtuRun, WritesEverySoManyTicksTheFirstAndTheLast) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(folder, std::string(kRun) + " --vtu-every 20").exit_code, 0);
  const std::vector<std::string> expected = {"0 vtu/tick_000000.vtu", "0.02 vtu/tick_000020.vtu",
                                             "0.04 vtu/tick_000040.vtu", "0.05 vtu/tick_000050.vtu"};
  EXPECT_EQ(entries_of(folder / "run/body.pvd"), expected);
  const auto contents = folder.contents();
  const auto files = std::count_if(contents.begin(), contents.end(),
                                   [](const std::string& name) { return name.rfind("run/vtu/", 0) == 0; });
  EXPECT_EQ(static_cast<std::size_t>(files), expected.size());
}

TEST(VtuRun, ShowsTheBody) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(folder, std::string(kRun) + " --vtu-every 50").exit_code, 0);
  const Vtu rest(folder / "run/vtu/tick_000000.vtu");
  const Vtu now(folder / "run/vtu/tick_000050.vtu");
  EXPECT_EQ(now.points(), 63U);
  EXPECT_EQ(now.cells(), 144U);
  EXPECT_EQ(now.names("PointData"),
            (std::vector<std::string>{"displacement_mm", "velocity_mm_s", "force_mN"}));
  EXPECT_EQ(now.names("CellData"),
            (std::vector<std::string>{"level", "region", "rotation_tet", "volume_ratio", "von_mises_Pa"}));
  EXPECT_EQ(now.array<int32_t>("CellData", "level"), std::vector<int32_t>(144, 3));
  const auto ratio = now.array<double>("CellData", "volume_ratio");
  double sum_mm3 = 0.0;
  for (std::size_t tet = 0; tet < now.cells(); ++tet) {
    const double at_rest_mm3 = rest.volume_of_tet(tet);
    EXPECT_GT(at_rest_mm3, 0.0);
    EXPECT_NEAR(now.volume_of_tet(tet) / at_rest_mm3, ratio[tet], 1e-6);
    sum_mm3 += at_rest_mm3;
  }
  EXPECT_NEAR(sum_mm3, 3 * 64.0 * 64.0 * 64.0, 1e-6);
}

/// The driven corner: tick 49 of u = 50 mm sin(0.072 k deg), and its speed.
TEST(VtuRun, ShowsTheMotion) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(folder, std::string(kRun) + " --vtu-every 50").exit_code, 0);
  const Vtu now(folder / "run/vtu/tick_000050.vtu");
  const auto u_mm = now.array<double>("PointData", "displacement_mm");
  const auto v_mm_s = now.array<double>("PointData", "velocity_mm_s");
  const auto force_mn = now.array<double>("PointData", "force_mN");
  const auto corner = static_cast<std::size_t>(std::max_element(u_mm.begin(), u_mm.end()) - u_mm.begin());
  EXPECT_NEAR(u_mm[corner], 50.0 * std::sin(0.072 * 49 * M_PI / 180.0), 1e-5);
  EXPECT_NEAR(v_mm_s[corner], 50.0 * 0.072 * M_PI / 180.0 * 1e3, 0.3);
  EXPECT_LT(force_mn[corner], -0.1);  // it pulls back
}

TEST(VtuRun, IsATomlKeyAndADeviceHasItToo) {
  const TemporaryFolder folder;
  write_text(folder / "soft.toml",
             "scenario = 'grasp'\nlevel = 3\nsubsteps = 2\nticks = 10\nplots = false\nout = 'run'\nvtu_every "
             "= 10\n");
  ASSERT_EQ(run_program(folder, "hil soft.toml").exit_code, 0);
  EXPECT_EQ(entries_of(folder / "run/body.pvd").size(), 2U);
}

TEST(VtuRun, ReplacesItsOwnFilesOnly) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(folder, std::string(kRun) + " --vtu-every 10").exit_code, 0);
  ASSERT_EQ(run_program(folder, std::string(kRun) + " --vtu-every 25").exit_code, 0);
  EXPECT_EQ(entries_of(folder / "run/body.pvd").size(), 3U);
  write_text(folder / "run/vtu/view.pvsm", "an afternoon of colours");
  const Outcome outcome = run_program(folder, std::string(kRun));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("holds 'view.pvsm'"), std::string::npos) << outcome.err;
  std::filesystem::remove(folder / "run/vtu/view.pvsm");
  ASSERT_EQ(run_program(folder, std::string(kRun)).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "run/vtu"));
  EXPECT_FALSE(std::filesystem::exists(folder / "run/body.pvd"));
}

TEST(VtuRun, FullDiskLeavesNothing) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, std::string(kRun) + " --vtu-every 10", "ulimit -f 8;");
  EXPECT_EQ(outcome.exit_code, 3);
  expect_one_line(outcome.err);
  EXPECT_NE(outcome.err.find("tick_000000.vtu"), std::string::npos) << outcome.err;
  EXPECT_TRUE(folder.contents().empty());
}

}  // namespace
}  // namespace palpate::test
