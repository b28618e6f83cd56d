#ifndef nmm_tests_performance_bench_timed_term_h
#define nmm_tests_performance_bench_timed_term_h

#include <nmm/mechanics/mechanical_model.h>

#include <deal.II/base/timer.h>

namespace NMM
{
  namespace Bench
  {
    /// A force term as it is, with the times that its forces and what it does between
    /// steps take. All blocks are always active.
    class TimedTerm : public ForceTerm
    {
    public:
      explicit TimedTerm(ForceTerm &term)
        : term(&term)
      {
        event_times = term.events();
        hash        = term.fingerprint();
        forces.reset();
        steps.reset();
      }

      /// Forces and tangents; begin and end of steps.
      dealii::Timer forces, steps;

      void
      begin_step(const StepBegin &step) override
      {
        const Running running(steps);
        term->begin_step(step);
      }

      Deformation
      assemble(const Trial &trial, AssembledForces &sum) override
      {
        const Running running(forces);
        return term->assemble(trial, sum);
      }

      ForceProperties
      properties() const override
      {
        return term->properties();
      }

      StepFault
      find_fault(const Vector &end) override
      {
        const Running running(steps);
        return term->find_fault(end);
      }

      StepWork
      commit(const Trial &step) override
      {
        const Running running(steps);
        return term->commit(step);
      }

      void
      set_presence(const Presence &presence) override
      {
        term->set_presence(presence);
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

      ForceTerm *term;
    };
  } // namespace Bench
} // namespace NMM

#endif
