#ifndef nmm_source_mechanics_nitsche_terms_h
#define nmm_source_mechanics_nitsche_terms_h

#include <mechanics/element_tables.h>
#include <mechanics/local_system.h>
#include <mechanics/weak_points.h>

namespace NMM
{
  namespace internal
  {
    /**
     * What the stress on one side of a weak point gives to the integrand of NitscheTerms, with the
     * derivatives by the displacement gradient H and the jump d. Each provider of stress computes
     * these numbers: Hooke's law and hyperelastic laws by set_elastic(), the mean stress of a
     * conserving step by conserving_flux(), the stress of an inelastic law minus Hooke's by its
     * traction alone.
     */
    struct WeakFlux
    {
      /// The traction t = P N [Pa].
      dealii::Tensor<1, 2> traction;
      /// Q, whose product with grad v is the work on d of the change of the traction [Pa m].
      dealii::Tensor<2, 2> conjugate;
      /// dt_a / dH_kL at [a][2k + L] [Pa].
      double traction_by_gradient[2][4] = {};
      /// dQ_cJ / dH_kL at [2c + J][2k + L] [Pa m], if it is not zero.
      double conjugate_by_gradient[4][4];
      bool   has_conjugate_by_gradient = false;
      /// dQ_cJ / dd_a at [2c + J][a] [Pa].
      double conjugate_by_jump[4][2] = {};

      /// Set dt/dH = A N for the moduli A_iJkL = dP_iJ/dH_kL, stored at [2i + J][2k + L].
      void
      set_traction_derivative(const double (&A)[4][4],
                              const dealii::Tensor<1, 2> &normal);

      /// Set the flux of the potential -t(H) . d of a stress @p P with symmetric moduli A: t = P N,
      /// dt/dH = A N, Q = d . A N, dQ/dd = (A N)^T. The third derivative dQ/dH is not set.
      void
      set_elastic(const dealii::Tensor<2, 2> &P,
                  const double (&A)[4][4],
                  const dealii::Tensor<1, 2> &normal,
                  const dealii::Tensor<1, 2> &d);
    };


    /**
     * The integrand of Nitsche's method at a weak point, for any strain measure and stress. With the
     * jump d = B ([u] - g), tractions t_s and their conjugates Q_s (WeakFlux) of the sides s, and
     * the average {a} = sum_s share_s a_s, the forces are
     * @f[ r(v) = \gamma\,d\cdot[v] - \{t\}\cdot B[v] - \{Q:\nabla v\}, @f]
     * and their derivative in the direction w is
     * @f[ K(v,w) = \gamma\,B[v]\cdot[w] - \Bigl\{\frac{dt}{dH}:\nabla w\Bigr\}\cdot B[v]
     *      - \Bigl\{\nabla v:\Bigl(\frac{dQ}{dH}:\nabla w + \frac{dQ}{dd}\,B[w]\Bigr)\Bigr\}. @f]
     * A stress P with a potential has Q = d . dP/dH N, and the forces are the derivative of
     * @f[ \Pi = \frac{\gamma}{2}|d|^2 - \{t\}\cdot d. @f]
     * Q = 0 gives the forces of a stress whose change does no work on d, or those to the first
     * order in d.
     *
     * Order of calls: set `d`, for each side its flux, then add().
     * Cost of add() with matrix: about 12 n^2 multiplications for n covers.
     */
    struct NitscheTerms
    {
      /// Begin the terms of a point; @p penalty is gamma [Pa/m]. The point must outlive the object.
      NitscheTerms(const WeakPoint &point,
                   unsigned int     n_per_cell,
                   double           penalty)
        : point(point)
        , n_per_cell(n_per_cell)
        , penalty(penalty)
      {
      }

      /// d for the displacements @p u, where @p factor multiplies the prescribed displacement [m].
      dealii::Tensor<1, 2>
      jump(const LocalDisplacement &u, double factor) const;

      /// grad u on a side, plus @p diagonal times I [-].
      dealii::Tensor<2, 2>
      gradient(const LocalDisplacement &u, const unsigned int side) const
      {
        return displacement_gradient(n_per_cell,
                                     u.values + side * n_per_cell,
                                     point.sides[side].gradients);
      }

      /// The force gamma d - B {t} on the jump of v [Pa].
      dealii::Tensor<1, 2>
      force() const;

      /// Compute the derivatives of {t} by the displacements of covers,
      /// [cover][component of {t}][component of the displacement] [Pa/m].
      void
      traction_derivatives(
        double (&derivatives)[LocalSystem::max_covers][2][2]) const;

      /// Add the weight of the point times r, K (if @p local has a matrix) and Pi.
      void
      add(LocalSystem &local) const;

      const WeakPoint     &point;
      unsigned int         n_per_cell;
      double               penalty;
      dealii::Tensor<1, 2> d;
      WeakFlux             fluxes[2];

    private:
      void
      add_matrix(LocalSystem &local) const;
    };
  } // namespace internal
} // namespace NMM

#endif
