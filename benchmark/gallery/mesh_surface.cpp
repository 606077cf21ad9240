// SPDX-License-Identifier: GPL-3.0-or-later

#include "gallery_domains.h"
#include "gallery_meshes.h"

#include <weft/spatial/domain/Polyhedral_oracle_3.h>

namespace benchmark {

void mesh_surface(const Gallery_arguments& a, const Spatial_input& input)
{
  const Bounds bounds = bounds_of(a, 1);
  Gallery gallery(a, bounds);
  gallery.set_surface(input.complex);
  Criteria criteria = criteria_of(bounds);
  criteria.topology = input.is_creased();
  add_weft(weft::Polyhedral_oracle_3<Spatial_kernel>(input.complex), criteria, 0, a, gallery);
  const Cgal_polyhedron surface = polyhedron(input.complex);
  Cgal_domain domain(surface);
  if (input.is_creased()) domain.detect_features(input.sharp_angle);
  add_cgal<Cgal_complex>(domain, cgal_criteria(bounds, bounds.size), a, gallery);
  gallery.write_figures(1);
}

} // namespace benchmark
