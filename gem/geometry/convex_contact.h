// Contact of two convex outlines: the separating axis, the chord of an overlap, and the touching stretch of two faces.
//
// Outlines are given turned into world axes about their own centroid; B's centroid stands at `offset` from A's.
// All results are relative to A's centroid; normals point from A to B.
#pragma once

#include "gem/geometry/chord_contact.h"
#include "gem/geometry/face_contact.h"
