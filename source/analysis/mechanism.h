#ifndef nmm_source_analysis_mechanism_h
#define nmm_source_analysis_mechanism_h

#include <nmm/contact/assembly/statics.h>
#include <nmm/mechanics/block_motion.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/quadrature/element_quadrature.h>

#include <string>

namespace NMM
{
  namespace internal
  {
    /// The reason why a load step with contact has no solution.
    struct Mechanism
    {
      /// Whether a block has moved away from the faces around it.
      bool does_anything_move = false;
      /// Says which block moves and how, or that none does: a sentence without its full stop.
      std::string description;
    };

    /**
     * Finds the mechanism from the @p motions of blocks between the last equilibrium and the end of
     * the search for the next one. If nothing holds a block, the tangent is singular up to
     * rounding, and the search moves the block further than its own size and than @p reach [m], the
     * distance within which faces are searched: 1e4 to 1e20 m in all scenes that were tried.
     * Blocks that are held moved by elastic displacements of 1e-8 m there. A block that is not held
     * slides in the direction of its translation t, or turns about the point
     * @f[ X_c + (-t_y, t_x)/\omega. @f]
     *
     * The search may move it in this or in the opposite direction. @p power is the work of the
     * increment of loads in this motion [J/m]. Blocks move in the direction in which it is
     * positive.
     */
    Mechanism
    find_mechanism(const std::vector<BlockMotion> &motions,
                   double                          power,
                   double                          reach);


    /// Says how the block with the largest of the @p motions, multiplied by @p sign, moves, and how
    /// many move with it: a sentence without its full stop.
    std::string
    describe(std::vector<BlockMotion> motions, double sign);


    /// Says which block has moved most from the displacements @p begin to @p end [m], of the unknowns
    /// that this process owns, and how: a sentence without its full stop, see describe().
    std::string
    describe_motion(const CoverSystem              &covers,
                    const ElasticityProblem        &problem,
                    const QuadratureCollection     &quadrature,
                    const FiniteElasticity::Vector &begin,
                    const FiniteElasticity::Vector &end);


    /// @throws NumericalFailure which says that a relaxation from @p begin has moved too far, to @p end,
    /// and what has moved; the arguments are those of describe_motion().
    [[noreturn]] void
    refuse_motion(const CoverSystem              &covers,
                  const ElasticityProblem        &problem,
                  const QuadratureCollection     &quadrature,
                  const FiniteElasticity::Vector &begin,
                  const FiniteElasticity::Vector &end);


    /**
     * Finds the mechanism after @p statics, the loading of @p solid, has failed. @p last is the
     * load factor of the last equilibrium [-]. If the search for an equilibrium has moved no block
     * far, the mechanism is that of rigid blocks, see find_collapse(): a block that topples is held
     * at its corner, so that the search need not run away. On return the last assembly is
     * that of this equilibrium.
     */
    Mechanism
    find_mechanism(const ContactStatics       &statics,
                   SolidTerm                  &solid,
                   Contact                    &contact,
                   double                      last,
                   const QuadratureCollection &quadrature);
  } // namespace internal
} // namespace NMM

#endif
