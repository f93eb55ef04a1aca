#include "profile_timing.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "refusal.hpp"

namespace palpate::wcet::timing {
namespace {

// A port has one name in its contract and on the path.
Cycles device_cycles_of(const TimingImage& image, const Devices& devices) {
  double cycles = 0;
  for (const PortContract& port : devices.contracts)
    cycles += image.calls_of(port.function) * port.accesses * static_cast<double>(port.cycles);
  return std::llround(cycles);
}

std::vector<BoardTiming> time_boards(const TimingImage& image, const FigureFile& figures,
                                     const Builds& builds) {
  std::vector<BoardTiming> timings;
  for (const Board& board : figures.boards) {
    if (board.core != image.core()) continue;
    const Cycles more = device_cycles_of(image, read_devices(builds.devices + "/" + board.devices));
    timings.push_back({board, more, image.figures().cycles + more});
  }
  return timings;
}

// Fewer could not tell the quantities apart.
constexpr size_t kProfilesForAFormula = 4;

void add_formulas(const std::vector<std::unique_ptr<TimingImage>>& images,
                  std::vector<ProfileTiming>& timings) {
  std::vector<const TimingImage*> all;
  std::set<std::string> profiles;
  for (const auto& image : images) {
    all.push_back(image.get());
    profiles.insert(image->profile().key);
  }
  if (profiles.size() < kProfilesForAFormula) return;
  const QuantitiesOfLoops quantities(all);
  for (size_t i = 0; i < images.size(); ++i) {
    timings[i].formula = make_formula(*images[i], quantities);
    for (const double scale : {0.75, 1.25}) {
      timings[i].formula_error = std::max(timings[i].formula_error,
                                          relative_error(*images[i], quantities, *timings[i].formula, scale));
    }
  }
}

void require_image(const std::string& folder, const FigureRow& row) {
  const std::string target = "palpate_timing_" + row.profile;
  if (std::filesystem::exists(folder + target + ".elf")) return;
  throw BadInput(folder + target + ".elf is not there: cmake --build --preset " + row.core + " --target " +
                 target);
}

}  // namespace

std::vector<ProfileTiming> time_profiles(const FigureFile& figures, const Builds& builds) {
  std::vector<std::unique_ptr<TimingImage>> images;
  std::vector<ProfileTiming> timings;
  for (const FigureRow& row : figures.rows) {
    const auto of_core = builds.folders.find(row.core);
    if (of_core == builds.folders.end()) throw BadInput("nobody builds for core " + row.core + "; m4, m7");
    const std::string folder = of_core->second + "/";
    require_image(folder, row);
    images.push_back(std::make_unique<TimingImage>(folder + "palpate_timing_" + row.profile + ".elf",
                                                   row.profile, row.core));
    const TimingImage& image = *images.back();
    ProfileTiming timing;
    timing.row = row;
    timing.name = image.profile().name;
    timing.figures = image.figures();
    timing.measured = read_measurement(folder + "worst_case_" + row.profile + ".json");
    timing.boards = time_boards(image, figures, builds);
    timings.push_back(std::move(timing));
  }
  add_formulas(images, timings);
  return timings;
}

}  // namespace palpate::wcet::timing
