#ifndef nmm_source_contact_diagnostics_collapse_h
#define nmm_source_contact_diagnostics_collapse_h

#include <nmm/contact/contact.h>
#include <nmm/mechanics/block_motion.h>
#include <nmm/mechanics/solid_term.h>

#include <array>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Rigid blocks under loads, held by forces of bounded size. Each force has two blocks, to which
     * it is applied in opposite directions, a direction g of unit size at a place, and bounds of its
     * size. The loads have an equilibrium if forces within the bounds balance them. Otherwise the
     * difference between the loads and the nearest forces is the force that starts a mechanism: with
     * the mass matrix M, the loads P and the forces G lambda
     * @f[ \min_\lambda \tfrac12 v\cdot M v,\qquad v = M^{-1}(P + G\lambda),
     *     \qquad \lambda_\mathrm{min}\le\lambda\le\lambda_\mathrm{max}. @f]
     * The optimal v is the mechanism of limit analysis that these forces do not resist enough: the
     * loads have the positive power P . v there (Moreau; for friction with an associated flow rule,
     * which bounds all others from above). Masses are areas, so that v is the acceleration of
     * blocks of the density 1. The minimum is found by projected Gauss-Seidel iterations.
     */
    class RigidBlocks
    {
    public:
      /// Translation (x, y) and rotation about the centroid.
      using Rigid = std::array<double, 3>;

      /// Take centroids, areas and radii of gyration of all blocks.
      explicit RigidBlocks(const std::vector<BlockMotion> &blocks);

      /// Add a force [N/m] along @p direction at @p place, on @p first and in the opposite direction
      /// on @p second, which is invalid_index for what does not move.
      void
      add_force(unsigned int                first,
                unsigned int                second,
                const dealii::Point<2>     &place,
                const dealii::Tensor<1, 2> &direction,
                double                      least,
                double                      most);

      /// The mechanism under the @p loads of all blocks (two forces and the moment about the
      /// centroid); empty if forces balance them.
      std::vector<Rigid>
      find_mechanism(const std::vector<Rigid> &loads) const;

    private:
      struct Force
      {
        unsigned int first, second;
        Rigid        on_first, on_second;
        double       least, most, inverse_mass;
      };

      std::vector<BlockMotion> blocks;
      std::vector<Rigid>       inverse_masses;
      std::vector<Force>       forces;
    };


    /**
     * The mechanism by which rigid blocks collapse under the loads of the load factor @p factor:
     * blocks in contact as at the equilibrium @p u, with the strengths of their laws, and held by
     * displacement conditions, fixed points and ties. Returns the motions of all blocks, up to a
     * common factor, or nothing if the rigid blocks can be in equilibrium, and on several ranks. The
     * contact is left at @p u.
     */
    std::vector<BlockMotion>
    find_collapse(SolidTerm                      &solid,
                  Contact                        &contact,
                  const SolidTerm::Vector        &u,
                  const std::vector<BlockMotion> &blocks,
                  double                          factor);
  } // namespace internal
} // namespace NMM

#endif
