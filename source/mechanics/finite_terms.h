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


    /// Displacements of the covers of an element, or of two elements one after the other
    /// [m].
    struct LocalDisplacement
    {
      double values[LocalSystem::max_covers][2];

      /// Read the displacements of @p covers from @p nodal and store them
      /// from position @p first on.
      void
      gather(const dealii::ArrayView<const unsigned int> &covers,
             const std::vector<dealii::Tensor<1, 2>>     &nodal,
             const unsigned int                           first = 0)
      {
        for (unsigned int i = 0; i < covers.size(); ++i)
          for (unsigned int c = 0; c < 2; ++c)
            values[first + i][c] = nodal[covers[i]][c];
      }
    };


    /// Largest |d| Lambda up to which Tangent::robust is the full derivative [-].
    constexpr double close_jump = 0.1;


    /**
     * Add the internal forces of an element to local.rhs and their derivative to local.matrix:
     * @f[ r_{ic} = \int P_{cJ}\,\partial_J w_i, \qquad
     *     K_{ic,jd} = \int \partial_J w_i\,A_{cJdL}\,\partial_L w_j @f]
     * @p local must be zero before. @p increment, if not null, is the displacement of the last
     * iteration. The stress in the geometric part of K is then not that of u but the
     * one linearized in the last iteration, S(u) - C : H^T H / 2 with
     * H = grad(increment). This is the mixed integration point Newton method (Magisano,
     * Leonetti & Garcea, CMAME 313 (2017) 986), which saves many
     * iterations for large rotations with small strains. The strain energy is added to
     * @p energy [J/m].
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
     * Add the terms of a displacement condition or tie at a point by the potential form of
     * Nitsche's method. With the jump d = B (u - g), the mean stress
     * {P} = sum_s share_s P_s and G = d (x) N, the potential is
     * @f[ \Pi = \int -\{P\}:G + \frac{\gamma}{2}|d|^2. @f]
     * Residual and tangent are its derivatives (B symmetric, a projection):
     * @f[ r(v) = \int -\{A[\nabla v]\}:G - \{P\}:(Bv\otimes N)
     *      + \gamma\,d\cdot v, @f]
     * @f[ K(v,w) = \int -\{D_G A[\nabla v,\nabla w]\}
     *      - \{A[\nabla v]\}:(Bw\otimes N) - \{A[\nabla w]\}:(Bv\otimes N)
     *      + \gamma\,Bv\cdot w. @f]
     * @p prescribed is B g at the current load factor, and @p growth multiplies
     * gamma. For Tangent::robust see FiniteElasticity::assemble(). The potential is added to
     * @p energy [J/m]. @p largest_jump becomes |d| Lambda [-] if that is larger.
     */
    Deformation
    add_weak_point(const WeakPoint            &point,
                   const RegionLaws           &region_to_law,
                   unsigned int                n_per_cell,
                   const dealii::Tensor<1, 2> &prescribed,
                   double                      growth,
                   const LocalDisplacement    &u,
                   Tangent                     tangent,
                   LocalSystem                &local,
                   double                     &energy,
                   double                     &largest_jump);


    /// Norm of the moduli A at a weak point divided by that of the undeformed state [-], the
    /// largest ratio of all sides. The norm is the largest sum of absolute values in a row. 1 if
    /// the deformation is not admissible.
    double
    growth_of_moduli(const WeakPoint         &point,
                     const RegionLaws        &region_to_law,
                     unsigned int             n_per_cell,
                     const LocalDisplacement &u);


    /**
     * Add minus the force of follower pressure, where the force is -p cof(F) N per reference
     * length. With the tangent t = F T of the deformed edge, cof(F) N = (t_y, -t_x). So
     * only derivatives along the edge are needed, and the tangent matrix is not
     * symmetric. The pressure of the point is multiplied by @p factor.
     */
    void
    add_follower_point(const EdgeTables::FollowerPoint &point,
                       unsigned int                     n_per_cell,
                       double                           factor,
                       const LocalDisplacement         &u,
                       bool                             with_tangent,
                       LocalSystem                     &local);


    /// Add the spring of a fixed point (12), whose displacement is multiplied by @p factor, to the
    /// system of its element. Returns the energy of the spring [J/m].
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
