#ifndef nmm_tests_performance_bench_timed_model_h
#define nmm_tests_performance_bench_timed_model_h

#include <nmm/dynamics/mechanical_model.h>

#include <deal.II/base/timer.h>

namespace NMM
{
  namespace Bench
  {
    /// A mechanical model as it is, with the times that its forces and what it does between
    /// steps take.
    class TimedModel : public MechanicalModel,
                       public SupportModel,
                       public SteppedModel,
                       public TangentModel
    {
    public:
      using Vector = MechanicalModel::Vector;
      using Matrix = MechanicalModel::Matrix;

      explicit TimedModel(MechanicalModel &model)
        : model(&model)
        , supports(&model_interface<SupportModel>(model))
        , stepped(&model_interface<SteppedModel>(model))
      {
        forces.reset();
        steps.reset();
      }

      /// Forces and tangents; begin and end of steps.
      dealii::Timer forces, steps;

      const ModelLayout &
      layout() const override
      {
        return model->layout();
      }

      const Matrix &
      mass() const override
      {
        return model->mass();
      }

      const Matrix &
      stiffness_at_rest() override
      {
        return model->stiffness_at_rest();
      }

      ForceProperties
      force_properties() const override
      {
        return model->force_properties();
      }

      Deformation
      assemble(const Vector &u,
               const double  t,
               const Tangent tangent,
               const Vector *increment) override
      {
        const Running running(forces);
        return model->assemble(u, t, tangent, increment);
      }

      Deformation
      assemble_between(const Vector &begin,
                       const Vector &end,
                       const double  t_0,
                       const double  t_1,
                       const Tangent tangent) override
      {
        const Running running(forces);
        return model->assemble_between(begin, end, t_0, t_1, tangent);
      }

      const Vector &
      residual() const override
      {
        return model->residual();
      }

      const Matrix &
      tangent() const override
      {
        return model->tangent();
      }

      unsigned int
      pattern_version() const override
      {
        return model_interface<TangentModel>(*model).pattern_version();
      }

      double
      force_scale() const override
      {
        return model->force_scale();
      }

      Energies
      energies() const override
      {
        return model->energies();
      }

      void
      external_forces(const Vector &u, const double t, Vector &result) override
      {
        model->external_forces(u, t, result);
      }

      double
      work_of_supports(const Vector &u,
                       const double  t,
                       const double  t_0,
                       const double  t_1) override
      {
        return supports->work_of_supports(u, t, t_0, t_1);
      }

      double
      work_of_supports_between(const Vector &begin,
                               const Vector &end,
                               const Vector &mean,
                               const double  t_0,
                               const double  t_1) override
      {
        return supports->work_of_supports_between(begin, end, mean, t_0, t_1);
      }

      void
      begin_step(const Vector &begin,
                 const Vector &predicted,
                 const double  t,
                 const double  h) override
      {
        const Running running(steps);
        stepped->begin_step(begin, predicted, t, h);
      }

      StepFault
      find_fault(const Vector &end) override
      {
        const Running running(steps);
        return stepped->find_fault(end);
      }

      double
      accept_step(const Vector &end, const double t) override
      {
        const Running running(steps);
        return stepped->accept_step(end, t);
      }

      std::vector<double>
      events() const override
      {
        return supports->events();
      }

      void
      pass_events(const double t) override
      {
        supports->pass_events(t);
      }

    private:
      /// The timer runs as long as this exists.
      struct Running
      {
        explicit Running(dealii::Timer &timer)
          : timer(timer)
        {
          timer.start();
        }

        ~Running()
        {
          timer.stop();
        }

        dealii::Timer &timer;
      };

      MechanicalModel *model;
      SupportModel    *supports;
      SteppedModel    *stepped;
    };
  } // namespace Bench
} // namespace NMM

#endif
