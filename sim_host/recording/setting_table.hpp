// The firmware's settings as a table, with values in their units, which docs/container-format.md names.
#pragma once

#include <vector>

#include "palpate/firmware/settings.hpp"

namespace palpate::recording {

struct Setting {
  const char* name;
  double least, most;  // in its unit
  double lsb;          // 1: a whole number
  bool has_sign;
};

/// By number, from 1 on.
const std::vector<Setting>& setting_table();

/// In the setting's unit; 0 where there is no such setting.
double value_of(const firmware::SettingChange& change);
/// `value` in the setting's unit, within its range.
firmware::SettingChange change_to(uint16_t setting, double value);

}  // namespace palpate::recording
