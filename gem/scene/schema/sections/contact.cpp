// Keys of [contact].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_contact(SceneTable& t) {
  t.choice("contact.solver", {"independent", "coupled"},
           "independent: each event of a time step once, as in the paper; coupled: all events together",
           GEM_FIELD(contact.solver));
  t.choice("contact.manifold", {"chord_middle", "chord_ends"}, "points where a contact acts",
           GEM_FIELD(contact.manifold));
  t.choice("contact.friction_law", {"one_step", "fixed_direction"},
           "one_step: Coulomb's law for the velocity after the event; fixed_direction: against the motion before it, "
           "as in the paper",
           GEM_FIELD(contact.friction_law));
  t.flag("contact.crushing_limit", "coupled: whether the crushing force of the smaller body limits an event",
         GEM_FIELD(contact.crushing_limit));
  t.number("contact.elastic_stiffness_N_per_m", "N/m", {0.0, 1e12},
           "independent: stiffness of the static event; 0: none", GEM_FIELD(contact.elastic_stiffness_N_per_m));
}

}  // namespace gem::sections
