#include "recording/mapped_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "model_parameters.hpp"

namespace palpate::recording {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw sim::BadInput(fmt::format("cannot read '{}': {}", path, why));
}

}  // namespace

MappedFile::MappedFile(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) refuse(path, std::strerror(errno));
  struct stat status {};
  const bool is_file = fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  const bool fits = is_file && static_cast<uint64_t>(status.st_size) < (uint64_t{1} << 32);
  const auto size = fits ? static_cast<std::size_t>(status.st_size) : 0;
  // An empty file has no pages.
  void* pages = size == 0 ? nullptr : mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  const std::string why = std::strerror(errno);
  close(file);
  if (!is_file) refuse(path, "it is not a file");
  if (!fits) refuse(path, "it has 4 GiB or more");
  if (pages == MAP_FAILED) refuse(path, why);
  bytes_ = {static_cast<const uint8_t*>(pages), static_cast<uint32_t>(size)};
}

MappedFile::~MappedFile() {
  if (bytes_.size != 0) munmap(const_cast<uint8_t*>(bytes_.data), bytes_.size);
}

}  // namespace palpate::recording
