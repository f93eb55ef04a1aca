// libelf, and what it has to be asked for.
#pragma once

#include <gelf.h>

#include <string>

#include "elf_image.hpp"

namespace palpate::wcet {

class ElfReader {
 public:
  ElfReader(const std::string& path, ElfImage& image);
  ~ElfReader();
  ElfReader(const ElfReader&) = delete;
  ElfReader(ElfReader&&) = delete;
  ElfReader& operator=(const ElfReader&) = delete;
  ElfReader& operator=(ElfReader&&) = delete;

  void read();

 private:
  void read_section(Elf_Scn* section, size_t names);
  void read_symbols(Elf_Scn* section, const GElf_Shdr& header);
  void add_function(const GElf_Sym& symbol, const std::string& name);
  void give_sizes();

  std::string path_;
  ElfImage& image_;
  int file_;
  Elf* elf_;
};

}  // namespace palpate::wcet
