// What a run file can be exported to.
#pragma once

#include <cstddef>
#include <string>

namespace gem {

/// Where an export goes and what may be replaced.
struct ExportTarget {
  std::string run_file;
  std::string output;
  bool overwrite = false;
  bool allow_incomplete = false;
};

/// What an export did, one line for people.
using ExportReport = std::string;

/// Writes OUT.pvd and the folder OUT_vtp, which ParaView opens as a film: for every frame the floes with their speeds,
/// the platform with its forces, the hits since the frame before, and the forces between bodies if they were recorded;
/// the track of the platform and the fixed bodies. A frame each `every_s` [s]; 0: every frame of the file. Throws
/// Error(file_system) if the run file cannot be read or the output not be written, and Error(resource_limit) if the
/// disk has too little room.
ExportReport export_paraview(const ExportTarget& target, double every_s);

/// Writes the frame nearest to `at_s` [s] as GeoJSON, a floe file that a case may name: floes that overlap are drawn
/// smaller until they only touch (parting_scales()); property `scale` tells. Negative: the last frame. Throws as above,
/// and Error(usage) if the run ends before, or if floes overlap too deeply.
ExportReport export_geojson(const ExportTarget& target, double at_s);

/// Writes /platform, /events, /stats or /contacts as CSV: one column for each dataset with its unit in the name, one
/// row for each of its rows, numbers that read back exactly. Bodies are numbered as by exported_body(). What is not a
/// number is left empty. Throws as above.
ExportReport export_table(const ExportTarget& target, const std::string& table);

}  // namespace gem
