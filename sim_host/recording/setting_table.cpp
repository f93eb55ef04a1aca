#include "recording/setting_table.hpp"

#include <cmath>

namespace palpate::recording {
namespace {

/// Takes the calls of a FieldReader.
class TableMaker {
 public:
  template <class Integer>
  void number(const char* name, const Integer&,
              std::common_type_t<Integer> least = std::numeric_limits<Integer>::min(),
              std::common_type_t<Integer> most = std::numeric_limits<Integer>::max()) {
    table.push_back(
        {name, static_cast<double>(least), static_cast<double>(most), 1.0, std::is_signed_v<Integer>});
  }
  template <int I, int F>
  void fixed(const char* name, const Q<I, F>&, Q<I, F> least = Q<I, F>::min(),
             Q<I, F> most = Q<I, F>::max()) {
    table.push_back(
        {name, std::ldexp(least.raw(), -F), std::ldexp(most.raw(), -F), std::ldexp(1.0, -F), true});
  }

  std::vector<Setting> table{};
};

std::vector<Setting> make_table() {
  TableMaker maker;
  const safety::Parameters parameters{};
  const RemeshRules rules{};
  firmware::all_settings(maker, parameters, rules);
  return maker.table;
}

}  // namespace

const std::vector<Setting>& setting_table() {
  static const std::vector<Setting> table = make_table();
  return table;
}

// 32 bits without a sign travel in the same 32 bits.
double value_of(const firmware::SettingChange& change) {
  if (change.setting == 0 || change.setting > setting_table().size()) return 0.0;
  const Setting& setting = setting_table()[change.setting - 1u];
  const auto raw = setting.has_sign ? int64_t{change.value} : int64_t{static_cast<uint32_t>(change.value)};
  return static_cast<double>(raw) * setting.lsb;
}

firmware::SettingChange change_to(uint16_t setting, double value) {
  const auto raw = std::llround(value / setting_table()[setting - 1u].lsb);
  return {setting, static_cast<int32_t>(static_cast<uint32_t>(raw))};
}

}  // namespace palpate::recording
