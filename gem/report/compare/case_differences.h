// Which settings differ between the cases of several runs.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/scene_def.h"

namespace gem {

/// A key and its value in each case, as TOML text; "-" where a case has no such key.
struct CaseDifference {
  std::string key;
  std::vector<std::string> values;  // one per case
};

/// All keys whose values are not the same in all cases, in the order of the resolved text, without run.name. A list of
/// floes or fixed bodies in which many entries differ is one row.
std::vector<CaseDifference> case_differences(const std::vector<SceneDef>& cases);

}  // namespace gem
