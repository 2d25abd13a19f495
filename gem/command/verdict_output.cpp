// Texts and JSON of a verdict.
#include "gem/command/verdict_output.h"

namespace gem {

std::string reasons_text(const RunVerdict& verdict, const std::string& indent) {
  std::string text;
  for (const Judgement& one : verdict.judgements) {
    if (one.grade == Grade::good) continue;
    std::string grade = grade_name(one.grade);
    grade.resize(12, ' ');
    text += indent + grade + one.criterion + ": " + one.text + "\n";
  }
  return text;
}

nlohmann::ordered_json criteria_json(const RunVerdict& verdict) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Judgement& one : verdict.judgements)
    list.push_back({{"criterion", one.criterion},
                    {"grade", grade_name(one.grade)},
                    {"value", one.value},
                    {"doubtful_above", one.doubtful_above},
                    {"bad_above", one.bad_above},
                    {"time_s", one.time_s},
                    {"text", one.text}});
  return list;
}

}  // namespace gem
