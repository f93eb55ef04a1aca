#include "cost_model.hpp"

#include <filesystem>
#include <map>

#include "refusal.hpp"
#include "toml_file.hpp"

namespace palpate::wcet {
namespace {

const std::map<std::string, CostClass>& class_names() {
  static const std::map<std::string, CostClass> names{
      {"alu", CostClass::kAlu},
      {"multiply", CostClass::kMultiply},
      {"divide", CostClass::kDivide},
      {"load", CostClass::kLoad},
      {"load_narrow", CostClass::kLoadNarrow},
      {"load_literal", CostClass::kLoadLiteral},
      {"load_multiple", CostClass::kLoadMultiple},
      {"store", CostClass::kStore},
      {"store_narrow", CostClass::kStoreNarrow},
      {"store_multiple", CostClass::kStoreMultiple},
      {"conditional_branch", CostClass::kConditionalBranch},
      {"branch", CostClass::kBranch},
      {"call", CostClass::kCall},
      {"branch_register", CostClass::kBranchRegister},
      {"load_pc", CostClass::kLoadPc},
      {"table_branch", CostClass::kTableBranch},
      {"barrier", CostClass::kBarrier},
      {"system", CostClass::kSystem},
  };
  return names;
}

class ModelReader {
 public:
  explicit ModelReader(std::string path) : path_(std::move(path)) {}

  CostModel read() {
    const toml::table file = read_toml(path_, "is no cost model");
    CostModel model;
    model.name = file["name"].value_or(std::string());
    model.unit = file["unit"].value_or(std::string());
    model.description = file["description"].value_or(std::string());
    model.store_to_load = number(file["memory"].as_table(), "store_to_load");
    model.mispredicted = number(file["branch"].as_table(), "mispredicted");
    model.interrupt_entry = number(file["interrupt"].as_table(), "entry");
    model.interrupt_exit = number(file["interrupt"].as_table(), "exit");
    if (const toml::array* costs = file["cost"].as_array()) {
      for (const toml::node& cost : *costs) read_row(cost.as_table(), model);
    }
    for (const auto& [name, cost_class] : class_names()) {
      if (seen_.count(cost_class) == 0) refuse("has no cost of " + name);
    }
    return model;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { throw BadInput(path_ + " " + why); }

  Cycles number(const toml::table* table, const std::string& key) const {
    const toml::node* node = table == nullptr ? nullptr : table->get(key);
    if (node == nullptr) return 0;
    const std::optional<int64_t> value = node->value<int64_t>();
    if (!value || *value < 0) refuse("has no whole number of cycles in " + key);
    return *value;
  }

  void read_row(const toml::table* table, CostModel& model) {
    const std::string name = table == nullptr ? "" : (*table)["of"].value_or(std::string());
    const auto found = class_names().find(name);
    if (found == class_names().end()) refuse("has a cost of an unknown class '" + name + "'");
    if ((*table)["source"].value_or(std::string()).empty())
      refuse("does not say where the cost of " + name + " is from");
    if (!seen_.emplace(found->second, true).second) refuse("has two costs of " + name);
    CostRow& row = model.rows[static_cast<size_t>(found->second)];
    const std::map<std::string, Cycles*> fields{
        {"cycles", &row.cycles}, {"each", &row.each},       {"each_pair", &row.each_pair},
        {"taken", &row.taken},   {"result", &row.result},   {"address", &row.address},
        {"shift", &row.shift},   {"indexed", &row.indexed}, {"behind_load", &row.behind_load}};
    for (const auto& [key, value] : *table) {
      const std::string text(key.str());
      if (text == "of" || text == "source") continue;
      const auto field = fields.find(text);
      if (field == fields.end()) refuse("has an unknown key " + text);
      *field->second = number(table, text);
    }
  }

  std::string path_;
  std::map<CostClass, bool> seen_;
};

}  // namespace

CostModel read_cost_model(const std::string& name) {
  const bool is_file = std::filesystem::path(name).extension() == ".toml";
  const std::string path = is_file ? name : std::string(PALPATE_WCET_MODELS) + "/" + name + ".toml";
  if (!std::filesystem::exists(path)) throw BadInput("there is no cost model " + name);
  return ModelReader(path).read();
}

namespace {

/// One word or less, and the base stays as it is.
bool is_single_access(const Instruction& of) {
  return of.memory && of.transfers == 1 && !of.writeback && of.flow == Flow::kNext;
}

bool is_behind_load(const Instruction* before, const Instruction& of) {
  return before != nullptr && is_single_access(*before) && !before->memory->is_store &&
         is_single_access(of) && (before->writes & of.address_reads) == 0;
}

}  // namespace

Cycles issue_cycles(const CostModel& model, const Instruction* before, const Instruction& of) {
  const CostRow& row = model.row(of);
  const Cycles registers = of.transfers;
  const Cycles words = (of.address % 4 + of.size + 3) / 4 + (of.cost == CostClass::kLoadLiteral ? 1 : 0);
  const Cycles fetch = model.wait_states * words;
  if (row.behind_load > 0 && is_behind_load(before, of)) return row.behind_load + fetch;
  const Cycles indexed = of.memory && of.memory->has_index ? row.indexed : 0;
  return row.cycles + indexed + row.each * registers + row.each_pair * ((registers + 1) / 2) + fetch;
}

Cycles exit_cycles(const CostModel& model, const Instruction& last, bool taken) {
  Cycles cycles = taken ? model.row(last).taken : 0;
  if (last.cost != CostClass::kConditionalBranch) return cycles;
  const bool expects_taken = last.target <= last.address;
  const bool is_foreseen = model.predictor == Predictor::kStatic && taken == expects_taken;
  return is_foreseen ? cycles : cycles + model.mispredicted;
}

}  // namespace palpate::wcet
