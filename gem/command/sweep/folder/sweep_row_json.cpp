// Conversion of sweep rows, checked by the JSON library and by what names of variables may be.
#include "gem/command/sweep/folder/sweep_row_json.h"

#include <stdexcept>

#include "gem/command/command.h"
#include "gem/record/output/output_path.h"
#include "gem/scene/sweep/draw_table.h"

namespace gem {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const SweepDraw& draw) {
  Json values = Json::array();
  for (const DrawnValue& one : draw.values)
    values.push_back({{"variable", one.variable}, {"key", one.key}, {"law", one.law}, {"value", one.value}});
  return {{"condition", draw.condition},
          {"draw", draw.draw},
          {"part", draw.part},
          {"repeat", draw.repeat},
          {"values", values}};
}

SweepDraw draw_of(const Json& object) {
  SweepDraw draw{object.at("condition"), object.at("draw"), object.at("part"), object.at("repeat"), {}};
  for (const Json& one : object.at("values")) {
    draw.values.push_back({one.at("variable"), one.at("key"), one.at("law"), one.at("value")});
    if (!is_variable_name(draw.values.back().variable)) throw std::length_error("a variable has no plain name");
  }
  return draw;
}

Json row_json(const SweepRow& row) {
  Json object = {{"index", row.index},
                 {"name", row.name},
                 {"file", run_file_name(row.name)},
                 {"status", row.status},
                 {"state_hash", row.state_hash},
                 {"engine", row.engine},
                 {"duration_s", row.duration_s},
                 {"time_s", row.time_s},
                 {"wall_time_s", row.wall_time_s},
                 {"error", row.error},
                 {"verdict", row.verdict},
                 {"doubts", row.doubts},
                 {"case_sha256", row.case_sha256}};
  if (row.draw.draw > 0) object["draw"] = json_of(row.draw);
  return object;
}

}  // namespace

SweepRow row_of_json(const Json& object) {
  SweepRow row{object.at("index"),       object.at("name"),   object.at("case_sha256"),    object.at("status"),
               object.at("state_hash"),  object.at("engine"), object.at("duration_s"),     object.at("time_s"),
               object.at("wall_time_s"), object.at("error"),  object.value("verdict", ""), {}};
  row.doubts = object.value("doubts", "");
  if (const auto draw = object.find("draw"); draw != object.end()) row.draw = draw_of(*draw);
  return row;
}

Json json_of(const std::vector<SweepRow>& rows) {
  Json list = Json::array();
  for (const SweepRow& row : rows) list.push_back(row_json(row));
  return list;
}

}  // namespace gem
