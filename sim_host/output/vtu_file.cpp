#include "output/vtu_file.hpp"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>

#include "output/output_file.hpp"
#include "text/base64.hpp"

namespace palpate::sim {
namespace {

using pugi::xml_node;

constexpr const char* kByteOrder = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? "LittleEndian" : "BigEndian";
constexpr uint8_t kVtkTetra = 10;

constexpr const char* type_name(double /*value*/) { return "Float64"; }
constexpr const char* type_name(int32_t /*value*/) { return "Int32"; }
constexpr const char* type_name(int64_t /*value*/) { return "Int64"; }
constexpr const char* type_name(uint8_t /*value*/) { return "UInt8"; }

xml_node child(xml_node parent, const char* name) { return parent.append_child(name); }

template <class Value>
void set(xml_node node, const char* name, const Value& value) {
  node.append_attribute(name).set_value(value);
}

xml_node start_file(pugi::xml_document& document, const char* type) {
  xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  xml_node file = document.append_child("VTKFile");
  set(file, "type", type);
  set(file, "version", "1.0");
  set(file, "byte_order", kByteOrder);
  set(file, "header_type", "UInt64");
  return child(file, type);
}

void write_document(const std::filesystem::path& path, const pugi::xml_document& document) {
  std::ostringstream text;
  document.save(text, "  ");
  write_whole_file(path.string(), text.str());
}

/// The bytes of the numbers behind their count.
template <class Number>
std::string encoded(const Number* first, std::size_t count) {
  const uint64_t size = count * sizeof(Number);
  std::string bytes(reinterpret_cast<const char*>(&size), sizeof size);
  bytes.append(reinterpret_cast<const char*>(first), size);
  return base64(bytes);
}

template <class Number>
void add_array(xml_node parent, const std::string& name, const std::vector<Number>& values,
               int components = 1) {
  xml_node array = child(parent, "DataArray");
  set(array, "type", type_name(Number{}));
  set(array, "Name", name.c_str());
  set(array, "NumberOfComponents", components);
  set(array, "format", "binary");
  array.text().set(encoded(values.data(), values.size()).c_str());
}

void add_array(xml_node parent, const std::string& name, const std::vector<std::array<double, 3>>& values) {
  std::vector<double> flat;
  flat.reserve(values.size() * 3);
  for (const auto& value : values) flat.insert(flat.end(), value.begin(), value.end());
  add_array(parent, name, flat, 3);
}

void add_data(xml_node parent, const std::vector<DataArray>& arrays, std::size_t count, const char* what) {
  for (const DataArray& array : arrays) {
    std::visit(
        [&](const auto& values) {
          if (values.size() != count) {
            throw std::invalid_argument(fmt::format("the array '{}' has {} values, but there are {} {}",
                                                    array.name, values.size(), count, what));
          }
          add_array(parent, array.name, values);
        },
        array.values);
  }
}

void add_tets(xml_node cells, const std::vector<std::array<uint32_t, 4>>& tets) {
  std::vector<int64_t> connectivity;
  std::vector<int64_t> offsets;
  for (const auto& tet : tets) {
    connectivity.insert(connectivity.end(), tet.begin(), tet.end());
    offsets.push_back(static_cast<int64_t>(connectivity.size()));
  }
  add_array(cells, "connectivity", connectivity);
  add_array(cells, "offsets", offsets);
  add_array(cells, "types", std::vector<uint8_t>(tets.size(), kVtkTetra));
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const UnstructuredGrid& grid) {
  pugi::xml_document document;
  xml_node piece = child(start_file(document, "UnstructuredGrid"), "Piece");
  set(piece, "NumberOfPoints", grid.points.size());
  set(piece, "NumberOfCells", grid.tets.size());
  add_data(child(piece, "PointData"), grid.point_data, grid.points.size(), "points");
  add_data(child(piece, "CellData"), grid.cell_data, grid.tets.size(), "cells");
  add_array(child(piece, "Points"), "Points", grid.points);
  add_tets(child(piece, "Cells"), grid.tets);
  write_document(path, document);
}

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries) {
  pugi::xml_document document;
  xml_node collection = start_file(document, "Collection");
  for (const PvdEntry& entry : entries) {
    xml_node data_set = child(collection, "DataSet");
    set(data_set, "timestep", fmt::format("{}", entry.time_s).c_str());
    set(data_set, "part", 0);
    set(data_set, "file", entry.file.c_str());
  }
  write_document(path, document);
}

}  // namespace palpate::sim
