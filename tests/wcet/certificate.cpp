#include "certificate.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>

namespace palpate::wcet {
namespace {

// GLPK computes in rational numbers but hands out the nearest double: back to the simplest fraction that is
// as near, by continued fractions. A wrong guess can't prove a wrong bound, only fail.
mpq_class nearest_fraction(double value) {
  constexpr double kTolerance = 1e-15;
  constexpr int kMostTerms = 30;
  mpz_class p = 1, q = 0, p_before = 0, q_before = 1;
  double rest = value;
  for (int term = 0; term < kMostTerms; ++term) {
    const mpz_class whole(std::floor(rest));
    const mpz_class p_next = whole * p + p_before;
    const mpz_class q_next = whole * q + q_before;
    p_before = p, q_before = q;
    p = p_next, q = q_next;
    const mpq_class fraction(p, q);
    if (std::abs(fraction.get_d() - value) <= kTolerance * std::max(1.0, std::abs(value))) break;
    rest = 1 / (rest - std::floor(rest));
  }
  mpq_class fraction(p, q);
  fraction.canonicalize();
  return fraction;
}

std::vector<mpq_class> nearest_fractions(const std::vector<double>& values) {
  std::vector<mpq_class> fractions;
  fractions.reserve(values.size());
  for (const double value : values) fractions.push_back(nearest_fraction(value));
  return fractions;
}

mpz_class to_integer(Cycles value) { return mpz_class(std::to_string(value)); }

}  // namespace

std::optional<Cycles> prove_bound(const Network& network, const std::vector<LoopFact>& facts,
                                  const Solution& solution) {
  const std::vector<mpq_class> potentials = nearest_fractions(solution.potentials);
  const std::vector<mpq_class> multipliers = nearest_fractions(solution.multipliers);
  for (const mpq_class& multiplier : multipliers) {
    if (multiplier < 0) return std::nullopt;
  }
  for (const Arc& arc : network.arcs) {
    mpq_class paid = potentials[arc.from];
    if (arc.to != kExit) paid -= potentials[arc.to];
    for (size_t i = 0; i < facts.size(); ++i) {
      paid += multipliers[i] * to_integer(fact_weight(network.nodes[arc.from], facts[i]));
    }
    if (paid < to_integer(arc.cost())) return std::nullopt;
  }
  mpz_class bound;
  mpz_fdiv_q(bound.get_mpz_t(), potentials.front().get_num_mpz_t(), potentials.front().get_den_mpz_t());
  if (!bound.fits_slong_p()) return std::nullopt;
  return bound.get_si();
}

}  // namespace palpate::wcet
