// The bound of a profile as a formula: cycles <= constant + a leaves + b pairs of node and group + c nodes +
// ...
#pragma once

#include <vector>

#include "timing_image.hpp"

namespace palpate::wcet::timing {

struct FormulaTerm {
  std::string quantity;
  uint32_t count = 0;
  double each = 0;  // cycles; all substeps of the profile included

  [[nodiscard]] double cycles() const { return each * count; }
};

struct Formula {
  double constant = 0;  // what of the worst path is in no loop that counts a quantity
  std::vector<FormulaTerm> terms;

  /// Each quantity times `scale`, to the nearest whole number.
  [[nodiscard]] double cycles(double scale = 1) const;
};

/// By place of a loop, which quantity its bound is a multiple of, and which multiple, as the images of all
/// profiles agree.
class QuantitiesOfLoops {
 public:
  explicit QuantitiesOfLoops(const std::vector<const TimingImage*>& images);

  struct Share {
    size_t quantity;
    double multiple;
  };
  /// Nothing where the bound is a constant of the program.
  [[nodiscard]] std::optional<Share> share_of(const std::string& place, const std::string& profile) const;

 private:
  std::map<std::string, Share> shares_;  // by place without the profile's name
};

/// Nothing is fitted: `each` is the sum of what the loops' rounds cost by the dual values, and the constant
/// is what is left of the bound. At the profile's own quantities that is the bound.
Formula make_formula(const TimingImage& image, const QuantitiesOfLoops& quantities);

/// By how much the formula misses the bound that the linear program gives when all quantities are scaled.
double relative_error(const TimingImage& image, const QuantitiesOfLoops& quantities, const Formula& formula,
                      double scale);

}  // namespace palpate::wcet::timing
