// Helpers that write the option table with one call per option.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gem/scene/schema/schema.h"

namespace gem {

/// `Field` maps a T (const or not) to a reference to one member.
template <class T>
struct OptionTable {
  std::vector<Option<T>> options;

  template <class Field>
  void number(std::string path, std::string unit, Range range, std::string doc, Field field, std::string why = "") {
    add<double>({std::move(path), OptionType::number, std::move(unit), range, {}, std::move(doc), std::move(why)},
                field);
  }
  template <class Field>
  void integer(std::string path, Range range, std::string doc, Field field) {
    Option<T>& option = add_info({std::move(path), OptionType::integer, "", range, {}, std::move(doc)});
    option.get = [field](const T& t) { return OptionValue(static_cast<std::int64_t>(field(t))); };
    option.set = [field](T& t, const OptionValue& v) {
      field(t) = static_cast<std::remove_reference_t<decltype(field(t))>>(std::get<std::int64_t>(v));
    };
  }
  template <class Field>
  void text(std::string path, std::string doc, Field field) {
    add<std::string>({std::move(path), OptionType::text, "", {}, {}, std::move(doc)}, field);
  }
  template <class Field>
  void flag(std::string path, std::string doc, Field field) {
    add<bool>({std::move(path), OptionType::flag, "", {}, {}, std::move(doc)}, field);
  }
  template <class Field>
  void pair(std::string path, std::string unit, Range range, std::string doc, Field field) {
    add<Vec2>({std::move(path), OptionType::pair, std::move(unit), range, {}, std::move(doc)}, field);
  }
  template <class Field>
  void outline(std::string path, Range range, std::string doc, Field field) {
    add<std::vector<Vec2>>({std::move(path), OptionType::outline, "m", range, {}, std::move(doc)}, field);
  }
  /// `names` are in the order of the enumerators.
  template <class Field>
  void choice(std::string path, std::vector<std::string> names, std::string doc, Field field) {
    Option<T>& option = add_info({std::move(path), OptionType::choice, "", {}, names, std::move(doc)});
    option.get = [field, names](const T& t) { return OptionValue(names.at(static_cast<std::size_t>(field(t)))); };
    option.set = [field, names](T& t, const OptionValue& v) {
      std::size_t index = 0;
      while (names.at(index) != std::get<std::string>(v)) ++index;
      field(t) = static_cast<std::remove_reference_t<decltype(field(t))>>(index);
    };
  }

 private:
  Option<T>& add_info(OptionInfo info) {
    options.emplace_back();
    static_cast<OptionInfo&>(options.back()) = std::move(info);
    return options.back();
  }
  template <class Value, class Field>
  void add(OptionInfo info, Field field) {
    Option<T>& option = add_info(std::move(info));
    option.get = [field](const T& t) { return OptionValue(Value(field(t))); };
    option.set = [field](T& t, const OptionValue& v) { field(t) = std::get<Value>(v); };
  }
};

}  // namespace gem
