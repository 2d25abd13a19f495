// Contact of two convex outlines: separating axes, the chord of an overlap, and the facing stretch of two faces.
//
// Outlines are in world axes relative to their own centroids; `offset` is the vector from A's centroid to B's. All
// results are relative to A's centroid; normals point from A to B.
#pragma once

#include "gem/geometry/chord_contact.h"
#include "gem/geometry/face_contact.h"
