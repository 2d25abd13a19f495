// The stages of a time step. The engines cpu and cuda take their order from here. The reference engine, which judges
// them, states its own.
//
// | stage          | what                                         | reads                 | writes                   |
// |----------------|----------------------------------------------|-----------------------|--------------------------|
// | list           | near pairs, when the list is out of date     | positions, velocities | pairs                    |
// | candidates     | near pairs that may touch now                | positions, last axes  | candidates               |
// | narrow_phase   | contacts among the candidates                | positions, outlines   | contacts, axes           |
// | solo_events    | floes; the platform up to the pair events    | velocities            | velocities, platform     |
// | contact_events | independent: each event; coupled: its points | contacts, velocities  | impulses; points         |
// | gather         | coupled: layout of the points, warm start    | points, last impulses | solver's memory          |
// | iterate        | coupled: all points, to the residual         | solver's memory       | solver's memory          |
// | settle         | coupled: results of the iterations           | solver's memory       | impulses, velocities     |
// | books          | ledger entries, events, quality              | contacts, velocities  | ledger, log              |
// | move           | floes; platform after the events; retiring   | velocities, repair    | positions, outlines, log |
//
// The stages list, candidates and narrow_phase read the positions at the start of the time step. An engine may
// therefore run solo_events at the end of the previous time step. It may also merge neighbouring stages. An engine that
// does so says so in its own comments.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "gem/base/macros.h"

namespace gem {

enum class Stage {
  list,
  candidates,
  narrow_phase,
  solo_events,
  contact_events,
  gather,
  iterate,
  settle,
  books,
  move,
  // only for engines on a device, around the time steps of one call: gem/engine/device/phases.h
  open_call,
  first_solo_events,
  plan,
  last_books,
  close_call
};

/// The stages of one time step in order.
inline constexpr Stage time_step_stages[] = {
    Stage::list,   Stage::candidates, Stage::narrow_phase, Stage::solo_events, Stage::contact_events,
    Stage::gather, Stage::iterate,    Stage::settle,       Stage::books,       Stage::move};

/// Whether a stage exists only for `coupled` contacts.
GEM_HD constexpr bool is_of_solver(Stage stage) {
  return stage == Stage::gather || stage == Stage::iterate || stage == Stage::settle;
}

/// Calls run(stage) for each stage of a time step in order; `stage` is an integral_constant.
template <class Run>
GEM_HD constexpr void for_each_stage(Run&& run) {
  [&]<std::size_t... k>(std::index_sequence<k...>) { (run(std::integral_constant<Stage, time_step_stages[k]>{}), ...); }
  (std::make_index_sequence<sizeof time_step_stages / sizeof time_step_stages[0]>{});
}

}  // namespace gem
