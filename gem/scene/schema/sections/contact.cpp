// Keys of [contact].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_contact(SceneTable& t) {
  t.choice("contact.solver", {"independent", "coupled", "compliant"},
           "independent: each event of a time step once, as in the paper; coupled: all events together, of rigid ice; "
           "compliant: ice that springs and crushes, in substeps",
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
  t.counts_with = {"contact.solver", "compliant"};
  t.number("contact.face_stiffness_Pa", "Pa", {1e5, 1e12},
           "compliant: stiffness of a face of ice on a face, over the thickness of the thinner floe; the number of "
           "substeps grows with its root",
           GEM_FIELD(contact.face_stiffness_Pa));
  t.number("contact.damping_ratio", "", {0.0, 2.0}, "compliant: damping ratio of a face below crushing",
           GEM_FIELD(contact.damping_ratio));
  t.number("contact.structure_stiffness_N_per_m", "N/m", {1e5, 1e13},
           "compliant: stiffness of a structure on a wall, where no ice is between them",
           GEM_FIELD(contact.structure_stiffness_N_per_m));
  t.counts_with = {};
}

}  // namespace gem::sections
