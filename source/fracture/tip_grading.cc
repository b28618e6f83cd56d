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
} // namespace NMM
