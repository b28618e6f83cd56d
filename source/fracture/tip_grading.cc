#include <nmm/fracture/tip_cover.h>
#include <nmm/fracture/tip_grading.h>

#include <algorithm>

namespace NMM
{
  LocalSize
  grade_towards(const CrackTip &tip,
                const double    growth,
                const double    cell_size,
                const double    smallest)
  {
    // This is one halving less than is possible.
    constexpr double most_halvings = 1 << 19;
    LocalSize        size;
    size.kind  = LocalSize::Kind::point;
    size.point = tip.point;
    size.size = std::max(smallest * tip.free_radius, cell_size / most_halvings);
    size.growth   = growth;
    size.exponent = 5. / 6.;
    size.length   = tip.free_radius;
    return size;
  }


  std::vector<LocalSize>
  sizes_at_tips(const PhysicalMesh &solid,
                const double        growth,
                const double        cell_size,
                const double        smallest)
  {
    std::vector<LocalSize> sizes;
    for (const CrackTip &tip : find_crack_tips(solid))
      if (has_tip_cover(solid, tip))
        // The circle of the cover bounds the free radius.
        sizes.push_back(
          grade_towards(tip, 0.8 * growth, cell_size, 0.4 * growth));
      else
        sizes.push_back(grade_towards(tip, growth, cell_size, smallest));
    return sizes;
  }
} // namespace NMM
