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
     * The loading of elastic blocks in contact, with small displacements, to load factors that are
     * not known beforehand. A load factor above the last one continues the loading. A smaller one
     * starts again from zero load, since friction depends on the history. It is reached in one
     * step, unless the scene has load steps of its own.
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

      /// The displacements at the load factor @p load_factor [m], with relevant unknowns, valid
      /// until the next call. The contact analysis has taken the state. @throws NumericalFailure
      /// if there is no equilibrium, naming the block that moves.
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
      /// The present loading; null if none has begun.
      std::unique_ptr<ContactStatics> loading;
      /// The last load factor [-], and the energy that friction has dissipated so far [J/m].
      double reached = 0., friction_work = 0.;

      void
      begin_anew();

      void
      load(const LoadSteps &steps);
    };
  } // namespace internal
} // namespace NMM

#endif
