#ifndef nmm_source_scene_mechanism_h
#define nmm_source_scene_mechanism_h

#include <nmm/contact/contact_statics.h>
#include <nmm/mechanics/block_motion.h>
#include <nmm/quadrature/element_quadrature.h>

#include <string>

namespace NMM
{
  namespace internal
  {
    /// Why a load step with contact has no solution.
    struct Mechanism
    {
      /// A block has left the faces around it.
      bool does_anything_move = false;
      /// Which block gives way and how, or that none does: a sentence without its full stop.
      std::string description;
    };

    /**
     * From the motions of blocks between the last equilibrium and where the search for the next
     * one ended. Where nothing holds a block, the tangent is singular but for rounding, and the
     * search takes it further than its own size and than @p reach, within which faces are looked for
     * [m]: 1e4 to 1e20 m in all scenes that were tried. What is held moves by its elastic part of
     * the load step, 1e-8 m there. A block that gives way slides in the direction
     * of its translation t, or turns about the point
     * @f[ X_c + (-t_y, t_x)/\omega. @f]
     *
     * The search may take it either way. @p power is that of the increments of loads
     * in this motion [J/m]: blocks go the way in which it is positive.
     */
    Mechanism
    find_mechanism(std::vector<BlockMotion> motions,
                   double                   power,
                   double                   reach);


    /**
     * The same after @p statics, the loading of @p system, has failed; @p last is the load factor of
     * the last equilibrium. The last assembly is then that of this equilibrium.
     */
    Mechanism
    find_mechanism(const ContactStatics       &statics,
                   ElasticSystem              &system,
                   double                      last,
                   const CoverSystem          &covers,
                   const ElasticityProblem    &problem,
                   const QuadratureCollection &quadrature,
                   double                      reach);
  } // namespace internal
} // namespace NMM

#endif
