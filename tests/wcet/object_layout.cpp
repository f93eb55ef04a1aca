#include "object_layout.hpp"

#include <dwarf.h>
#include <elfutils/libdw.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

namespace palpate::wcet {
namespace {

std::string name_of(Dwarf_Die* die) {
  const char* name = dwarf_diename(die);
  return name == nullptr ? "" : name;
}

std::optional<Dwarf_Die> type_of(Dwarf_Die* die) {
  Dwarf_Attribute attribute;
  Dwarf_Die type;
  if (dwarf_attr_integrate(die, DW_AT_type, &attribute) == nullptr) return std::nullopt;
  if (dwarf_formref_die(&attribute, &type) == nullptr) return std::nullopt;
  Dwarf_Die peeled;  // without const, volatile and the names of typedefs
  if (dwarf_peel_type(&type, &peeled) != 0) return std::nullopt;
  return peeled;
}

uint32_t bytes_of(Dwarf_Die* type) {
  Dwarf_Word bytes = 0;
  return dwarf_aggregate_size(type, &bytes) == 0 ? static_cast<uint32_t>(bytes) : 0;
}

// "Element[]" of an array; a class names itself.
std::string describe(Dwarf_Die* type) {
  if (dwarf_tag(type) != DW_TAG_array_type) return name_of(type);
  std::optional<Dwarf_Die> element = type_of(type);
  return element ? describe(&*element) + "[]" : "[]";
}

ObjectPart read_part(std::string name, Dwarf_Die type);

std::vector<ObjectPart> read_parts(Dwarf_Die* type) {
  std::vector<ObjectPart> parts;
  Dwarf_Die child;
  if (dwarf_child(type, &child) != 0) return parts;
  do {
    const int tag = dwarf_tag(&child);
    Dwarf_Attribute attribute;
    const bool is_static = dwarf_attr(&child, DW_AT_external, &attribute) != nullptr;
    if ((tag != DW_TAG_member && tag != DW_TAG_inheritance) || is_static) continue;
    if (const std::optional<Dwarf_Die> of = type_of(&child)) parts.push_back(read_part(name_of(&child), *of));
  } while (dwarf_siblingof(&child, &child) == 0);
  const auto is_smaller = [](const ObjectPart& a, const ObjectPart& b) { return a.bytes < b.bytes; };
  if (dwarf_tag(type) == DW_TAG_union_type && !parts.empty())
    parts = {*std::max_element(parts.begin(), parts.end(), is_smaller)};
  return parts;
}

ObjectPart read_part(std::string name, Dwarf_Die type) {
  ObjectPart part{std::move(name), describe(&type), bytes_of(&type), {}};
  const int tag = dwarf_tag(&type);
  if (tag == DW_TAG_structure_type || tag == DW_TAG_class_type || tag == DW_TAG_union_type)
    part.parts = read_parts(&type);
  return part;
}

std::optional<ObjectPart> find_variable(Dwarf_Die* scope, const std::string& variable) {
  Dwarf_Die child;
  if (dwarf_child(scope, &child) != 0) return std::nullopt;
  do {
    const int tag = dwarf_tag(&child);
    if (tag == DW_TAG_namespace) {
      if (auto found = find_variable(&child, variable)) return found;
    } else if (tag == DW_TAG_variable && name_of(&child) == variable) {
      std::optional<Dwarf_Die> type = type_of(&child);
      if (type && bytes_of(&*type) > 0) return read_part("", *type);
    }
  } while (dwarf_siblingof(&child, &child) == 0);
  return std::nullopt;
}

void add_pools(const ObjectPart& part, const std::string& path, uint32_t least_bytes,
               std::vector<PoolUse>& pools) {
  const bool is_split = part.parts.size() > 1 && part.bytes >= least_bytes;
  // A class around one thing, as std::array is around its elements, is that thing.
  if (part.parts.size() == 1) {
    const ObjectPart& only = part.parts.front();
    const bool is_array = only.parts.empty();
    return add_pools(only, is_array || path.empty() ? path : path + "." + only.name, least_bytes, pools);
  }
  if (!is_split) {
    if (part.bytes > 0) pools.push_back({path, part.type, part.bytes});
    return;
  }
  for (const ObjectPart& member : part.parts) {
    add_pools(member, path.empty() ? member.name : path + "." + member.name, least_bytes, pools);
  }
}

}  // namespace

std::optional<ObjectPart> read_object(const std::string& path, const std::string& variable) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return std::nullopt;
  std::optional<ObjectPart> found;
  if (Dwarf* dwarf = dwarf_begin(file, DWARF_C_READ)) {
    Dwarf_CU* unit = nullptr;
    Dwarf_Die die;
    while (!found && dwarf_get_units(dwarf, unit, &unit, nullptr, nullptr, &die, nullptr) == 0)
      found = find_variable(&die, variable);
    dwarf_end(dwarf);
  }
  close(file);
  return found;
}

std::vector<PoolUse> list_pools(const ObjectPart& object, uint32_t least_bytes) {
  std::vector<PoolUse> pools;
  add_pools(object, "", least_bytes, pools);
  std::stable_sort(pools.begin(), pools.end(),
                   [](const PoolUse& a, const PoolUse& b) { return a.bytes > b.bytes; });
  return pools;
}

}  // namespace palpate::wcet
