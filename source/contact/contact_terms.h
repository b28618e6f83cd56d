#ifndef nmm_source_contact_contact_terms_h
#define nmm_source_contact_contact_terms_h

#include <nmm/contact/contact_surface.h>

#include <algorithm>

namespace NMM
{
  namespace internal
  {
    /// Dense matrix and forces of one contact point: covers of the slave, the
    /// master and, with friction, of the edge on which the point sticks.
    struct ContactLocalSystem
    {
      static constexpr unsigned int max_covers =
        3 * WeightFunctions::max_per_cell;
      unsigned int n_covers = 0;
      unsigned int covers[max_covers];
      /// (2 n_covers x 2 n_covers), row-major.
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
     * A contact point: how the gap and the slip depend on the unknowns d of slave
     * and master, to second order. With the slave's position x_s, the master's
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

      /// Normals, tangents and places stay what they are: no terms of second order.
      void
      freeze();

      unsigned int         n_slave, n_master, n;
      dealii::Tensor<1, 2> normal, tangent;
      double               gap, length, bending, h;
      double               N[max], N1[max], D[max], T[max], T1[max];

      /// tau turns towards n by C . delta d / 1.
      double C[max];
    };


    /// What a point exerts.
    struct ContactTraction
    {
      /// Pressure >= 0 and its derivative by -gap, both times the weight [N/m]
      /// and [N/m^2].
      double pressure = 0., normal_stiffness = 0.;
      /// Derivative of the pressure, times the weight, by the unknowns of slave and
      /// master where it depends on more than the gap; else null.
      const double *pressure_change = nullptr;
      /// Shear, positive along tau on the master, times the weight [N/m].
      double shear = 0.;
      /// Derivative of the shear by the distance from where it sticks: the spring's stiffness
      /// where it sticks, what a strength that depends on the slip loses where it slides [N/m^2].
      double shear_stiffness = 0.;
      /// In a time step: what depends on half of the slip instead of on the distance from
      /// where it sticks, and the derivative of that half by the unknowns of slave
      /// and master.
      double        shear_by_half_slip = 0.;
      const double *half_slip_change   = nullptr;
      /// Sliding: d shear / d pressure.
      double shear_over_pressure = 0.;
      /// Dilation: derivative of the pressure, times the weight, by the distance
      /// along tau from where it sticks [N/m^2].
      double pressure_by_slip = 0.;
      /// n . (x_s - x_0), x_0 being where it sticks [m].
      double normal_distance = 0.;
    };


    /**
     * Add forces and, if @p with_tangent, tangent to @p local:
     * @f[ r = -p N + q T,\qquad
     *     K = -N\otimes\Delta p - p\,\Delta\delta g
     *         + T\otimes\Delta q + q\,(N\otimes C + T_1\otimes D)
     *         - N\otimes\partial_s p\,\Delta s, @f]
     * s being the distance along tau from where it sticks, and
     * @f$ \Delta p = -\epsilon N @f$ unless the traction has another change.
     * @p stick: weights at the place where it sticks, covers after those of
     * slave and master; null without friction, without weights and covers if nothing
     * depends on that place.
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
