// What the data files of this folder share.
#pragma once

#include <toml++/toml.h>
#include <string>

namespace palpate::wcet {

/// Throws BadInput, with the path, `complaint` and why, when it is none.
toml::table read_toml(const std::string& path, const std::string& complaint);

}  // namespace palpate::wcet
