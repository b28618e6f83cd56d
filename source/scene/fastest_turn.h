#ifndef nmm_source_scene_fastest_turn_h
#define nmm_source_scene_fastest_turn_h

#include <nmm/mechanics/finite_elasticity.h>

namespace NMM
{
  namespace internal
  {
    /// The block that turns fastest.
    struct FastestTurn
    {
      /// Number of the block in the physical mesh; invalid_index if none turns.
      unsigned int block = invalid_index;
      /// Magnitude of its angular velocity [rad/s].
      double rate = 0.;
    };

    /**
     * The block with the largest angular velocity
     * @f[ \omega = \frac{\sum_k (x_k-\bar x)\times(v_k-\bar v)}{\sum_k |x_k-\bar x|^2} @f]
     * of its covers k at the positions x_k = X_k + u_k, without weights: the angular velocity of a
     * rigid motion, whatever its turn so far. @p u [m] and @p v [m/s] are locally relevant. The same
     * on all ranks. Collective.
     */
    FastestTurn
    find_fastest_turn(const CoverSystem              &covers,
                      const FiniteElasticity::Vector &u,
                      const FiniteElasticity::Vector &v);
  } // namespace internal
} // namespace NMM

#endif
