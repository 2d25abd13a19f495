// The XML part of a .vtp file names for each array where its bytes begin; the bytes follow, each array with its length.
#include "gem/export/poly_data.h"

#include <array>
#include <bit>

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

/// Collects the arrays while their tags are written, then their bytes.
class VtpWriter {
 public:
  explicit VtpWriter(std::ostream& out) : out_(out) {}

  void array(PolyArray array, bool of_field = false) {
    out_ << "<DataArray type=\"" << type_of(array.values) << "\" Name=\"" << array.name << "\" "
         << (of_field ? "NumberOfTuples" : "NumberOfComponents") << "=\"" << array.components
         << "\" format=\"appended\" offset=\"" << offset_ << "\"/>\n";
    offset_ += sizeof(std::uint64_t) + bytes_of(array.values);
    arrays_.push_back(std::move(array.values));
  }

  void section(const char* tag, std::vector<PolyArray> arrays) {
    out_ << '<' << tag << ">\n";
    for (PolyArray& one : arrays) array(std::move(one));
    out_ << "</" << tag << ">\n";
  }

  void bytes() const {
    for (const Values& values : arrays_) {
      const std::uint64_t count = bytes_of(values);
      out_.write(reinterpret_cast<const char*>(&count), sizeof count);
      std::visit([&](const auto& v) { out_.write(reinterpret_cast<const char*>(v.data()), std::streamsize(count)); },
                 values);
    }
  }

 private:
  std::ostream& out_;
  std::uint64_t offset_ = 0;
  std::vector<Values> arrays_;
};

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
  VtpWriter writer(out);
  writer.array({"TimeValue", 1, std::vector<double>{data.time}}, true);
  out << "</FieldData>\n<Piece NumberOfPoints=\"" << data.points.size() << "\" NumberOfVerts=\""
      << count(PolyCells::vertices) << "\" NumberOfLines=\"" << count(PolyCells::lines)
      << "\" NumberOfStrips=\"0\" NumberOfPolys=\"" << count(PolyCells::polygons) << "\">\n";
  writer.section("PointData", data.point_data);
  writer.section("CellData", data.cell_data);
  writer.section("Points", {vector_array("Points", data.points)});
  const char* tags[] = {"Verts", "Lines", "Polys"};
  writer.section(tags[static_cast<int>(data.cells)], cells);
  out << "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  writer.bytes();
  out << "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace gem
