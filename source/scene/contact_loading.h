#ifndef nmm_source_scene_contact_loading_h
#define nmm_source_scene_contact_loading_h

#include <nmm/mechanics/elastic_system.h>
#include <nmm/quadrature/element_quadrature.h>

#include <memory>
#include <scene/contact_analysis.h>

namespace NMM
{
  namespace internal
  {
    /**
     * Loading of elastic blocks in contact, in small displacements, to load factors that are not
     * known beforehand. A load factor above the last one continues the loading; a smaller one
     * begins anew from zero, since friction remembers: in one step, unless the scene has load steps
     * of its own.
     *
     * Lifetime: the arguments must outlive this object.
     */
    class ContactLoading
    {
    public:
      using Vector = ElasticSystem::Vector;

      ContactLoading(const Scene                             &scene,
                     const CoverSystem                       &covers,
                     const QuadratureCollection              &quadrature,
                     const dealii::AffineConstraints<double> &constraints,
                     const ElasticityProblem                 &problem,
                     ContactAnalysis                         &contact);

      /// Displacements [m], locally relevant, valid until the next call. The contact analysis has
      /// taken the state. @throws NumericalFailure if there is no equilibrium, with the block that
      /// gives way.
      const Vector &
      solve(double load_factor);

    private:
      const Scene                &scene;
      const CoverSystem          &covers;
      const QuadratureCollection &quadrature;
      const ElasticityProblem    &problem;
      ContactAnalysis            &contact;
      FiniteElasticity            elasticity;
      ElasticSystem               system;
      /// The loading that goes on; null: none has begun.
      std::unique_ptr<ContactStatics> loading;
      /// Its last load factor [-] and what friction has dissipated so far [J/m].
      double reached = 0., friction_work = 0.;

      void
      begin_anew();

      void
      load(const LoadSteps &steps);
    };
  } // namespace internal
} // namespace NMM

#endif
