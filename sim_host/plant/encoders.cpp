#include "plant/encoders.hpp"

#include <cmath>

#include "plant/units.hpp"

namespace palpate::plant {

Eigen::Vector3d encoder_counts(const phantom::EncoderRatings& ratings, const Eigen::Vector3d& q,
                               const Eigen::Vector3d& at_zero_counts) {
  Eigen::Vector3d counts;
  for (Eigen::Index joint = 0; joint < 3; ++joint) {
    const auto i = static_cast<std::size_t>(joint);
    const double per_turn = ratings.direction[i] * ratings.counts_per_joint_turn_milli[i] / 1000.0;
    counts[joint] = (q[joint] - at_zero_counts[joint]) / (2.0 * kPi) * per_turn;
  }
  return counts;
}

std::array<int16_t, 3> read_counters(const Eigen::Vector3d& counts) {
  const auto wrapped = [](double count) {
    // The low 16 bits, as two's complement.
    const auto low = static_cast<int32_t>(static_cast<uint64_t>(std::llround(count)) & 0xffffu);
    return static_cast<int16_t>(low < 0x8000 ? low : low - 0x10000);
  };
  return {wrapped(counts[0]), wrapped(counts[1]), wrapped(counts[2])};
}

}  // namespace palpate::plant
