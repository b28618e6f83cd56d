#ifndef nmm_source_mechanics_finite_terms_h
#define nmm_source_mechanics_finite_terms_h

#include <nmm/materials/hyperelastic_law.h>

#include <mechanics/edge_tables.h>
#include <mechanics/element_tables.h>
#include <mechanics/local_system.h>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The law of each region of the physical mesh.
    using RegionLaws = std::vector<std::shared_ptr<const HyperelasticLaw>>;


    /// Displacements of the covers of an element, or of two one after the other
    /// [m].
    struct LocalDisplacement
    {
      double values[LocalSystem::max_covers][2];

      /// Read those of @p covers from @p nodal (two per cover), from position
      /// @p first on.
      void
      gather(const dealii::ArrayView<const unsigned int> &covers,
             const std::vector<double>                   &nodal,
             const unsigned int                           first = 0)
      {
        for (unsigned int i = 0; i < covers.size(); ++i)
        {
          values[first + i][0] = nodal[2 * covers[i]];
          values[first + i][1] = nodal[2 * covers[i] + 1];
        }
      }
    };


    /// Largest |d| Lambda at which Tangent::robust is the whole derivative [-].
    constexpr double close_jump = 0.1;


    /// Add sum over (J, L) of weight g_iJ A_cJdL g_jL to the blocks j >= i of a
    /// matrix of @p n_per_cell covers.
    void
    add_stiffness(unsigned int n_per_cell,
                  double       weight,
                  const double (*gradients)[2],
                  const double (&A)[4][4],
                  LocalSystem &local);

    /// Fill in the blocks j < i of a symmetric matrix.
    void
    symmetrize(LocalSystem &local);


    /**
     * Internal forces of an element, into local.rhs, and their derivative:
     * @f[ r_{ic} = \int P_{cJ}\,\partial_J w_i, \qquad
     *     K_{ic,jd} = \int \partial_J w_i\,A_{cJdL}\,\partial_L w_j @f]
     * Adds to an empty @p local. With @p increment, the displacement of the last
     * iteration, the stress in the geometric part of K is not that of u but the
     * one linearized in the last iteration, S(u) - C : H^T H / 2 with
     * H = grad(increment): the mixed integration point Newton method (Magisano,
     * Leonetti & Garcea, CMAME 313 (2017) 986), which spares a good part of the
     * iterations where large rotations come with small strains.
     */
    Deformation
    add_volume_terms(const HyperelasticLaw     &law,
                     unsigned int               n_per_cell,
                     const ElementTables::View &table,
                     const LocalDisplacement   &u,
                     const LocalDisplacement   *increment,
                     bool                       with_tangent,
                     LocalSystem               &local,
                     double                    &energy);


    /**
     * Displacement condition or tie at a point by the potential form of
     * Nitsche's method: with the jump d = B (u - g), the mean stress
     * {P} = sum_s share_s P_s and G = d (x) N
     * @f[ \Pi = \int -\{P\}:G + \frac{\gamma}{2}|d|^2. @f]
     * Residual and tangent are its derivatives (B symmetric, a projection):
     * @f[ r(v) = \int -\{A[\nabla v]\}:G - \{P\}:(Bv\otimes N)
     *      + \gamma\,d\cdot v, @f]
     * @f[ K(v,w) = \int -\{D_G A[\nabla v,\nabla w]\}
     *      - \{A[\nabla v]\}:(Bw\otimes N) - \{A[\nabla w]\}:(Bv\otimes N)
     *      + \gamma\,Bv\cdot w. @f]
     * @p prescribed is B g at the current load factor, @p growth multiplies
     * gamma. For Tangent::robust see FiniteElasticity::assemble(). The energy
     * is added to, and @p largest_jump raised to |d| in units of 1 / Lambda.
     */
    Deformation
    add_weak_point(const EdgeTables::WeakPoint &point,
                   const RegionLaws            &region_to_law,
                   unsigned int                 n_per_cell,
                   const dealii::Tensor<1, 2>  &prescribed,
                   double                       growth,
                   const LocalDisplacement     &u,
                   Tangent                      tangent,
                   LocalSystem                 &local,
                   double                      &energy,
                   double                      &largest_jump);


    /// Moduli A at a weak point over those at rest, each by the largest sum of
    /// absolute values in a row; the largest of all sides, 1 if not admissible.
    double
    growth_of_moduli(const EdgeTables::WeakPoint &point,
                     const RegionLaws            &region_to_law,
                     unsigned int                 n_per_cell,
                     const LocalDisplacement     &u);


    /**
     * Minus the force of follower pressure, -p cof(F) N per reference length.
     * With the tangent t = F T of the deformed edge, cof(F) N = (t_y, -t_x):
     * only derivatives along the edge take part, and the tangent is not
     * symmetric. @p factor times the point's pressure acts.
     */
    void
    add_follower_point(const EdgeTables::FollowerPoint &point,
                       unsigned int                     n_per_cell,
                       double                           factor,
                       const LocalDisplacement         &u,
                       bool                             with_tangent,
                       LocalSystem                     &local);


    /// The spring of a fixed point (12) in its element; @p factor times its
    /// displacement is prescribed. Returns the spring's energy [J/m].
    double
    add_fixed_point(const CoverSystem       &covers,
                    unsigned int             element,
                    const FixedPoint        &fixed,
                    double                   stiffness,
                    double                   factor,
                    const LocalDisplacement &u,
                    bool                     with_tangent,
                    LocalSystem             &local);
  } // namespace internal
} // namespace NMM

#endif
