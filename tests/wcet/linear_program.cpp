#include "linear_program.hpp"

#include <glpk.h>

#include <stdexcept>

namespace palpate::wcet {
namespace {

class LinearProgram {
 public:
  LinearProgram(const Network& network, const std::vector<LoopFact>& facts)
      : network_(network), facts_(facts), problem_(glp_create_prob()) {
    glp_term_out(GLP_OFF);
    glp_set_obj_dir(problem_, GLP_MAX);
    add_rows();
    add_columns();
  }
  ~LinearProgram() { glp_delete_prob(problem_); }
  LinearProgram(const LinearProgram&) = delete;
  LinearProgram(LinearProgram&&) = delete;
  LinearProgram& operator=(const LinearProgram&) = delete;
  LinearProgram& operator=(LinearProgram&&) = delete;

  /// No unit enters, and no arc carries more than one: what is left goes round.
  void close() {
    glp_set_row_bnds(problem_, 1, GLP_FX, 0, 0);
    for (int arc = 1; arc <= glp_get_num_cols(problem_); ++arc) {
      glp_set_col_bnds(problem_, arc, GLP_DB, 0, 1);
      glp_set_obj_coef(problem_, arc, 1);
    }
  }

  // In floating point first: it leaves a basis from which few exact steps remain.
  Solution solve() {
    glp_smcp options;
    glp_init_smcp(&options);
    options.msg_lev = GLP_MSG_OFF;
    glp_simplex(problem_, &options);
    if (glp_exact(problem_, &options) != 0) throw std::runtime_error("GLPK found no exact solution");
    const int status = glp_get_status(problem_);
    Solution solution;
    solution.is_bounded = status == GLP_OPT;
    for (int arc = 1; arc <= columns(); ++arc) solution.counts.push_back(glp_get_col_prim(problem_, arc));
    for (int row = 1; row <= nodes(); ++row) solution.potentials.push_back(glp_get_row_dual(problem_, row));
    for (int row = nodes() + 1; row <= glp_get_num_rows(problem_); ++row) {
      solution.multipliers.push_back(glp_get_row_dual(problem_, row));
    }
    return solution;
  }

 private:
  [[nodiscard]] int nodes() const { return static_cast<int>(network_.nodes.size()); }
  [[nodiscard]] int columns() const { return static_cast<int>(network_.arcs.size()); }

  // A node's row: what leaves it minus what enters it. A fact's row: bodies minus bound x entries.
  void add_rows() {
    glp_add_rows(problem_, nodes());
    for (int row = 1; row <= nodes(); ++row) {
      const double enters = row == 1 ? 1 : 0;
      glp_set_row_bnds(problem_, row, GLP_FX, enters, enters);
    }
    if (facts_.empty()) return;
    glp_add_rows(problem_, static_cast<int>(facts_.size()));
    for (int row = nodes() + 1; row <= glp_get_num_rows(problem_); ++row) {
      glp_set_row_bnds(problem_, row, GLP_UP, 0, 0);
    }
  }

  void add_columns() {
    glp_add_cols(problem_, columns());
    for (int column = 1; column <= columns(); ++column) add_column(column, network_.arcs[size_t(column) - 1]);
  }

  void add_column(int column, const Arc& arc) {
    std::vector<int> rows{0};  // GLPK counts from 1
    std::vector<double> values{0};
    const auto add = [&](size_t row, double value) {
      if (value == 0) return;
      rows.push_back(static_cast<int>(row) + 1);
      values.push_back(value);
    };
    if (arc.to != arc.from) {
      add(arc.from, 1);
      if (arc.to != kExit) add(arc.to, -1);
    }
    for (size_t i = 0; i < facts_.size(); ++i) {
      add(network_.nodes.size() + i, static_cast<double>(fact_weight(network_.nodes[arc.from], facts_[i])));
    }
    glp_set_mat_col(problem_, column, static_cast<int>(rows.size()) - 1, rows.data(), values.data());
    glp_set_col_bnds(problem_, column, GLP_LO, 0, 0);
    glp_set_obj_coef(problem_, column, static_cast<double>(arc.cost()));
  }

  const Network& network_;
  const std::vector<LoopFact>& facts_;
  glp_prob* problem_;
};

}  // namespace

Solution find_longest_path(const Network& network, const std::vector<LoopFact>& facts) {
  return LinearProgram(network, facts).solve();
}

std::vector<bool> find_unbounded_arcs(const Network& network, const std::vector<LoopFact>& facts) {
  LinearProgram program(network, facts);
  program.close();
  std::vector<bool> goes_round;
  for (const double count : program.solve().counts) goes_round.push_back(count > 0);
  return goes_round;
}

}  // namespace palpate::wcet
