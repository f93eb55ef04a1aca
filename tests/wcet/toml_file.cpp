#include "toml_file.hpp"

#include "refusal.hpp"

namespace palpate::wcet {

toml::table read_toml(const std::string& path, const std::string& complaint) {
  try {
    return toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    throw BadInput(path + " " + complaint + ": " + std::string(error.description()));
  }
}

}  // namespace palpate::wcet
