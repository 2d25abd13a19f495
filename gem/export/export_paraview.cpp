// A run as a film for ParaView: files of polygons per frame, and a list of them with their times.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/export/contact_lines.h"
#include "gem/export/export_output.h"
#include "gem/export/export_run.h"
#include "gem/export/floe_record.h"
#include "gem/export/hit_points.h"
#include "gem/export/platform_track.h"
#include "gem/export/poly_data.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

PolyData floe_cells(const FloeRecord& record, const std::vector<FrameFloe>& floes, double time_s) {
  PolyData data;
  data.time = time_s;
  std::vector<std::int32_t> index;
  std::vector<std::uint8_t> ice_class;
  std::vector<float> thickness, mass, speed, spin;
  std::vector<Vec2> velocity;
  for (const FrameFloe& floe : floes) {
    data.add_cell(placed(floe.outline, floe.position, 0.0));
    index.push_back(static_cast<std::int32_t>(floe.index));
    ice_class.push_back(static_cast<std::uint8_t>(record.ice_class(floe.index)));
    thickness.push_back(static_cast<float>(record.thickness(floe.index)));
    mass.push_back(static_cast<float>(record.mass(floe.index)));
    velocity.push_back(floe.velocity);
    speed.push_back(static_cast<float>(length(floe.velocity)));
    spin.push_back(static_cast<float>(floe.spin));
  }
  data.cell_data = {{"floe", 1, index},
                    {"class", 1, ice_class},
                    {"thickness", 1, thickness},
                    {"mass", 1, mass},
                    vector_array("velocity", velocity),
                    {"speed", 1, speed},
                    {"spin", 1, spin}};
  return data;
}

/// A cell for each piece of the platform; each has the values of the whole.
PolyData platform_cells(const PlatformTrack& platform, double time_s) {
  PolyData data;
  data.time = time_s;
  const std::size_t sample = platform.sample_at(time_s);
  const std::vector<std::vector<Vec2>> outlines = platform.outlines(sample);
  const std::size_t pieces = outlines.size();
  for (const std::vector<Vec2>& outline : outlines) data.add_cell(outline);
  const auto vectors = [&](Vec2 value) { return std::vector<Vec2>(pieces, value); };
  const auto numbers = [&](const char* name) { return std::vector<double>(pieces, platform.value(name, sample)); };
  data.cell_data = {vector_array("velocity", vectors({platform.value("vx", sample), platform.value("vy", sample)})),
                    {"yaw", 1, numbers("psi")},
                    {"spin", 1, numbers("r")}};
  for (const char* name : {"ice_force", "ice_force_mean", "mooring_force", "drag_force"})
    data.cell_data.push_back(vector_array(name, vectors(platform.vector(name, sample))));
  return data;
}

PolyData track_line(const PlatformTrack& platform) {
  PolyData data;
  data.cells = PolyCells::lines;
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < platform.times().size(); ++i) places.push_back(platform.position(i));
  data.add_cell(places);
  data.point_data = {{"time", 1, platform.times()}};
  return data;
}

PolyData fixed_cells(const RunFile& file) {
  PolyData data;
  for (const std::vector<Vec2>& outline : file.boundary_outlines()) data.add_cell(outline);
  return data;
}

/// Frames at least `every_s` apart, the first and the last among them.
std::vector<std::size_t> chosen_frames(const std::vector<double>& times, double every_s) {
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (frames.empty() || i + 1 == times.size() || times[i] >= times[frames.back()] + every_s * (1.0 - 1e-9))
      frames.push_back(i);
  return frames;
}

std::string attribute_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&' || c == '<' || c == '"') {
      safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : "&quot;";
    } else {
      safe += c;
    }
  }
  return safe;
}

/// The list of files with their times. Parts stand in one order, so that ParaView shows them as blocks.
class PartList {
 public:
  explicit PartList(std::string folder) : folder_(std::move(folder)) {}

