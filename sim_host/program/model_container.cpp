#include "program/model_container.hpp"

#include <fmt/format.h>

#include <cctype>

#include "palpate/firmware/model_container.hpp"
#include "simulation/with_profile.hpp"
#include "text/bytes_of.hpp"

namespace palpate::sim {
namespace {

std::string written(const firmware::CycleModel& model, const std::string& name) {
  std::string file;
  auto sink = [&file](const uint8_t* bytes, uint32_t size) {
    file.append(reinterpret_cast<const char*>(bytes), size);
    return true;
  };
  const container::WriteStatus status = firmware::write_model(sink, model, bytes_of(name));
  if (status == container::WriteStatus::kDone) return file;
  throw std::logic_error(
      fmt::format("a model container ends with write status {}", static_cast<int>(status)));
}

/// Characters that are not printed are shown in hex.
std::string spell(container::Tag tag) {
  std::string text;
  for (uint32_t i = 0; i < 4; ++i) {
    const auto character = static_cast<unsigned char>(tag.at(i));
    text += std::isprint(character) != 0 ? std::string(1, tag.at(i)) : fmt::format("\\x{:02x}", character);
  }
  return text;
}

bool is_check(container::ReadStatus status) {
  using container::ReadStatus;
  return status == ReadStatus::kHeaderDamaged || status == ReadStatus::kChunkHeaderDamaged ||
         status == ReadStatus::kChunkDamaged || status == ReadStatus::kChunksReplaced;
}

}  // namespace

std::string model_container(const Scenario& scenario) {
  std::string file = written(cycle_model(scenario), scenario.name);
  const uint8_t deepest =
      with_profile(scenario.profile, [](auto profile) { return decltype(profile)::kMaxLevel; });
  firmware::CycleModel read{};
  const container::Finding finding = firmware::read_model(bytes_of(file), deepest, read);
  if (!finding.is_done()) {
    throw BadInput(fmt::format("profile {} would refuse the model: {}", scenario.profile, describe(finding)));
  }
  if (written(read, scenario.name) != file)
    throw std::logic_error("a model container reads as another model");
  return file;
}

std::string describe(const container::Finding& finding) {
  const std::string place = finding.tag == container::kNoTag
                                ? fmt::format("at byte {}", finding.offset)
                                : fmt::format("at byte {} in chunk {}", finding.offset, spell(finding.tag));
  const std::string field = finding.field == nullptr ? "" : fmt::format("{}: ", finding.field);
  const auto number = [&finding](int64_t value) {
    return is_check(finding.status) ? fmt::format("{:08x}", value) : fmt::format("{}", value);
  };
  const std::string expected = finding.least == finding.most
                                   ? number(finding.most)
                                   : fmt::format("{} to {}", number(finding.least), number(finding.most));
  return fmt::format("{}: {}: {}expected {}, found {}", place, read_status_text(finding.status), field,
                     expected, number(finding.found));
}

}  // namespace palpate::sim
