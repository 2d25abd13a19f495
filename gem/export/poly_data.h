// A file of VTK's polygons, .vtp, as VTK and ParaView read it.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// Values of a cell or a point each, `components` of them together.
struct PolyArray {
  std::string name;  // plain letters
  int components = 1;
  std::variant<std::vector<std::uint8_t>, std::vector<std::int32_t>, std::vector<float>, std::vector<double>> values;
};

enum class PolyCells { vertices, lines, polygons };

/// Cells of one kind. Cell i has the points from ends[i-1] on, before ends[i].
struct PolyData {
  PolyCells cells = PolyCells::polygons;
  std::vector<Vec2> points;  // [m], stored in single precision with z = 0
  std::vector<std::int32_t> ends;
  std::vector<PolyArray> cell_data;
  std::vector<PolyArray> point_data;
  double time = 0.0;  // field array TimeValue [s]

  void add_cell(const std::vector<Vec2>& corners);
};

/// Vectors in the plane as an array of three components, as VTK wants them.
PolyArray vector_array(const std::string& name, const std::vector<Vec2>& values);

/// Writes the file: XML with the arrays in base64.
void write_poly_data(std::ostream& out, const PolyData& data);

}  // namespace gem
