#ifndef nmm_source_geometry_loops_h
#define nmm_source_geometry_loops_h

#include <nmm/base/types.h>
#include <nmm/geometry/curve.h>

#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// A closed chain of curves of one role.
    struct Loop
    {
      CurveRole                 role;
      std::vector<unsigned int> curves;
      /// The material that its curves name, or empty.
      std::string material;
    };

    struct Loops
    {
      std::vector<Loop> loops;
      /// Loop of each curve; invalid_index for joints and open interfaces.
      std::vector<unsigned int> curve_to_loop;
    };

    /**
     * Chain boundaries, holes and interfaces into loops.
     *
     * A closed curve is a loop. Open boundaries and holes are joined at exactly coinciding ends, in
     * either direction. Where more than two curves meet, the next one in the order of @p curves
     * follows, so that the sides of a domain that touches another one at a corner should be listed
     * one after the other. A loop never passes the same end point twice. Open interfaces are
     * chained only with others of the same name, and only if all of these close.
     *
     * @throws InputError for an open boundary or hole, for sides of one loop that name different
     * materials, and for an open interface with a material.
     *
     * Cost: O(n log n), but O(n^2) for the search of the nearest loose end in an error message.
     */
    Loops
    find_loops(const std::vector<Curve> &curves);
  } // namespace internal
} // namespace NMM

#endif
