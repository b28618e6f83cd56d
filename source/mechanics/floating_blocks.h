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
     * Check before solving that in every connected piece of the solid (elements that are joined
     * or tied) displacement conditions and fixed points suppress both
     * translations and the rotation. For each piece, the conditions are
     * evaluated for the three rigid-body modes r, with the rotation scaled by the size of the
     * piece. A rigid motion is free if the matrix sum_q (B r)(B r)^T over the points q
     * where conditions hold has an eigenvalue below 1e-13 of its largest one. Conditions are
     * recognized on lengths down to some 1e-6 of the size of the piece. Cost: O(elements).
     *
     * @throws NumericalFailure on all ranks, naming the block, a point inside, its material
     * and the free motion.
     */
    void
    check_no_block_floats(const CoverSystem       &covers,
                          const ElasticityProblem &problem,
                          const CurveConditions   &conditions,
                          const PointTerms        &point_terms);
  } // namespace internal
} // namespace NMM

#endif
