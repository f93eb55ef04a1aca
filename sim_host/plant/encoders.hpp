// What the decoders read: joint angles to quantized counts in 16-bit counters.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "palpate/phantom/joint_angles.hpp"

namespace palpate::plant {

/// counts_i = (q_i - q0_i) / (2 pi) x direction_i x (counts per joint turn)_i, not yet rounded. q and q0 in
/// rad; q0 is where the decoders were reset: links orthogonal, unless said otherwise.
Eigen::Vector3d encoder_counts(const phantom::EncoderRatings& ratings, const Eigen::Vector3d& q,
                               const Eigen::Vector3d& at_zero_counts = Eigen::Vector3d::Zero());

/// The counters' contents: rounded to the nearest count (so the reset pose lies in the middle of count 0) and
/// wrapped to 16 bits as the counters wrap. For counts below 2^62.
std::array<int16_t, 3> read_counters(const Eigen::Vector3d& counts);

}  // namespace palpate::plant
