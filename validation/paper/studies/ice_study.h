// Divergence of the ice of two runs in which one floe is shifted (build/ice_distances).
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "validation/paper/statements/folder_numbers.h"
#include "validation/paper/studies/divergence_study.h"

namespace gem {

/// Root mean square distance over the floes of a field above which their contacts are different. At that level a few
/// floes are apart by about the gaps between floes and the others still agree [m].
constexpr double kIceApart = 1e-2;

struct IceStudy {
  std::map<std::string, DivergenceStudy>
      of_contacts;  // coupled, independent; the swing of these distances is kIceApart
  std::string commit;
};

/// Reads ice_distances.csv in a folder; without the file the study is empty. Throws Error(file_system) with file and
/// line of a mistake.
IceStudy read_ice_study(const std::filesystem::path& folder);

/// Adds ice_divergence_rate_<contacts>_per_s and ice_onset_shift_<contacts>, as add_divergence_numbers does for
/// platforms.
void add_ice_numbers(const IceStudy& study, FolderNumbers& numbers);

}  // namespace gem
