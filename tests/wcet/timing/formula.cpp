#include "formula.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>

namespace palpate::wcet::timing {
namespace {

// Template arguments that differ between profiles: the profile itself and its capacities.
std::string without_profile(const std::string& place, const std::string& profile) {
  static const std::regex number("\\b[0-9]+ul?\\b");
  std::string text = std::regex_replace(place, number, "#");
  const std::string name = "palpate::" + profile;
  for (size_t at = 0; (at = text.find(name, at)) != std::string::npos;)
    text.replace(at, name.size(), "Profile");
  return text;
}

using BoundsByProfile = std::map<const ProfileShape*, uint32_t>;

// The multiple that all profiles agree on, one of few that sources write. Of a loop that one profile alone
// has, a small bound, as that of its substeps, is a multiple of every small quantity.
std::optional<double> common_multiple(const BoundsByProfile& bounds, size_t quantity) {
  constexpr uint32_t kLeastTelling = 8;
  if (bounds.size() == 1 && bounds.begin()->second < kLeastTelling) return std::nullopt;
  std::optional<double> common;
  for (const auto& [shape, bound] : bounds) {
    const double multiple = static_cast<double>(bound) / shape->quantities[quantity].count;
    if (common && *common != multiple) return std::nullopt;
    common = multiple;
  }
  constexpr std::array<double, 8> kLikely{1, 2, 3, 4, 1.5, 0.5, 0.25, 0.125};
  const bool is_likely = common && std::find(kLikely.begin(), kLikely.end(), *common) != kLikely.end();
  return is_likely ? common : std::nullopt;
}

}  // namespace

double Formula::cycles(double scale) const {
  double sum = constant;
  for (const FormulaTerm& term : terms) sum += term.each * std::round(scale * term.count);
  return sum;
}

QuantitiesOfLoops::QuantitiesOfLoops(const std::vector<const TimingImage*>& images) {
  std::map<std::string, BoundsByProfile> places;
  for (const TimingImage* image : images) {
    for (const LoopFigures& loop : image->loops()) {
      if (loop.place.empty()) continue;
      const std::string place = without_profile(loop.place, image->profile().key);
      // Of instances that share a place with different bounds nobody knows which is whose: a bound that fits
      // nothing.
      const auto [known, is_new] = places[place].emplace(&image->profile(), loop.fact.bound);
      if (!is_new && known->second != loop.fact.bound) known->second = 0;
    }
  }
  for (const auto& [place, bounds] : places) {
    const size_t count = bounds.begin()->first->quantities.size();
    for (size_t quantity = 0; quantity < count; ++quantity) {
      const std::optional<double> multiple = common_multiple(bounds, quantity);
      if (!multiple) continue;
      shares_[place] = {quantity, *multiple};
      break;
    }
  }
}

std::optional<QuantitiesOfLoops::Share> QuantitiesOfLoops::share_of(const std::string& place,
                                                                    const std::string& profile) const {
  const auto found = shares_.find(without_profile(place, profile));
  return found == shares_.end() ? std::nullopt : std::optional<Share>(found->second);
}

Formula make_formula(const TimingImage& image, const QuantitiesOfLoops& quantities) {
  Formula formula;
  for (const Quantity& quantity : image.profile().quantities)
    formula.terms.push_back({quantity.name, quantity.count, 0});
  for (const LoopFigures& loop : image.loops()) {
    const auto share = quantities.share_of(loop.place, image.profile().key);
    if (share) formula.terms[share->quantity].each += loop.per_round * share->multiple;
  }
  const auto is_absent = [](const FormulaTerm& term) { return term.each == 0; };
  formula.terms.erase(std::remove_if(formula.terms.begin(), formula.terms.end(), is_absent),
                      formula.terms.end());
  formula.constant = static_cast<double>(image.figures().cycles) - formula.cycles();
  return formula;
}

double relative_error(const TimingImage& image, const QuantitiesOfLoops& quantities, const Formula& formula,
                      double scale) {
  std::map<uint32_t, uint32_t> limits;
  for (const LoopFigures& loop : image.loops()) {
    const auto share = quantities.share_of(loop.place, image.profile().key);
    if (!share) continue;
    const double count = std::round(scale * image.profile().quantities[share->quantity].count);
    limits[loop.fact.body] = static_cast<uint32_t>(std::lround(count * share->multiple));
  }
  const auto bound = static_cast<double>(image.cycles_with(limits));
  return std::abs(formula.cycles(scale) - bound) / bound;
}

}  // namespace palpate::wcet::timing
