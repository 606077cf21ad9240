// SPDX-License-Identifier: GPL-3.0-or-later
//
// Smoothers (Tournois 2009, sec. 3.2.1.5): Natural ODT, ODT and Lloyd. A smoother looks at the cells around a vertex
// and returns the position that the vertex should have, not projected yet. Lengths, areas and volumes are measured in
// the metric of a sizing field that is given at vertices and linear between them, by quadrature of the second degree; a
// constant field gives the uniform formulas back.

#ifndef WEFT_SPATIAL_OPTIMISE_SMOOTHERS_3_H
#define WEFT_SPATIAL_OPTIMISE_SMOOTHERS_3_H

#include <weft/spatial/optimise/Lloyd_3.h>
#include <weft/spatial/optimise/Natural_odt_3.h>
#include <weft/spatial/optimise/Smoothing_context_3.h>

#endif // WEFT_SPATIAL_OPTIMISE_SMOOTHERS_3_H
