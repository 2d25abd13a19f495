// Every array of a .vtp file stands in its tag, in base64. Bytes behind the XML part (AppendedData) would be a quarter
// smaller, but ParaView 5.11 cannot read them with an expat library that puts off the parsing of unfinished parts (seen
// with expat 2.5.0-1+deb12u2 of Debian 12: "junk after document element").
#include "gem/export/poly_data.h"

#include <array>
#include <bit>

#include "gem/base/base64.h"

namespace gem {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say that they are little-endian");

using Values = decltype(PolyArray::values);

const char* type_of(const Values& values) {
  static constexpr std::array<const char*, 4> types = {"UInt8", "Int32", "Float32", "Float64"};
  return types[values.index()];
}

std::uint64_t bytes_of(const Values& values) {
  return std::visit([](const auto& v) { return std::uint64_t{v.size()} * sizeof(v[0]); }, values);
}

/// Length and values as VTK wants them between the tags.
std::string encoded(const Values& values) {
  const std::uint64_t count = bytes_of(values);
  std::string block(reinterpret_cast<const char*>(&count), sizeof count);
  std::visit([&](const auto& v) { block.append(reinterpret_cast<const char*>(v.data()), count); }, values);
  return base64(block);
}

void write_array(std::ostream& out, const PolyArray& array, bool of_field = false) {
  out << "<DataArray type=\"" << type_of(array.values) << "\" Name=\"" << array.name << "\" "
      << (of_field ? "NumberOfTuples" : "NumberOfComponents") << "=\"" << array.components << "\" format=\"binary\">\n"
      << encoded(array.values) << "\n</DataArray>\n";
}

void write_section(std::ostream& out, const char* tag, const std::vector<PolyArray>& arrays) {
  out << '<' << tag << ">\n";
  for (const PolyArray& one : arrays) write_array(out, one);
  out << "</" << tag << ">\n";
}

std::vector<std::int32_t> counted(std::size_t count) {
  std::vector<std::int32_t> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::int32_t>(i);
  return numbers;
}

}  // namespace

void PolyData::add_cell(const std::vector<Vec2>& corners) {
  points.insert(points.end(), corners.begin(), corners.end());
  ends.push_back(static_cast<std::int32_t>(points.size()));
}

PolyArray vector_array(const std::string& name, const std::vector<Vec2>& values) {
  std::vector<float> components;
  for (const Vec2 v : values) components.insert(components.end(), {float(v.x), float(v.y), 0.0F});
  return {name, 3, std::move(components)};
}

void write_poly_data(std::ostream& out, const PolyData& data) {
  const auto count = [&](PolyCells kind) { return data.cells == kind ? data.ends.size() : 0; };
  const std::vector<PolyArray> cells = {{"connectivity", 1, counted(data.points.size())}, {"offsets", 1, data.ends}};
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n";
  write_array(out, {"TimeValue", 1, std::vector<double>{data.time}}, true);
  out << "</FieldData>\n<Piece NumberOfPoints=\"" << data.points.size() << "\" NumberOfVerts=\""
      << count(PolyCells::vertices) << "\" NumberOfLines=\"" << count(PolyCells::lines)
      << "\" NumberOfStrips=\"0\" NumberOfPolys=\"" << count(PolyCells::polygons) << "\">\n";
  write_section(out, "PointData", data.point_data);
  write_section(out, "CellData", data.cell_data);
  write_section(out, "Points", {vector_array("Points", data.points)});
  const char* tags[] = {"Verts", "Lines", "Polys"};
  write_section(out, tags[static_cast<int>(data.cells)], cells);
  out << "</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace gem
