// A linked program, read once: its image, its instructions, its facts and its lines.
#pragma once

#include <map>
#include <string>

#include "decode.hpp"
#include "elf_image.hpp"
#include "flow_facts.hpp"
#include "source_lines.hpp"

namespace palpate::wcet {

class Program {
 public:
  explicit Program(const std::string& path)
      : image_(path), code_(decode(image_)), facts_(image_, code_), lines_(path) {}

  [[nodiscard]] const ElfImage& image() const { return image_; }
  [[nodiscard]] const FlowFacts& facts() const { return facts_; }
  [[nodiscard]] const std::map<uint32_t, Instruction>& code() const { return code_; }
  /// nullptr where no instruction begins.
  [[nodiscard]] const Instruction* at(uint32_t address) const {
    const auto found = code_.find(address);
    return found == code_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] std::string line_of(uint32_t address) const { return lines_.at(address); }
  [[nodiscard]] std::string function_name(uint32_t address) const {
    const FunctionSymbol* function = image_.function_around(address);
    return function == nullptr ? "no function" : function->name;
  }
  [[nodiscard]] Place place(uint32_t address) const {
    return {function_name(address), address, lines_.at(address)};
  }

 private:
  ElfImage image_;
  std::map<uint32_t, Instruction> code_;
  FlowFacts facts_;
  SourceLines lines_;
};

}  // namespace palpate::wcet
