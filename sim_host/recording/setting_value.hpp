// The value of a setting in its unit, which docs/container-format.md names.
#pragma once

#include <cmath>

#include "palpate/firmware/settings.hpp"

namespace palpate::recording {

/// Takes the calls of a FieldReader.
class ValueOfSetting {
 public:
  explicit ValueOfSetting(const firmware::SettingChange& change) : change_(change) {}

  template <class Integer, class... Range>
  void number(const char*, const Integer&, const Range&...) {
    if (++at_ == change_.setting) value_ = static_cast<double>(static_cast<Integer>(change_.value));
  }
  template <int I, int F, class... Range>
  void fixed(const char*, const Q<I, F>&, const Range&...) {
    if (++at_ == change_.setting) value_ = std::ldexp(change_.value, -F);
  }
  [[nodiscard]] double value() const { return value_; }

 private:
  firmware::SettingChange change_;
  uint16_t at_ = 0;
  double value_ = 0.0;
};

/// 0 where there is no such setting.
inline double value_of(const firmware::SettingChange& change) {
  ValueOfSetting setting(change);
  const safety::Parameters parameters{};
  const RemeshRules rules{};
  firmware::all_settings(setting, parameters, rules);
  return setting.value();
}

}  // namespace palpate::recording
