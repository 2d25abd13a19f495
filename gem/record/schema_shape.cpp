// The columns of /shape and /boundary, which are known before the first time step.
#include <cmath>

#include "gem/record/schema.h"

namespace gem {

namespace {

using Values = std::function<std::vector<double>(const Bodies&)>;

/// One value per body of [first, end).
std::vector<double> per_body(std::size_t first, std::size_t end, const std::function<double(std::size_t)>& value) {
  std::vector<double> values;
  for (std::size_t i = first; i < end; ++i) values.push_back(value(i));
  return values;
}

Values per_floe(std::function<double(const Bodies&, std::size_t)> value) {
  return [value](const Bodies& b) {
    return per_body(first_floe(b), b.count(), [&](std::size_t i) { return value(b, i); });
  };
}

/// Outlines of the bodies [first, end) in sequence as x, y, x, y; in world axes if `world`.
std::vector<double> outlines(const Bodies& b, std::size_t first, std::size_t end, bool world) {
  std::vector<double> values;
  for (std::size_t i = first; i < end; ++i) {
    for (int n = b.vertex_begin[i]; n < b.vertex_begin[i + 1]; ++n) {
      Vec2 v = b.vertex[static_cast<std::size_t>(n)];
      if (world) v = b.position[i] + rotate(b.rotation[i], v);
      values.push_back(v.x);
      values.push_back(v.y);
    }
  }
  return values;
}

std::string class_names(const SceneDef& scene) {
  std::string names;
  for (const IceClassDef& ice_class : scene.floes.classes) {
    if (!names.empty()) names += ' ';
    for (const char c : ice_class.name) names += c == ' ' ? '_' : c;
  }
  return names;
}

}  // namespace

std::vector<ShapeColumn> shape_columns(const SceneDef& scene) {
  const auto floe = [](const char* name, Stored stored, const char* units, const char* long_name, Values values,
                       const std::string& flags = "") {
    return ShapeColumn{{"shape", name, "floe", stored, units, long_name, flags}, std::move(values)};
  };
  using B = Bodies;
  std::vector<ShapeColumn> columns = {
      {{"shape", "vertex_xy", "vertex xy", Stored::f8, "m", "outlines about the centroid, counter-clockwise", ""},
       [](const B& b) { return outlines(b, first_floe(b), b.count(), false); }},
      floe("vertex_count", Stored::i4, "1", "vertices of each floe in vertex_xy",
           per_floe([](const B& b, std::size_t i) { return double(b.vertex_count(i)); })),
      floe("area", Stored::f8, "m2", "area", per_floe([](const B& b, std::size_t i) { return b.area[i]; })),
      floe("thickness", Stored::f8, "m", "ice thickness",
           per_floe([](const B& b, std::size_t i) { return b.thickness[i]; })),
      floe("mass", Stored::f8, "kg", "mass", per_floe([](const B& b, std::size_t i) { return b.mass[i]; })),
      floe("inertia", Stored::f8, "kg m2", "moment of inertia about the centroid",
           per_floe([](const B& b, std::size_t i) { return b.inertia[i]; })),
      floe("class", Stored::u1, "1", "ice class",
           per_floe([](const B& b, std::size_t i) { return double(b.ice_class[i]); }), class_names(scene)),
      floe("start_x", Stored::f8, "m", "centroid at t = 0, x",
           per_floe([](const B& b, std::size_t i) { return b.position[i].x; })),
      floe("start_y", Stored::f8, "m", "centroid at t = 0, y",
           per_floe([](const B& b, std::size_t i) { return b.position[i].y; })),
      floe("start_theta", Stored::f8, "rad", "rotation at t = 0",
           per_floe([](const B& b, std::size_t i) { return std::atan2(b.rotation[i].sine, b.rotation[i].cosine); })),
      {{"shape", "platform_xy", "platform_vertex xy", Stored::f8, "m", "platform outline about its centroid", ""},
       [](const B& b) { return outlines(b, 0, first_fixed(b), false); }},
      {{"boundary", "vertex_xy", "boundary_vertex xy", Stored::f8, "m", "outlines of the fixed bodies in the world",
        ""},
       [](const B& b) { return outlines(b, first_fixed(b), first_floe(b), true); }},
      {{"boundary", "vertex_count", "boundary", Stored::i4, "1", "vertices of each fixed body in vertex_xy", ""},
       [](const B& b) {
         return per_body(first_fixed(b), first_floe(b), [&](std::size_t i) { return double(b.vertex_count(i)); });
       }},
  };
  if (has_pieces(scene))
    columns.push_back({{"shape", "platform_first", "platform_piece", Stored::i4, "1",
                        "first corner of each convex piece of the platform in platform_xy", ""},
                       [](const B& b) {
                         return per_body(0, first_fixed(b), [&](std::size_t i) { return double(b.vertex_begin[i]); });
                       }});
  return columns;
}

}  // namespace gem
