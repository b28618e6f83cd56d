#ifndef nmm_tests_support_block_bars_block_bars_h
#define nmm_tests_support_block_bars_block_bars_h

#include <nmm/dynamics/strength_reduction.h>

#include <array>
#include <support/contact_bars/measurements.h>
#include <vector>

namespace NMM
{
  namespace BlockBars
  {
    using namespace ContactBars;

    /// @name Blocks on slopes with known limits: each adds its measurements, of the bar it is for
    /// @{

    /**
     * Toppling columns on a stepped base (Goodman & Bray, Proc. Spec. Conf. Rock
     * Eng. for Foundations and Slopes, ASCE (1976) 201): the limit friction
     * against that of limit equilibrium.
     */
    struct Toppling
    {
      double youngs_modulus = 1e11;
      /// Pressure over penetration, times 10 m over Young's modulus [-].
      double stiffness = 10.;
      /// First step of the relaxation [s]. With steps of 0.02 s columns stand at 0.977 of the limit.
      double step      = 0.005;
      double tolerance = 0.005;
      double bound     = 0.02;
    };

    void
    topple_columns(const Toppling &toppling, Measurements &measurements);

    /// What the chain of blocks needs at its toe to be in equilibrium [N/m],
    /// and how each block, from the toe up, fails: 0 not, 1 topples, 2 slides.
    double
    toe_force(double friction, std::array<unsigned int, 16> &modes);

    /// Whether the columns can move as @p modes says, without support at the toe: what stands needs
    /// no support, what topples or slides does. Below the limit friction there is more than one
    /// way: from 0.982 of it on column 3 can topple as well as slide, and rounding decides.
    bool
    can_move(double friction, const std::array<unsigned int, 16> &modes);

    /// tan phi at which toe_force() is zero.
    double
    limit_friction_of_columns();


    /**
     * One block on an incline: stable, sliding or toppling, on a map of
     * friction over the incline's tangent and of width over height over it.
     */
    struct InclineMap
    {
      double angle = 30.;
      /// Cells along each axis.
      unsigned int n = 10;
      /// Ratios at the map's ends.
      double lowest = 0.2, highest = 2.2;
      /// Ratios nearer to a boundary than this are not asked for.
      double margin = 0.05;
      double step   = 0.01;
    };

    void
    map_incline(const InclineMap &map, Measurements &measurements);


    /// Factor of safety of slides along given planes, by strength reduction.
    struct Slides
    {
      double tolerance = 0.004;
      double bound     = 0.01;
    };

    /// A wedge on a plane with friction and cohesion.
    void
    slide_wedge(const Slides &slides, Measurements &measurements);

    /// An active block on a steep plane pushes a passive one on a flat one.
    void
    slide_two_blocks(const Slides &slides, Measurements &measurements);


    /// A block on an incline under a motion of the base, against the
    /// integral of a rigid block's equation (Newmark, Geotechnique 15 (1965) 139).
    struct BaseMotion
    {
      double       angle = 15., friction_angle = 25.;
      double       step     = 0.002;
      double       duration = 20.;
      unsigned int seed     = 1;
      double       bound    = 0.01;
    };

    void
    shake_block(const BaseMotion &motion, Measurements &measurements);
    /// @}
  } // namespace BlockBars
} // namespace NMM

#endif
