// What a static object is made of and how many bytes each part takes, from DWARF.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palpate::wcet {

struct ObjectPart {
  std::string name;  // "" for the object itself
  std::string type;
  uint32_t bytes = 0;
  std::vector<ObjectPart> parts;  // members and bases of a class; of a union only the largest
};

/// The variable of that name, without its namespaces. Nothing where the file has no such variable, or no
/// DWARF.
std::optional<ObjectPart> read_object(const std::string& path, const std::string& variable);

struct PoolUse {
  std::string name;  // "state.core.forest.leaf"
  std::string type;
  uint32_t bytes = 0;
};

/// Parts down to arrays and to what is smaller than `least_bytes`, the largest first. What the parts of a
/// class leave over, padding, is in none.
std::vector<PoolUse> list_pools(const ObjectPart& object, uint32_t least_bytes);

}  // namespace palpate::wcet
