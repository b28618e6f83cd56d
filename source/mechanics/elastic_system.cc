#include <nmm/base/exceptions.h>
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
    if (!elasticity.is_inelastic())
      return;
    AssertThrow(is_linearized,
                InputError("a material is inelastic, which is possible with "
                           "small displacements only",
                           "the static equations of large displacements",
                           "choose another law, or small kinematics"));
    inelastic = std::make_unique<InelasticTerms>(elasticity);
    find_initial_imbalance();
  }


  ElasticSystem::~ElasticSystem() = default;


  void
  ElasticSystem::find_initial_imbalance()
  {
    Vector zero(elastic->initial_solution());
    zero = 0.;
    AssertThrow(inelastic->assemble(zero, /* with_tangent = */ false) ==
                  Deformation::admissible,
                NumericalFailure("The initial stress of a material that yields "
                                 "cannot be brought to its yield surface",
                                 "the undeformed state",
                                 "give an initial stress that is within the "
                                 "material's strength"));
    initial_imbalance = inelastic->residual();
  }


  double
  ElasticSystem::accept_step(const Vector &u)
  {
    if (!inelastic)
      return 0.;
    inelastic->accept(u);
    return inelastic->totals().dissipated;
  }


  void
  ElasticSystem::forget_states()
  {
    if (inelastic)
      inelastic->forget_states();
  }


  void
  ElasticSystem::adapt_penalties(const Vector &u)
  {
    if (!linearized)
      elastic->adapt_penalties(u);
  }


  double
  ElasticSystem::largest_jump() const
  {
    return linearized ? 0. : elastic->largest_jump();
  }


  InelasticTerms *
  ElasticSystem::inelastic_terms() const
  {
    return inelastic.get();
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
    if (linearized)
      return assemble_linearized(u, tangent != Tangent::none);
    const Deformation state = elastic->assemble(u, factor, tangent, increment);
    result.residual         = &elastic->residual();
    result.force_scale      = elastic->force_scale();
    result.tangent          = &elastic->tangent();
    result.is_symmetric     = elastic->tangent_is_symmetric();
    return state;
  }


  Deformation
  ElasticSystem::assemble_linearized(const Vector &u, const bool with_tangent)
  {
    if (!has_stiffness || !has_load)
    {
      const Vector zero = [&]() {
        Vector vector(u);
        vector = 0.;
        return vector;
      }();
      // without loads, because small displacements have no tangent of follower pressure
      if (!has_stiffness)
        (void)elastic->assemble(zero, 0., Tangent::consistent);
      (void)elastic->assemble(zero, factor, Tangent::none);
      load          = elastic->residual();
      scale         = elastic->force_scale();
      has_stiffness = has_load = true;
    }
    owned = u;
    elastic->tangent().vmult(sum, owned);
    // the diagonal entries of constrained unknowns are arbitrary
    elastic->affine_constraints().set_zero(sum);
    energy = 0.5 * (owned * sum);
    sum += load;
    result.residual     = &sum;
    result.force_scale  = scale;
    result.tangent      = &elastic->tangent();
    result.is_symmetric = true;
    if (!inelastic)
      return Deformation::admissible;
    if (inelastic->assemble(u, with_tangent) != Deformation::admissible)
      return Deformation::inverted;
    sum += inelastic->residual();
    sum.add(factor - 1., initial_imbalance);
    energy += inelastic->totals().energy;
    // forces due to initial stress balance each other as loads do
    result.force_scale  = std::hypot(scale, inelastic->totals().force_scale);
    result.is_symmetric = inelastic->totals().n_yielding == 0;
    if (with_tangent)
      result.tangent = &inelastic->add_to(elastic->tangent());
    return Deformation::admissible;
  }


  double
  ElasticSystem::strain_energy() const
  {
    return linearized ? energy : elastic->energies().strain;
  }
} // namespace NMM
