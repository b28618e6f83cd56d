#include <nmm/mechanics/elastic_system.h>

#include <cmath>

namespace NMM
{
  ElasticSystem::ElasticSystem(FiniteElasticity &elasticity,
                               const bool        is_linearized)
    : elastic(&elasticity)
    , linearized(is_linearized)
  {
    const CoverSystem &covers = elasticity.cover_system();
    for (Vector *vector : {&owned, &load, &sum})
      vector->reinit(covers.locally_owned_dofs(2), covers.communicator());
  }


  void
  ElasticSystem::set_load_factor(const double load_factor)
  {
    has_load = has_load && load_factor == factor;
    factor   = load_factor;
  }


  double
  ElasticSystem::load_factor() const
  {
    return factor;
  }


  FiniteElasticity &
  ElasticSystem::elasticity() const
  {
    return *elastic;
  }


  bool
  ElasticSystem::is_linearized() const
  {
    return linearized;
  }


  Deformation
  ElasticSystem::assemble(const Vector &u,
                          const Tangent tangent,
                          const Vector *increment)
  {
    if (!linearized)
      return elastic->assemble(u, factor, tangent, increment);

    if (!has_stiffness || !has_load)
    {
      const Vector zero = [&]() {
        Vector vector(u);
        vector = 0.;
        return vector;
      }();
      // without loads: the tangent of follower pressure is none of this theory
      if (!has_stiffness)
        (void)elastic->assemble(zero, 0., Tangent::consistent);
      (void)elastic->assemble(zero, factor, Tangent::none);
      load          = elastic->residual();
      scale         = elastic->force_scale();
      has_stiffness = has_load = true;
    }
    owned = u;
    elastic->tangent().vmult(sum, owned);
    // constrained unknowns have a diagonal entry of their own
    elastic->affine_constraints().set_zero(sum);
    energy = 0.5 * (owned * sum);
    sum += load;
    return Deformation::admissible;
  }


  const ElasticSystem::Vector &
  ElasticSystem::residual() const
  {
    return linearized ? sum : elastic->residual();
  }


  const dealii::TrilinosWrappers::SparseMatrix &
  ElasticSystem::tangent() const
  {
    return elastic->tangent();
  }


  bool
  ElasticSystem::tangent_is_symmetric() const
  {
    return linearized || elastic->tangent_is_symmetric();
  }


  double
  ElasticSystem::force_scale() const
  {
    return linearized ? scale : elastic->force_scale();
  }


  double
  ElasticSystem::strain_energy() const
  {
    return linearized ? energy : elastic->energies().strain;
  }
} // namespace NMM
