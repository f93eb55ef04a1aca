#include "plan.hpp"

#include <sstream>
#include <stdexcept>

namespace palpate::wcet {
namespace {

const char* name_of(Transfer transfer) {
  return transfer == Transfer::kCall ? "call" : transfer == Transfer::kJump ? "jump" : "return";
}

class LineReader {
 public:
  explicit LineReader(const std::string& line) : line_(line), words_(line) {}

  std::string word() {
    std::string found;
    if (!(words_ >> found)) refuse();
    return found;
  }
  uint32_t address() { return number(std::hex); }
  uint32_t decimal() { return number(std::dec); }
  /// True for the first of two words; nothing else may be there.
  bool choose(const char* first, const char* second) {
    const std::string found = word();
    if (found != first && found != second) refuse();
    return found == first;
  }
  [[noreturn]] void refuse() const { throw std::runtime_error("no line of a plan: " + line_); }

 private:
  uint32_t number(std::ios_base& (*base)(std::ios_base&)) {
    uint32_t found = 0;
    if (!(words_ >> base >> found)) refuse();
    return found;
  }

  const std::string& line_;
  std::istringstream words_;
};

void read_line(LineReader& line, Plan& plan) {
  const std::string kind = line.word();
  if (kind == "root") {
    plan.root = line.address();
  } else if (kind == "function") {
    const uint32_t entry = line.address();
    plan.functions[entry] = line.choose("open", "closed");
  } else if (kind == "transfer") {
    const uint32_t address = line.address();
    const std::string what = line.word();
    for (const Transfer transfer : {Transfer::kCall, Transfer::kJump, Transfer::kReturn}) {
      if (what == name_of(transfer)) plan.transfers[address] = transfer;
    }
    if (plan.transfers.count(address) == 0) line.refuse();
  } else if (kind == "fact") {
    if (line.decimal() != plan.bounds.size()) line.refuse();
    plan.bounds.push_back(line.decimal());
  } else if (kind == "mark") {
    PlannedMark mark;
    mark.address = line.address();
    mark.is_body = line.choose("body", "enter");
    mark.fact = line.decimal();
    if (mark.fact >= plan.bounds.size()) line.refuse();
    plan.marks.push_back(mark);
  } else {
    line.refuse();
  }
}

}  // namespace

void write_plan(const Plan& plan, std::ostream& to) {
  to << std::hex << "root " << plan.root << "\n";
  for (const auto& [entry, is_open] : plan.functions) {
    to << "function " << entry << (is_open ? " open" : " closed") << "\n";
  }
  for (const auto& [address, transfer] : plan.transfers) {
    to << "transfer " << address << " " << name_of(transfer) << "\n";
  }
  for (size_t i = 0; i < plan.bounds.size(); ++i) {
    to << std::dec << "fact " << i << " " << plan.bounds[i] << "\n";
  }
  for (const PlannedMark& mark : plan.marks) {
    to << std::hex << "mark " << mark.address << (mark.is_body ? " body " : " enter ") << std::dec
       << mark.fact << "\n";
  }
}

Plan read_plan(std::istream& from) {
  Plan plan;
  for (std::string text; std::getline(from, text);) {
    LineReader line(text);
    read_line(line, plan);
  }
  if (plan.functions.count(plan.root) == 0) throw std::runtime_error("a plan without its root");
  return plan;
}

}  // namespace palpate::wcet
