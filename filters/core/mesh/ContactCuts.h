#pragma once

#include "core/mesh/Facets.h"

/// \file ContactCuts.h
/// Facets end where walls stand on them.

namespace vantage
{

/// Cuts facets along the lines where others meet them: a floor that reaches below the wall between
/// two rooms becomes a floor of each room. An element on both sides of a wall has one radiance, so
/// light would leak through however fine the elements are; the meshing of shadows calls these the
/// discontinuities of order zero (Heckbert 1992; Lischinski, Tampieri, Greenberg 1992).
///
/// A facet is cut only where what meets it covers most of the way across: a table leg, a cupboard
/// or a picture frame does not cut the floor or the wall. Pieces keep polygons and materials.
/// Contacts within FacetSet::Tolerance() of the border, or lying in the plane of the facet, do not
/// count. The pieces depend on geometry only, their order on that of the facets. O(n) for facets of
/// like size that each meet a few; O(n k) where each meets k.
FacetSet CutAtContacts(FacetSet facets);

} // namespace vantage
