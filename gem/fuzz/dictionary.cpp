// Prints the words of all inputs as a dictionary of libFuzzer. Those of case files come from the table of options.
#include <iostream>
#include <set>

#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/scene_tree.h"

namespace {

template <class T>
void collect(std::set<std::string>& words, const std::vector<gem::Option<T>>& options) {
  for (const auto& option : options) {
    words.insert(option.path.substr(option.path.find('.') + 1));
    for (const std::string& choice : option.choices) words.insert(choice);
  }
}

}  // namespace

int main() {
  std::set<std::string> words = {"sweep", "mode",  "product", "list",     "name", "map",      "set",    "seeds",
                                 "count", "first", "draw",    "variable", "law",  "sampling", "repeats"};
  words.insert({"nan", "inf", "-1", "1e300", "-1e300", "1e-320", "2147483648", "4294967296", "9223372036854775807"});
  words.insert({"floe,x,y,thickness", "FeatureCollection", "Polygon", "coordinates", "properties", "thickness"});
  words.insert(
      {"text / ", "number / ", "data ", "strings ", "fixed ", "scale ", "attach ", "gem_case_toml", "gem_verdict"});
  for (const std::string& key : gem::known_keys()) words.insert({key, key.substr(0, key.find('.'))});
  collect(words, gem::scene_options());
  collect(words, gem::ice_class_options());
  collect(words, gem::floe_options());
  collect(words, gem::platform_piece_options());
  collect(words, gem::thruster_options());
  collect(words, gem::fixed_options());
  for (const std::string& word : words) std::cout << '"' << word << "\"\n";
}
