// The list of all events: solo events act on one body, pair events on two. Engines include this file and no other law.
#pragma once

#include "gem/events/crushing.h"         // pair: closed-form peak of an impact
#include "gem/events/current_drag.h"     // solo: water drag on a floe
#include "gem/events/elastic_contact.h"  // pair: static stress
#include "gem/events/impact.h"           // pair: plastic impact with friction
#include "gem/events/mass_reduction.h"   // pair: mass reduction factor, effective mass
#include "gem/events/mooring.h"          // solo: platform on its mooring
#include "gem/events/motion.h"           // solo: motion
#include "gem/events/platform_drag.h"    // solo: water drag on the platform
