// SPDX-License-Identifier: Apache-2.0
// Edges of CAD models: which are smooth, which are meant to be sharp, and what is asked of which.
#pragma once

#include "patchproof/deadline.h"
#include "patchproof/io/report.h"
#include "patchproof/join/trimmed_join.h"

namespace patchproof {

// The certificate bounds the largest angle along the edge; what an edge above `smooth_below` degrees is depends on its
// smallest angle, which is bounded here.
EdgeClass edge_class_of(const TrimmedJoin& join, const Certificate& certificate, double smooth_below,
                        DeadlineScope::Clock::time_point deadline);

// Of a sharp edge no tangents are asked: C0 instead of C1 and G1, and no angle. Where it is not decided whether the edge is
// sharp throughout, what would fail for its angle is undecided.
// The bounds with what an approximation of the surfaces may add to them and take from them; classes that it leaves open.
Certificate widened(Certificate certificate, const Approximation& by);

Judgement judge_edge(const Certificate& certificate, EdgeClass edge_class, double smooth_below, Request request);

}  // namespace patchproof
