// Writes and reads the attributes of the verdict.
#include "gem/record/run_file/verdict_attributes.h"

#include <algorithm>
#include <sstream>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

using Numbers = double Judgement::*;
constexpr std::pair<const char*, Numbers> number_lists[] = {{"gem_verdict_values", &Judgement::value},
                                                            {"gem_verdict_doubtful_above", &Judgement::doubtful_above},
                                                            {"gem_verdict_bad_above", &Judgement::bad_above},
                                                            {"gem_verdict_times_s", &Judgement::time_s}};

// Room for a verdict of any run, reserved at its start: no attribute can be added to a file that others read.
constexpr std::size_t most_judgements = 16;
constexpr std::size_t word_size = 32;
constexpr std::size_t text_size = 500;

/// A grade in a list whose items are separated by blanks.
std::string grade_word(Grade grade) {
  std::string word = grade_name(grade);
  std::replace(word.begin(), word.end(), ' ', '_');
  return word;
}

/// Without line breaks, and cut before a character that does not fit.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.size() < text_size) return text;
  std::size_t end = text_size - 1;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return text.substr(0, end);
}

Grade grade_of_word(std::string word) {
  std::replace(word.begin(), word.end(), '_', ' ');
  for (const Grade grade : {Grade::good, Grade::doubtful, Grade::bad})
    if (word == grade_name(grade)) return grade;
  return Grade::not_judged;
}

std::vector<std::string> items(const std::string& text, char separator) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, separator);) all.push_back(item);
  return all;
}

[[noreturn]] void refuse(const RunFile& file) {
  throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) +
                                         " (its verdict is damaged: the lists gem_verdict_* differ in length); run the "
                                         "case again");
}

}  // namespace

void reserve_verdict(hid_t file) {
  hdf5::write_text(file, "gem_verdict", "", word_size);
  hdf5::write_text(file, "gem_verdict_criteria", "", most_judgements * word_size);
  hdf5::write_text(file, "gem_verdict_grades", "", most_judgements * word_size);
  hdf5::write_text(file, "gem_verdict_texts", "", most_judgements * text_size);
  for (const auto& [name, member] : number_lists)
    hdf5::write_numbers(file, name, H5T_IEEE_F64LE, std::vector<double>(most_judgements, std::nan("")));
}

void write_verdict(hid_t file, const RunVerdict& verdict) {
  std::string criteria, grades, texts;
  for (const Judgement& one : verdict.judgements) {
    criteria += (criteria.empty() ? "" : " ") + one.criterion;
    grades += (grades.empty() ? "" : " ") + grade_word(one.grade);
    texts += one_line(one.text) + "\n";
  }
  hdf5::write_text(file, "gem_verdict_criteria", criteria);
  hdf5::write_text(file, "gem_verdict_grades", grades);
  hdf5::write_text(file, "gem_verdict_texts", texts);
  for (const auto& [name, member] : number_lists) {
    std::vector<double> values;
    for (const Judgement& one : verdict.judgements) values.push_back(one.*member);
    values.resize(most_judgements, std::nan(""));
    hdf5::write_numbers(file, name, H5T_IEEE_F64LE, values);
  }
  hdf5::write_text(file, "gem_verdict", grade_name(verdict.grade));  // last: whoever finds it finds all
}

RunVerdict verdict_of(const RunFile& file) {
  RunVerdict verdict;
  const std::string grade = file.attribute("gem_verdict");
  if (grade.empty()) return verdict;
  verdict.grade = grade_of_word(grade);
  const std::vector<std::string> criteria = items(file.attribute("gem_verdict_criteria"), ' ');
  const std::vector<std::string> grades = items(file.attribute("gem_verdict_grades"), ' ');
  const std::vector<std::string> texts = items(file.attribute("gem_verdict_texts"), '\n');
  if (grades.size() != criteria.size() || texts.size() != criteria.size()) refuse(file);
  verdict.judgements.resize(criteria.size());
  for (std::size_t i = 0; i < criteria.size(); ++i) {
    verdict.judgements[i].criterion = criteria[i];
    verdict.judgements[i].grade = grade_of_word(grades[i]);
    verdict.judgements[i].text = texts[i];
  }
  for (const auto& [name, member] : number_lists) {
    const std::vector<double> values = file.number_list(name);
    if (values.size() < criteria.size()) refuse(file);
    for (std::size_t i = 0; i < criteria.size(); ++i) verdict.judgements[i].*member = values[i];
  }
  return verdict;
}

}  // namespace gem
