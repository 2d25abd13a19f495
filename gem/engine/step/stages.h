// The stages of a time step. This is the only place that says their order; every engine takes it from here.
//
// | stage          | what                                                | reads                 | writes |
// |----------------|-----------------------------------------------------|-----------------------|--------------------------|
// | list           | near pairs, when the list has worn out              | positions, velocities | pairs | | candidates
// | near pairs that may touch now                       | positions, last axes  | candidates               | |
// narrow_phase   | where candidates touch                              | positions, outlines   | contacts, axes | |
// solo_events    | floes, and the platform up to the pair events       | velocities            | velocities, platform |
// | contact_events | independent: each event; coupled: its points        | contacts, velocities  | impulses; points |
// | gather         | coupled: where points stand and begin               | points, last impulses | solver's memory | |
// iterate        | coupled: all points until the residual is met       | solver's memory       | solver's memory | |
// settle         | coupled: what the iterations come to                | solver's memory       | impulses, velocities |
// | books          | energy and momentum by channel, events, quality     | contacts, velocities  | ledger, log | | move
// | floes; the platform after the pair events; retiring | velocities, repair    | positions, outlines, log |
//
// The positions that list, candidates and narrow_phase read are those of the start of the time step, so an engine may
// make the solo events of a time step at the end of the one before. An engine may also let neighbouring stages go on
// together. Where it does so, it says it.
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
  // around the time steps of one call of an engine that keeps its scenes on a device: gem/engine/device/phases.h
  open_call,
  first_solo_events,
  plan,
  last_books,
  close_call
};

/// One time step.
inline constexpr Stage time_step_stages[] = {
    Stage::list,   Stage::candidates, Stage::narrow_phase, Stage::solo_events, Stage::contact_events,
    Stage::gather, Stage::iterate,    Stage::settle,       Stage::books,       Stage::move};

/// Stages that only `coupled` contacts have.
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
