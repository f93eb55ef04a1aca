// A number of a device with where it comes from. Parameters take their defaults from figures, so that a value
// and its mark can't part.
#pragma once

#include <vector>

namespace palpate::plant {

enum class Mark {
  kPublished,   ///< read in the named source
  kComputed,    ///< follows from published figures
  kUnverified,  ///< said to be so, without a source that was read
  kAssumed      ///< chosen here, because nothing is known
};

struct Figure {
  const char* name;
  double value;
  const char* unit;
  Mark mark;
  const char* source;
};

/// Whether a program that uses the figure must say so.
constexpr bool needs_warning(const Figure& figure) {
  return figure.mark == Mark::kUnverified || figure.mark == Mark::kAssumed;
}

/// A figure, and the value that a set of parameters has in its place.
struct FigureInUse {
  Figure figure;
  double value;
};

/// The doubtful ones among those that are used as they are: a value that the caller replaced is the caller's.
/// The plant prints nothing; whoever runs it prints these once.
inline std::vector<Figure> doubtful(const std::vector<FigureInUse>& used) {
  std::vector<Figure> result;
  result.reserve(used.size());
  for (const FigureInUse& one : used) {
    if (needs_warning(one.figure) && one.value == one.figure.value) result.push_back(one.figure);
  }
  return result;
}

}  // namespace palpate::plant
