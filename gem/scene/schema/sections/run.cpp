// Keys of [run].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_run(SceneTable& t) {
  t.text("run.name", "name of the run, for its output file and in reports", GEM_FIELD(run.name));
  t.number("run.duration_s", "s", {0.0, 1e8}, "simulated time", GEM_FIELD(run.duration_s));
  t.integer("run.seed", {0.0, 9007199254740992.0}, "seed of all random numbers of the field", GEM_FIELD(run.seed));
  t.opt_in = true;
  t.number("run.table_time_s", "s", time_column().range,
           "time in the tables of current, tide and wind at t = 0 of the run", GEM_FIELD(drive.start_time_s));
}

}  // namespace gem::sections
