// What may be changed while the cycle runs, by a number from 1 on: the thresholds of the safety layer and of
// the two fronts. docs/container-format.md has them as a table. A value is the raw one of its field.
#pragma once

#include "palpate/firmware/cycle_state.hpp"
#include "palpate/firmware/model_checks.hpp"
#include "palpate/firmware/safety_fields.hpp"

namespace palpate::firmware {

inline constexpr uint16_t kFrontThresholds = 4;
inline constexpr uint16_t kSettings = safety_fields::kThresholds + kFrontThresholds;

namespace settings_detail {

/// The thresholds of the two fronts.
template <class Fields, class Rules>
void front_thresholds(Fields& fields, Rules& rules) {
  constexpr auto kZero = Q<4, 27>::from_raw(0);
  fields.number("rotation split above", rules.rotation.split_above);
  fields.number("rotation join below", rules.rotation.join_below);
  fields.fixed("stretch split above", rules.stretch.split_above, kZero);
  fields.fixed("stretch merge below", rules.stretch.merge_below, kZero);
}

/// Among the fields that are given, gives the one with this number the value, and keeps what it was; takes
/// the calls of a FieldReader.
class OneField {
 public:
  explicit OneField(SettingChange change) : change_(change) {}

  template <class Integer>
  void number(const char* name, Integer& field,
              std::common_type_t<Integer> least = std::numeric_limits<Integer>::min(),
              std::common_type_t<Integer> most = std::numeric_limits<Integer>::max()) {
    if (++at_ != change_.setting) return;
    name_ = name;
    before_ = static_cast<int32_t>(field);
    // 32 bits without a sign travel in the same 32 bits.
    int64_t value = change_.value;
    if constexpr (std::is_same_v<Integer, uint32_t>) value = static_cast<uint32_t>(change_.value);
    is_set_ = value >= int64_t{least} && value <= int64_t{most};
    if (is_set_) field = static_cast<Integer>(value);
  }
  template <int I, int F>
  void fixed(const char* name, Q<I, F>& field, Q<I, F> least = Q<I, F>::min(),
             Q<I, F> most = Q<I, F>::max()) {
    int32_t raw = field.raw();
    number(name, raw, least.raw(), most.raw());
    field = Q<I, F>::from_raw(raw);
  }
  [[nodiscard]] bool is_set() const { return is_set_; }
  [[nodiscard]] SettingChange back() const { return {change_.setting, before_}; }
  /// nullptr when there is no such field.
  [[nodiscard]] const char* name() const { return name_; }

 private:
  SettingChange change_;
  uint16_t at_ = 0;
  int32_t before_ = 0;
  bool is_set_ = false;
  const char* name_ = nullptr;
};

}  // namespace settings_detail

/// Gives `fields` (container/field_reader.hpp) every setting in the order of its number.
template <class Fields, class AParameters, class Rules>
void all_settings(Fields& fields, AParameters& parameters, Rules& rules) {
  safety_fields::thresholds(fields, parameters);
  settings_detail::front_thresholds(fields, rules);
}

/// nullptr for a number that is none.
inline const char* setting_name(uint16_t setting) {
  settings_detail::OneField field({setting, 0});
  safety::Parameters parameters{};
  RemeshRules rules{};
  all_settings(field, parameters, rules);
  return field.name();
}

/// False, and nothing is changed, when there is no such setting, or with this value the parameters would not
/// be usable (safety::is_usable) or a front would never come to rest. In place, so that a tick can do it;
/// straight-line code.
[[nodiscard]] inline bool change_setting(safety::Parameters& parameters, RemeshRules& rules,
                                         SettingChange change) {
  settings_detail::OneField field(change);
  all_settings(field, parameters, rules);
  if (!field.is_set()) return false;
  if (safety::is_usable(parameters) && model_checks::check_hysteresis(rules).is_done()) return true;
  settings_detail::OneField as_before(field.back());
  all_settings(as_before, parameters, rules);
  return false;
}

/// Between two cycles, or first in one.
template <class Profile>
[[nodiscard]] bool change_setting(CycleState<Profile>& state, SettingChange change) {
  return change_setting(state.safety.parameters, state.core.model.remesh, change);
}

}  // namespace palpate::firmware
