#include "measurement.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "refusal.hpp"

namespace palpate::wcet::timing {

std::optional<Measurement> read_measurement(const std::string& path) {
  std::ifstream file(path);
  if (!file) return std::nullopt;
  const nlohmann::json document = nlohmann::json::parse(file, nullptr, false);
  const bool is_whole = document.is_object() && document.contains("max_observed_instructions") &&
                        document["max_observed_instructions"].is_number_integer();
  if (!is_whole) throw BadInput(path + " has no whole number max_observed_instructions");
  Measurement measured{document["max_observed_instructions"].get<Cycles>(), std::nullopt};
  if (document.contains("coverage_percent") && document["coverage_percent"].is_number())
    measured.coverage_percent = document["coverage_percent"].get<double>();
  return measured;
}

}  // namespace palpate::wcet::timing
