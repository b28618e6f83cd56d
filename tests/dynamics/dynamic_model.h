#ifndef nmm_tests_dynamics_dynamic_model_h
#define nmm_tests_dynamics_dynamic_model_h

#include <nmm/dynamics/step_control.h>
#include <nmm/dynamics/time_integrator.h>
#include <nmm/mechanics/mass_matrix.h>
#include <nmm/mechanics/solid_term.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <mechanics/model.h>
#include <random>

namespace NMM
{
  namespace Test
  {
    using Vector = ForceTerm::Vector;

    /// A body in the making: change `model->problem`, then call a make function.
    struct Body
    {
      std::unique_ptr<Model>            model;
      std::unique_ptr<FiniteElasticity> elasticity;
      std::unique_ptr<SolidTerm>        solid;
      std::unique_ptr<MechanicalModel>  mechanics;

      void
      make_small(Loading loading = {})
      {
        make_elasticity();
        solid =
          std::make_unique<SmallSolid>(*elasticity, std::move(loading), mass());
        mechanics = std::make_unique<MechanicalModel>(
          solid->layout(), std::vector<ForceTerm *>{solid.get()});
      }

      void
      make_finite(Loading loading = {})
      {
        make_elasticity();
        solid     = std::make_unique<FiniteSolid>(*elasticity,
                                              std::move(loading),
                                              mass());
        mechanics = std::make_unique<MechanicalModel>(
          solid->layout(), std::vector<ForceTerm *>{solid.get()});
      }

      std::shared_ptr<const ForceTerm::Matrix>
      mass() const
      {
        return make_mass_matrix(*elasticity, *model->quadrature);
      }

      Vector
      velocity(
        const std::function<Tensor<1, 2>(const Point<2> &)> &function) const
      {
        return interpolate_velocity(model->covers,
                                    model->constraints,
                                    [&](const Point<2> &x, unsigned int) {
                                      return function(x);
                                    });
      }

      Vector
      zero() const
      {
        return Vector(mechanics->layout().locally_owned,
                      mechanics->layout().communicator);
      }

      /// Of owned unknowns.
      DisplacementField
      field(const Vector &owned) const
      {
        Vector relevant(mechanics->layout().locally_owned,
                        mechanics->layout().locally_relevant,
                        mechanics->layout().communicator);
        relevant = owned;
        return DisplacementField(model->covers, model->problem, relevant);
      }

      /// Current area, the integral of det F.
      double
      area(const Vector &u) const
      {
        const DisplacementField displacements = field(u);
        const ManifoldMesh     &mesh          = model->manifold_mesh;
        double                  area          = 0.;
        const auto [first, last] = model->covers.locally_owned_elements();
        for (unsigned int e = first; e < last; ++e)
        {
          const auto  &rule = model->quadrature->rule(e);
          const double cell =
            2. * model->mathematical_mesh.cell_area(mesh.cell(e));
          for (unsigned int q = 0; q < rule.size(); ++q)
            area +=
              cell * rule.weight(q) *
              dealii::determinant(dealii::unit_symmetric_tensor<2>() +
                                  displacements.gradient(e, rule.point(q)));
        }
        return dealii::Utilities::MPI::sum(area,
                                           mechanics->layout().communicator);
      }

    private:
      void
      make_elasticity()
      {
        elasticity = std::make_unique<FiniteElasticity>(model->covers,
                                                        *model->quadrature,
                                                        model->constraints,
                                                        model->problem,
                                                        /* may_float = */ true);
      }
    };


    /// A box of one material on a mesh that is offset and turned.
    inline Body
    box(const Point<2> &lower,
        const Point<2> &upper,
        const double    cell_size,
        const Material &rock,
        const MPI_Comm  communicator = MPI_COMM_WORLD)
    {
      Geometry geometry;
      add_box(geometry, lower, upper);
      Body         body;
      Tensor<1, 2> offset;
      offset[0] = 0.31 * cell_size;
      offset[1] = 0.17 * cell_size;
      body.model =
        std::make_unique<Model>(std::move(geometry),
                                mesh_parameters(cell_size, offset, 17.),
                                2,
                                Stabilization::aggregation,
                                communicator);
      body.model->problem.materials = {rock};
      return body;
    }


    inline void
    step(TimeIntegrator &integrator, const double h)
    {
      const StepReport report = integrator.try_step(h);
      AssertThrow(report.converged, dealii::ExcMessage(report.reason));
      integrator.accept();
    }


    /// A random displacement of the size @p size that satisfies the constraints; on one rank.
    inline Vector
    random_displacement(const ModelLayout &layout,
                        const double       size,
                        std::mt19937      &generator)
    {
      std::uniform_real_distribution<double> random(-size, size);
      Vector owned(layout.locally_owned, layout.communicator);
      for (const auto i : layout.locally_owned)
        owned(i) = random(generator);
      owned.compress(dealii::VectorOperation::insert);
      layout.constraints->distribute(owned);
      return owned;
    }


    /// Two masses on springs of their own, without constraints: what
    /// schemes do is known in closed form. On MPI_COMM_SELF.
    class Oscillators : private ForceTerm, public MechanicalModel
    {
    public:
      Oscillators(const double           k_0,
                  const double           k_1,
                  const double           m        = 1.,
                  const RayleighDamping &rayleigh = {})
        : MechanicalModel(unknowns, {this})
        , owned(2)
      {
        owned.add_range(0, 2);
        dealii::DynamicSparsityPattern pattern(2, 2);
        pattern.add(0, 0);
        pattern.add(1, 1);
        for (Matrix *matrix : {&mass_matrix, &stiffness, &damping})
          matrix->reinit(owned, owned, pattern, MPI_COMM_SELF);
        for (unsigned int i = 0; i < 2; ++i)
        {
          mass_matrix.set(i, i, m);
          stiffness.set(i, i, i == 0 ? k_0 : k_1);
        }
        for (Matrix *matrix : {&mass_matrix, &stiffness})
          matrix->compress(dealii::VectorOperation::insert);
        damping.add(rayleigh.mass, mass_matrix);
        damping.add(rayleigh.stiffness, stiffness);
        none.close();
        for (Vector *vector : {&positions, &forces, &displacements})
          vector->reinit(owned, MPI_COMM_SELF);
        unknowns = {MPI_COMM_SELF,
                    owned,
                    owned,
                    &none,
                    &positions,
                    &mass_matrix,
                    0,
                    {},
                    {}};
      }

    private:
      using Vector = ForceTerm::Vector;
      using Matrix = ForceTerm::Matrix;

      ForceProperties
      properties() const override
      {
        return {};
      }

      Deformation
      assemble(const Trial &trial, AssembledForces &sum) override
      {
        displacements = *trial.end;
        if (trial.is_conserving)
          displacements.sadd(0.5, 0.5, *trial.begin);
        stiffness.vmult(forces, displacements);
        sum.residual      = &forces;
        sum.tangent       = &stiffness;
        sum.damping       = {&damping};
        sum.scale         = 1.;
        sum.strain_energy = 0.5 * (displacements * forces);
        return Deformation::admissible;
      }

      StepWork
      commit(const Trial &step) override
      {
        Vector change(*step.end);
        change -= *step.begin;
        damping.vmult(forces, change);
        StepWork work;
        work.dissipated = forces * change / (step.end_time - step.begin_time);
        return work;
      }

      dealii::IndexSet                  owned;
      ModelLayout                       unknowns;
      Matrix                            mass_matrix, stiffness, damping;
      dealii::AffineConstraints<double> none;
      Vector                            positions, forces, displacements;
    };
  } // namespace Test
} // namespace NMM

#endif
