// Reads rows and statements from JSON.
#include "validation/paper/statements/catalogue.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

using Json = nlohmann::json;

[[noreturn]] void reject(const std::string& problem) { throw std::invalid_argument(problem); }

TableRow row_of(const Json& json, const std::string& table) {
  TableRow row;
  row.table = table;
  row.number = json.at("number").get<std::string>();
  row.run = json.at("run").get<std::string>();
  row.thick = json.at("thick").get<double>();
  row.medium = json.at("medium").get<double>();
  row.thin = json.at("thin").get<double>();
  row.gap_m = json.at("gap_m").get<double>();
  row.current_m_per_s = json.at("current_m_per_s").get<double>();
  row.stiffness_N_per_m = json.at("stiffness_N_per_m").get<double>();
  row.drag = json.at("drag").get<bool>();
  return row;
}

Rule rule_of(const Json& json, const std::string& id) {
  const std::string name = json.at("kind").get<std::string>();
  const auto kind = rule_kind(name);
  if (!kind) reject(id + ": unknown kind of rule '" + name + "' (within, above, below, significant)");
  const Rule rule{*kind, json.at("expected").get<double>(), json.value("tolerance", 0.0)};
  if (rule.kind == RuleKind::within && !(rule.tolerance > 0.0)) reject(id + ": 'within' needs a positive tolerance");
  return rule;
}

Over over_of(const Json& json, const std::string& id) {
  const std::string name = json.value("over", "mean");
  if (name == "mean") return Over::mean;
  if (name == "every") return Over::every;
  if (name == "chances") return Over::chances;
  reject(id + ": unknown 'over' '" + name + "' (mean, every, chances)");
}

Statement statement_of(const Json& json) {
  Statement statement;
  statement.id = json.at("id").get<std::string>();
  statement.source = json.at("source").get<std::string>();
  statement.says = json.at("says").get<std::string>();
  statement.condition = json.value("condition", "");
  statement.against = json.value("against", "");
  statement.metric = json.at("metric").get<std::string>();
  statement.over = over_of(json, statement.id);
  statement.rule = rule_of(json, statement.id);
  statement.share = json.value("share", statement.share);
  if (!(statement.share > 0.0 && statement.share < 1.0)) reject(statement.id + ": 'share' lies between 0 and 1");
  statement.alike = json.value("alike", false);
  statement.why = json.at("why").get<std::string>();
  statement.choice = json.value("choice", false);
  return statement;
}

void check_ids(const std::vector<Statement>& statements) {
  std::set<std::string> ids;
  for (const Statement& statement : statements)
    if (!ids.insert(statement.id).second) reject("two statements have the id " + statement.id);
}

}  // namespace

Catalogue parse_catalogue(const std::string& text, const std::string& origin) {
  try {
    const Json json = Json::parse(text);
    Catalogue catalogue;
    for (const std::string table : {"1", "2"})
      for (const Json& row : json.at("table" + table)) catalogue.rows.push_back(row_of(row, table));
    for (const Json& entry : json.at("statements")) catalogue.statements.push_back(statement_of(entry));
    check_ids(catalogue.statements);
    return catalogue;
  } catch (const std::exception& problem) {
    throw Error(ExitCode::file_system,
                shown(origin) + ": not the list of the paper's statements (" + problem.what() + "); mend the file");
  }
}

Catalogue read_catalogue(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Error(ExitCode::file_system, "cannot read " + shown(path) +
                                           " (no such file or no permission); name it with --statements: it is "
                                           "validation/paper/paper.json of gem's sources");
  std::ostringstream text;
  text << file.rdbuf();
  return parse_catalogue(text.str(), path);
}

}  // namespace gem
