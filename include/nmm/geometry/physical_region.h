#ifndef nmm_geometry_physical_region_h
#define nmm_geometry_physical_region_h

#include <deal.II/base/point.h>

#include <vector>

namespace NMM
{
  /// A bounded, connected piece of the solid that no curve crosses.
  struct PhysicalRegion
  {
    /// Index into PhysicalMesh::material_names(), or invalid_index if none was given.
    unsigned int material;
    /// Block that the region belongs to.
    unsigned int block;
    /// Area [m^2].
    double area;
    /// A point inside the region [m]; it also decides about Geometry::add_material_region().
    dealii::Point<2> inside;
    /// Whether the region is thinner than a millionth of its length.
    bool is_sliver = false;
  };


  /// Parts of joints with the same region on both sides, which bound no block.
  struct DanglingEnds
  {
    /// Number of crack tips that are kept: points inside the solid where one piece of a joint
    /// ends.
    unsigned int n_kept = 0;
    /// Number of crack tips that are removed, see Curve::drops_ends.
    unsigned int n_dropped = 0;
    /// Length of the parts that are kept [m].
    double length_kept = 0.;
    /// Length of the parts that are removed [m].
    double length_dropped = 0.;
    /// Positions of the crack tips that are kept [m].
    std::vector<dealii::Point<2>> tips;
  };
} // namespace NMM

#endif
