#include "elf_reader.hpp"

#include <cxxabi.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <iterator>
#include <memory>

#include "refusal.hpp"

namespace palpate::wcet {
namespace {

std::string demangle(const std::string& name) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(
      abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status), std::free);
  return status == 0 ? text.get() : name;
}

}  // namespace

ElfReader::ElfReader(const std::string& path, ElfImage& image)
    : path_(path), image_(image), file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)), elf_(nullptr) {
  if (file_ < 0) throw BadInput("can't open " + path);
  elf_version(EV_CURRENT);
  elf_ = elf_begin(file_, ELF_C_READ, nullptr);
}

ElfReader::~ElfReader() {
  elf_end(elf_);
  close(file_);
}

void ElfReader::read() {
  GElf_Ehdr header;
  const bool is_arm = elf_kind(elf_) == ELF_K_ELF && gelf_getehdr(elf_, &header) != nullptr &&
                      gelf_getclass(elf_) == ELFCLASS32 && header.e_machine == EM_ARM &&
                      header.e_type == ET_EXEC;
  size_t names = 0;
  if (!is_arm || elf_getshdrstrndx(elf_, &names) != 0) throw BadInput(path_ + " is no 32-bit Arm executable");
  Elf_Scn* section = nullptr;
  while ((section = elf_nextscn(elf_, section)) != nullptr) read_section(section, names);
  give_sizes();
  if (image_.functions_.empty()) throw BadInput(path_ + " has no symbols of functions");
}

void ElfReader::read_section(Elf_Scn* section, size_t names) {
  GElf_Shdr header;
  if (gelf_getshdr(section, &header) == nullptr) throw BadInput(path_ + " has a broken section");
  const char* name = elf_strptr(elf_, names, header.sh_name);
  Section read;
  read.name = name == nullptr ? "" : name;
  read.address = static_cast<uint32_t>(header.sh_addr);
  read.size = static_cast<uint32_t>(header.sh_size);
  read.loaded = (header.sh_flags & SHF_ALLOC) != 0;
  read.writable = (header.sh_flags & SHF_WRITE) != 0;
  read.executable = (header.sh_flags & SHF_EXECINSTR) != 0;
  if (header.sh_type != SHT_NOBITS && header.sh_size > 0) {
    const Elf_Data* data = elf_rawdata(section, nullptr);
    if (data == nullptr || data->d_buf == nullptr) throw BadInput(path_ + " is cut short");
    const auto* bytes = static_cast<const uint8_t*>(data->d_buf);
    read.bytes.assign(bytes, bytes + data->d_size);
  }
  image_.sections_.push_back(std::move(read));
  if (header.sh_type == SHT_SYMTAB) read_symbols(section, header);
}

void ElfReader::read_symbols(Elf_Scn* section, const GElf_Shdr& header) {
  Elf_Data* data = elf_getdata(section, nullptr);
  GElf_Sym symbol;
  for (int i = 0; data != nullptr && gelf_getsym(data, i, &symbol) != nullptr; ++i) {
    const char* text = elf_strptr(elf_, header.sh_link, symbol.st_name);
    if (text == nullptr) continue;
    const std::string name = text;
    const auto address = static_cast<uint32_t>(symbol.st_value);
    image_.symbols_.push_back({name, address, symbol.st_shndx == SHN_UNDEF});
    if (symbol.st_shndx == SHN_UNDEF) continue;
    if (name.rfind("$t", 0) == 0) image_.stretches_[address] = true;
    if (name.rfind("$d", 0) == 0 || name.rfind("$a", 0) == 0) image_.stretches_.emplace(address, false);
    if (GELF_ST_TYPE(symbol.st_info) == STT_FUNC) add_function(symbol, name);
  }
}

void ElfReader::add_function(const GElf_Sym& symbol, const std::string& name) {
  const uint32_t start = static_cast<uint32_t>(symbol.st_value) & ~1u;  // bit 0 only says Thumb
  image_.functions_.emplace(
      start, FunctionSymbol{start, start + static_cast<uint32_t>(symbol.st_size), name, demangle(name)});
}

// What is written in assembler may have no size: then it reaches to the next function, or to its section's
// end.
void ElfReader::give_sizes() {
  auto& functions = image_.functions_;
  for (auto at = functions.begin(); at != functions.end(); ++at) {
    FunctionSymbol& function = at->second;
    if (function.end != function.start) continue;
    for (const Section& section : image_.sections_) {
      if (section.loaded && section.holds(function.start)) function.end = section.address + section.size;
    }
    const auto next = std::next(at);
    if (next != functions.end() && next->first < function.end) function.end = next->first;
  }
}

}  // namespace palpate::wcet
