// How fast the ice of two runs parts that differ by the place of one floe (build/ice_distances).
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "validation/paper/statements/folder_numbers.h"
#include "validation/paper/studies/divergence_study.h"

namespace gem {

/// Root mean square over the floes of a field from which on their events are others: few of them are then apart by what
/// lies between floes, the others as they were [m].
constexpr double kIceApart = 1e-2;

struct IceStudy {
  std::map<std::string, DivergenceStudy> of_contacts;  // coupled, independent; distances of the ice, swing kIceApart
  std::string commit;
};

/// From ice_distances.csv in a folder; without it there is no study. Throws Error(file_system) naming file and line of
/// what cannot be understood.
IceStudy read_ice_study(const std::filesystem::path& folder);

/// ice_divergence_rate_<contacts>_per_s and ice_onset_shift_<contacts>: as add_divergence_numbers has them for
/// platforms.
void add_ice_numbers(const IceStudy& study, FolderNumbers& numbers);

}  // namespace gem
