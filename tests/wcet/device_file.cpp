// The file of a board's devices.
#include <algorithm>

#include "devices.hpp"
#include "refusal.hpp"
#include "toml_file.hpp"

namespace palpate::wcet {
namespace {

class DeviceFile {
 public:
  explicit DeviceFile(std::string path) : path_(std::move(path)) {}

  Devices read() {
    const toml::table file = read_toml(path_, "has no device ranges");
    if (const toml::array* names = file["ports"].as_array()) {
      for (const toml::node& name : *names) devices_.ports.push_back(name.value_or(std::string()));
    }
    for (const toml::table& row : rows_of(file, "range")) devices_.ranges.push_back(read_range(row));
    if (devices_.ranges.empty() || devices_.ports.empty())
      throw BadInput(path_ + " has no ranges or no ports");
    for (const toml::table& row : rows_of(file, "port")) devices_.contracts.push_back(read_contract(row));
    return std::move(devices_);
  }

 private:
  static std::vector<toml::table> rows_of(const toml::table& file, const char* key) {
    std::vector<toml::table> rows;
    const toml::array* list = file[key].as_array();
    if (list == nullptr) return rows;
    for (const toml::node& node : *list) rows.push_back(node.is_table() ? *node.as_table() : toml::table());
    return rows;
  }

  static int64_t number(const toml::table& row, const char* key) { return row[key].value_or(int64_t{-1}); }
  static std::string text(const toml::table& row, const char* key) {
    return row[key].value_or(std::string());
  }

  DeviceRange read_range(const toml::table& row) const {
    DeviceRange range;
    range.name = text(row, "name");
    range.first = static_cast<uint32_t>(number(row, "first"));
    range.last = static_cast<uint32_t>(number(row, "last"));
    range.cycles = number(row, "cycles");
    const bool is_whole = !range.name.empty() && number(row, "first") >= 0 &&
                          number(row, "last") >= number(row, "first") && range.cycles >= 0 &&
                          !text(row, "source").empty();
    if (!is_whole) throw BadInput(path_ + " has a range without name, first, last, cycles or source");
    return range;
  }

  PortContract read_contract(const toml::table& row) const {
    const std::string name = text(row, "name");
    const std::string range = text(row, "range");
    const auto found = std::find_if(devices_.ranges.begin(), devices_.ranges.end(),
                                    [&](const DeviceRange& known) { return known.name == range; });
    if (name.empty() || number(row, "accesses") < 0 || found == devices_.ranges.end())
      throw BadInput(path_ + " has a port without name, accesses or a range that the file has");
    return {name, static_cast<uint32_t>(number(row, "accesses")), found->cycles};
  }

  std::string path_;
  Devices devices_;
};

}  // namespace

Devices read_devices(const std::string& path) { return DeviceFile(path).read(); }

}  // namespace palpate::wcet
