#ifndef nmm_source_mechanics_floating_blocks_h
#define nmm_source_mechanics_floating_blocks_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <mechanics/curve_conditions.h>
#include <mechanics/point_terms.h>

namespace NMM
{
  namespace internal
  {
    /**
     * Before solving: does every connected piece of the solid (elements joined
     * or tied) have displacement conditions and fixed points that suppress its
     * two translations and its rotation? Per piece, the conditions are
     * evaluated on the three rigid-body modes, rotation scaled to the piece's
     * size; a mode r floats if the matrix sum_q (B r)(B r)^T over the points
     * where conditions hold is singular to 1e-13 of its largest eigenvalue. Held
     * lengths down to some 1e-6 of the piece's size count. Cost: O(elements).
     *
     * @throws NumericalFailure naming the block, a point inside, its material
     * and the motion that is free; on all ranks alike.
     */
    void
    check_no_block_floats(const CoverSystem       &covers,
                          const ElasticityProblem &problem,
                          const CurveConditions   &conditions,
                          const PointTerms        &point_terms);
  } // namespace internal
} // namespace NMM

#endif
