#ifndef nmm_source_contact_assembly_point_terms_h
#define nmm_source_contact_assembly_point_terms_h

#include <nmm/contact/surface/surface.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  namespace internal
  {
    /// Dense matrix and forces of one contact point, for the covers of the slave, the master and,
    /// with friction, of the edge of the anchor.
    struct ContactLocalSystem
    {
      static constexpr unsigned int max_covers =
        3 * WeightFunctions::max_per_cell;
      unsigned int n_covers = 0;
      unsigned int covers[max_covers];
      /// Matrix (2 n_covers x 2 n_covers), row-major.
      double matrix[4 * max_covers * max_covers];
      double rhs[2 * max_covers];

      void
      append(const dealii::ArrayView<const unsigned int> more)
      {
        std::copy(more.begin(), more.end(), covers + n_covers);
        n_covers += more.size();
      }

      void
      clear()
      {
        std::fill_n(matrix, 4 * n_covers * n_covers, 0.);
        std::fill_n(rhs, 2 * n_covers, 0.);
      }
    };


    /**
     * Kinematics of a contact point: first and second variations of the gap and the slip by the
     * unknowns d of slave and master. With the slave's position x_s, the master's
     * nearest point x_m(t), a = dx_m/dt, b = d^2x_m/dt^2, its outward normal n,
     * tangent tau = a/|a| and
     * @f$ N_1 = (0, -w_m' n),\ T = (w_s\tau, -w_m\tau),\ h = a^2 - g\,b\cdot n @f$:
     * @f[ \delta g = N\cdot\delta d,\quad N = (w_s n, -w_m n),\qquad
     *     \delta t = D\cdot\delta d,\quad D = (|a| T - g N_1)/h, @f]
     * @f[ \Delta\delta g = \tfrac{h}{a^2}(D\otimes N_1 + N_1\otimes D)
     *     + \tfrac{g}{a^2} N_1\otimes N_1 - \tfrac{h\,b\cdot n}{a^2} D\otimes D @f]
     * (Wriggers, Computational Contact Mechanics, 2nd ed., section 4.2 and 6.4, in this
     * form for curved edges).
     */
    struct ContactKinematics
    {
      static constexpr unsigned int max = 2 * ContactLocalSystem::max_covers;

      ContactKinematics(const ContactSurface::WeightValues &slave,
                        const ContactSurface::Weights      &master,
                        const ContactSurface::Place        &place,
                        double                              gap,
                        bool                                with_friction);

      /// Remove the terms of second order: normals, tangents and nearest points are fixed.
      void
      freeze();

      unsigned int         n_slave, n_master, n;
      dealii::Tensor<1, 2> normal, tangent;
      double               gap, length, bending, h;
      double               N[max], N1[max], D[max], T[max], T1[max];

      /// Rotation of the tangent tau towards the normal n: C . delta d [rad].
      double C[max];
    };


    /// Forces of a contact point and their derivatives.
    struct ContactTraction
    {
      /// Pressure and its derivative by -gap, both times the weight [N/m] and [N/m^2].
      double pressure = 0., normal_stiffness = 0.;
      /// Derivative of the pressure, times the weight, by the unknowns of slave and master if it
      /// depends on more than the gap; else null.
      const double *pressure_change = nullptr;
      /// Shear, times the weight [N/m]; positive along tau on the master.
      double shear = 0.;
      /// Derivative of the shear by the distance from the anchor [N/m^2]: the stiffness of the
      /// spring for points that stick, the weakening of the strength for points that slide.
      double shear_stiffness = 0.;
      /// For time steps: derivative of the shear by half of the slip, which replaces that by the
      /// distance from the anchor, and the derivative of half of the slip by the unknowns of slave
      /// and master.
      double        shear_by_half_slip = 0.;
      const double *half_slip_change   = nullptr;
      /// Derivative of the shear by the pressure for points that slide [-].
      double shear_over_pressure = 0.;
      /// Derivative of the pressure, times the weight, by the tangential distance from the anchor
      /// for laws with dilation [N/m^2].
      double pressure_by_slip = 0.;
      /// Normal distance n . (x_s - x_0) from the anchor x_0 [m].
      double normal_distance = 0.;
      /// Energy of the springs [J/m].
      double energy = 0.;
      /// For time steps: motion of the slave relative to the master [m]; derivatives of the mean
      /// pressure, times the weight, by the gap at the end, by the relative normal motion, and
      /// where faces turn [N/m^2].
      dealii::Tensor<1, 2> motion;
      double pressure_by_gap = 0., pressure_by_opening = 0., by_turning = 0.;

      /// Bound on the derivative of both by the distance of the faces [N/m^2].
      double
      stiffness() const
      {
        return (1. + std::abs(shear_over_pressure)) *
                 (normal_stiffness + std::abs(pressure_by_slip) +
                  std::abs(pressure_by_gap) + std::abs(pressure_by_opening) +
                  by_turning) +
               shear_stiffness + std::abs(shear_by_half_slip);
      }
    };


    /**
     * Add forces and, if @p with_tangent, tangent to @p local:
     * @f[ r = -p N + q T,\qquad
     *     K = -N\otimes\Delta p - p\,\Delta\delta g
     *         + T\otimes\Delta q + q\,(N\otimes C + T_1\otimes D)
     *         - N\otimes\partial_s p\,\Delta s, @f]
     * s being the distance along tau from the anchor, and
     * @f$ \Delta p = -\epsilon N @f$ unless the traction has pressure_change.
     * @p stick: weights at the anchor, whose covers follow those of slave and master in @p local.
     * It is null without friction, and has no weights and covers if nothing depends on the anchor.
     */
    void
    add_contact_point(const ContactKinematics            &kinematics,
                      const ContactTraction              &traction,
                      const ContactSurface::WeightValues *slave,
                      const ContactSurface::WeightValues *stick,
                      bool                                with_tangent,
                      ContactLocalSystem                 &local);
  } // namespace internal
} // namespace NMM

#endif
