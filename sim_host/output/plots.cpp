#include "output/plots.hpp"
namespace palpate::sim {
void require_gnuplot() {}
void draw_plots(const Recording&, bool, const RunFolder&) {}
}  // namespace palpate::sim
