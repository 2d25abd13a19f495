// Helpers that write the option table with one call per option.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "gem/scene/schema/schema.h"

// Accessor of one member, for const and mutable scenes.
#define GEM_FIELD(member) \
  [](auto& s) -> auto& { return s.member; }

namespace gem {

/// `Field` maps a T (const or not) to a reference to one member.
template <class T>
struct OptionTable {
  std::vector<Option<T>> options;
  bool opt_in = false;            ///< of the options that are added next
  NeededChoice counts_with = {};  ///< of the options that are added next

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
  void outline(std::string path, Range range, std::string doc, Field field,
               std::size_t corners_maximum = listed_corners_maximum) {
    add<std::vector<Vec2>>({std::move(path), OptionType::outline, "m", range, {}, std::move(doc)}, field);
    options.back().corners_maximum = corners_maximum;
  }
  /// `Field` is a vector of arrays of numbers, as many as columns.
  template <class Field>
  void table(std::string path, std::vector<OptionColumn> columns, std::string doc, Field field) {
    std::string unit;
    for (const OptionColumn& column : columns) unit += (unit.empty() ? "" : ", ") + column.unit;
    Option<T>& option = add_info({std::move(path), OptionType::table, unit, {}, {}, std::move(doc), "", columns});
    option.get = [field](const T& t) {
      OptionRows rows;
      for (const auto& row : field(t)) rows.emplace_back(row.begin(), row.end());
      return OptionValue(rows);
    };
    option.set = [field](T& t, const OptionValue& v) {
      auto& target = field(t);
      target.clear();
      for (const std::vector<double>& row : std::get<OptionRows>(v))
        std::copy(row.begin(), row.end(), target.emplace_back().begin());
    };
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
    options.back().opt_in = opt_in;
    options.back().counts_with = counts_with;
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
