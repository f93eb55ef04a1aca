// The figures for people and for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gates.hpp"
#include "profile_timing.hpp"

namespace palpate::wcet::timing {

/// What must always be said beside cycles.
extern const char* const kCaveat;

/// "1 234 567"
std::string grouped(Cycles number);

/// For a terminal: profiles, profiles on boards, formulas.
std::string make_tables(const std::vector<ProfileTiming>& timings);
/// The same figures as tables of Markdown.
std::string make_markdown(const std::vector<ProfileTiming>& timings);
/// A list, an object a profile and core. What was not measured is null.
nlohmann::json make_json(const std::vector<ProfileTiming>& timings);
/// One page that needs nothing else.
std::string make_page(const std::vector<ProfileTiming>& timings, const std::vector<Finding>& findings);

}  // namespace palpate::wcet::timing