  void add(double time_s, int part, const char* name, const std::string& file) {
    text_ += "<DataSet timestep=\"" + number_text(time_s) + "\" part=\"" + std::to_string(part) + "\" name=\"" + name +
             "\" file=\"" + attribute_text(folder_ + "/" + file) + "\"/>\n";
  }
  std::string text() const {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
           "<Collection>\n" +
           text_ + "</Collection>\n</VTKFile>\n";
  }

 private:
  std::string folder_, text_;
};

/// Writes the files of one run.
class Film {
 public:
  Film(const RunFile& file, const ExportFolder& folder, PartList& list)
      : file_(file),
        record_(file),
        platform_(file),
        hits_(file),
        has_contacts_(ContactRecord::is_in(file)),
        contacts_(file),
        folder_(folder),
        list_(list) {}

  std::size_t write(double every_s, const std::string& output) {
    const std::vector<std::size_t> frames = chosen_frames(record_.times(), every_s);
    check_room(frames.size(), output);
    if (platform_.present()) put("track.vtp", track_line(platform_));
    put("fixed.vtp", fixed_cells(file_));
    double before = -1.0;  // hits at t = 0 belong to the first frame
    for (const std::size_t frame : frames) {
      write_frame(frame, before);
      before = record_.times()[frame];
    }
    return frames.size();
  }

 private:
  void put(const std::string& name, const PolyData& data) const {
    folder_.write(name, [&](std::ostream& out) { write_poly_data(out, data); });
  }

  void write_frame(std::size_t frame, double before) {
    const double time = record_.times()[frame];
    char number[24];
    std::snprintf(number, sizeof number, "_%06zu.vtp", frame);
    const auto add = [&](int part, const char* name, const PolyData& data) {
      put(name + std::string(number), data);
      list_.add(time, part, name, name + std::string(number));
    };
    const std::vector<FrameFloe> floes = record_.frame(frame);
    add(0, "floes", floe_cells(record_, floes, time));
    if (platform_.present()) add(1, "platform", platform_cells(platform_, time));
    add(2, "hits", hits_.between(before, time));
    if (platform_.present()) list_.add(time, 3, "track", "track.vtp");
    list_.add(time, 4, "fixed", "fixed.vtp");
    if (has_contacts_) add(5, "contacts", contact_lines(contacts_, floes, platform_, time));
  }

  /// Every frame is at most as large as one with all floes.
  void check_room(std::size_t frames, const std::string& output) const {
    constexpr double bytes_per_corner = 16.0, bytes_per_floe = 37.0, bytes_of_others = 12288.0,
                     bytes_per_contact = 80.0;
    const double need = double(frames) * (bytes_per_corner * double(record_.corner_count()) +
                                          bytes_per_floe * double(record_.count()) + bytes_of_others) +
                        bytes_per_contact * double(contacts_.rows());
    const double room = static_cast<double>(room_at(output));
    if (need > room)
      throw Error(ExitCode::resource_limit, "cannot write " + shown(output) + " (" + std::to_string(frames) +
                                                " frames need about " + fixed_text(need / 1e6, 0) + " MB, free are " +
                                                fixed_text(room / 1e6, 0) +
                                                " MB); make room, or take fewer frames with --every");
  }

  const RunFile& file_;
  FloeRecord record_;
  PlatformTrack platform_;
  HitPoints hits_;
  bool has_contacts_;
  ContactRecord contacts_;
  const ExportFolder& folder_;
  PartList& list_;
};

}  // namespace

ExportReport export_paraview(const ExportTarget& target, double every_s) {
  check_output_path(target.output, target.overwrite);
  const RunFile file(target.run_file, target.allow_incomplete);
  const std::filesystem::path output(target.output);
  const std::string folder_name = output.stem().string() + "_vtp";
  ExportFolder folder(output.parent_path() / folder_name, target.overwrite);
  PartList list(folder_name);
  const std::size_t frames = Film(file, folder, list).write(every_s, target.output);
  folder.publish();
  write_export(output, [&](std::ostream& out) { out << list.text(); });
  return shown(target.output) + ": " + std::to_string(frames) + " frames in " +
         shown((output.parent_path() / folder_name).string()) + "\n";
}

}  // namespace gem
