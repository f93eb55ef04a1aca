#include "elf_file.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace palpate::target {

template <class Type>
Type ElfFile::read(size_t offset) const {
  if (offset + sizeof(Type) > file_.size()) throw std::runtime_error("the ELF file is cut short");
  Type value;
  std::memcpy(&value, file_.data() + offset, sizeof(Type));
  return value;
}

ElfFile::ElfFile(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("can't open " + path);
  file_.assign(std::istreambuf_iterator<char>(stream), {});
  const auto header = read<Elf32_Ehdr>(0);
  const bool is_arm = std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 &&
                      header.e_ident[EI_CLASS] == ELFCLASS32 && header.e_machine == EM_ARM;
  if (!is_arm || header.e_type != ET_EXEC) throw std::runtime_error(path + " is no 32-bit Arm executable");
  read_sections();
  read_symbols();
}

void ElfFile::read_sections() {
  const auto header = read<Elf32_Ehdr>(0);
  for (size_t i = 0; i < header.e_shnum; ++i) {
    Section section;
    section.header = read<Elf32_Shdr>(header.e_shoff + i * sizeof(Elf32_Shdr));
    if (section.header.sh_type != SHT_NOBITS && section.header.sh_size > 0) {
      const size_t end = size_t{section.header.sh_offset} + section.header.sh_size;
      if (end > file_.size()) throw std::runtime_error("the ELF file is cut short");
      section.bytes.assign(file_.begin() + section.header.sh_offset, file_.begin() + static_cast<long>(end));
    }
    sections_.push_back(section);
  }
  const std::vector<uint8_t> names = sections_.at(header.e_shstrndx).bytes;
  for (Section& section : sections_) {
    section.name = reinterpret_cast<const char*>(&names.at(section.header.sh_name));
  }
}

void ElfFile::read_symbols() {
  const Section* table = find(".symtab");
  if (table == nullptr) throw std::runtime_error("the ELF file has no symbols");
  const std::vector<uint8_t>& names = sections_.at(table->header.sh_link).bytes;
  for (size_t at = 0; at + sizeof(Elf32_Sym) <= table->bytes.size(); at += sizeof(Elf32_Sym)) {
    Symbol symbol;
    std::memcpy(&symbol.entry, table->bytes.data() + at, sizeof(Elf32_Sym));
    symbol.name = reinterpret_cast<const char*>(&names.at(symbol.entry.st_name));
    symbols_.push_back(symbol);
  }
}

const Section* ElfFile::find(const std::string& name) const {
  for (const Section& section : sections_) {
    if (section.name == name) return &section;
  }
  return nullptr;
}

std::vector<FlowFactRecord> ElfFile::flow_facts() const {
  const Section* section = find(".wcet.flowfacts");
  if (section == nullptr) return {};
  std::vector<FlowFactRecord> records(section->bytes.size() / sizeof(FlowFactRecord));
  if (!records.empty()) {
    std::memcpy(records.data(), section->bytes.data(), records.size() * sizeof(FlowFactRecord));
  }
  return records;
}

}  // namespace palpate::target
