// Keys of [floes].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {
namespace {

void add_source(SceneTable& t) {
  t.choice("floes.source", {"generated", "copied", "file", "listed"},
           "where the floes come from: a generated field, copies of a few shapes, a file, or [[floe]]",
           GEM_FIELD(floes.source));
  t.text("floes.path",
         "floe file for source = \"file\": .csv, .geojson or a run file (its floes at floes.time_s), relative to the "
         "case file",
         GEM_FIELD(floes.path));
  t.number("floes.time_s", "s", {0.0, 1e9},
           "for a run file: time of the recorded frame that the floes are taken from; 0: the start of that run",
           GEM_FIELD(floes.time_s));
  t.text("floes.sha256",
         "SHA-256 of the floes that floes.path must hold: a file with other floes is refused. Stored cases have it",
         GEM_FIELD(floes.sha256));
  t.opt_in = true;
  t.choice(
      "floes.concave", {"refuse", "cut", "hull"},
      "outlines of a .csv or .geojson file that are not convex, or have more than 20 corners: refuse the file, cut "
      "them into convex floes of the same area (not bonded to each other), or take their convex hull",
      GEM_FIELD(floes.concave));
  t.opt_in = false;
  t.integer("floes.count", {0.0, 1e7},
            "number of floes; it sets the concentration: count x (size_mean_m^2 + size_deviation_m^2) / "
            "(length_m x width_m)",
            GEM_FIELD(floes.count));
  t.opt_in = true;
  t.number("floes.concentration", "", {0.0, concentration_maximum},
           "share of the free water in the field that floes cover, from 0.05; it replaces floes.count; 0: not used. "
           "Above 0.75 the floes of a generated field are the cells of a mosaic",
           GEM_FIELD(floes.concentration));
  t.opt_in = false;
  t.number("floes.length_m", "m", extent_range, "length of the field along the current", GEM_FIELD(floes.length_m));
  t.number("floes.width_m", "m", extent_range, "width of the field", GEM_FIELD(floes.width_m));
  t.number("floes.start_x_m", "m", place_range, "x of the upstream end of the field", GEM_FIELD(floes.start_x_m));
}

void add_sizes(SceneTable& t) {
  t.choice("floes.size_law", {"lognormal", "gamma"}, "distribution of sqrt(area), truncated to the limits",
           GEM_FIELD(floes.size_law));
  t.number("floes.size_minimum_m", "m", floe_size_range, "smallest sqrt(area)", GEM_FIELD(floes.size_minimum_m));
  t.number("floes.size_maximum_m", "m", floe_size_range, "largest sqrt(area)", GEM_FIELD(floes.size_maximum_m));
  t.number("floes.size_mean_m", "m", floe_size_range, "mean of sqrt(area)", GEM_FIELD(floes.size_mean_m));
  t.number("floes.size_deviation_m", "m", {0.0, 1000.0, true}, "standard deviation of sqrt(area)",
           GEM_FIELD(floes.size_deviation_m));
  t.number("floes.gap_m", "m", {0.0, 100.0, true}, "smallest distance between floes at the start",
           GEM_FIELD(floes.gap_m));
  t.choice("floes.placement", {"random", "tiled"}, "arrangement of the copies (source = \"copied\")",
           GEM_FIELD(floes.placement));
  t.integer("floes.shape_count", {1.0, 1e5}, "number of shapes that are copied (source = \"copied\")",
            GEM_FIELD(floes.shape_count));
  t.number("floes.tile_length_m", "m", extent_range, "approximate length of the repeated block (placement = \"tiled\")",
           GEM_FIELD(floes.tile_length_m));
  t.integer("floes.moved_floe", {-1.0, 1e7},
            "floe that is shifted by floes.moved_by_m: 0 is the nearest to platform.anchor_m, 1 the next; -1: none",
            GEM_FIELD(floes.moved_floe));
  t.pair("floes.moved_by_m", "m", {-1.0, 1.0},
         "shift of one floe's start position, to study how fast a disturbance grows", GEM_FIELD(floes.moved_by_m));
}

}  // namespace

void add_floes(SceneTable& t) {
  add_source(t);
  add_sizes(t);
}

}  // namespace gem::sections
