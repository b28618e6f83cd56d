#ifndef nmm_source_analysis_staged_loads_h
#define nmm_source_analysis_staged_loads_h

#include <nmm/mechanics/loading.h>

#include <optional>

namespace NMM
{
  namespace internal
  {
    /**
     * The loads of a solid at rest as functions of the load factor lambda. They are proportional to it until
     * the first stage begins, at lambda_b, and in a stage that ends at lambda_e
     * @f[ A(\lambda) = A_b + \frac{\lambda-\lambda_b}{\lambda_e-\lambda_b}\,(A_e-A_b). @f]
     */
    class StagedLoads
    {
    public:
      /// Loads are @p full at the load factor 1. The problem must outlive this object.
      StagedLoads(const ElasticityProblem &problem, const LoadAmplitudes &full)
        : problem(problem)
        , proportional(proportional_loading(problem, full))
      {
      }

      /// The loads at a load factor, which is not before the present stage.
      LoadAmplitudes
      at(double load_factor) const;

      /// Begin a stage at whose end loads are @p at_end; empty: they stay as they are.
      void
      begin_stage(double                               begin,
                  double                               end,
                  const std::optional<LoadAmplitudes> &at_end);

      /// Forget all stages.
      void
      begin_anew()
      {
        stage.reset();
      }

    private:
      struct Stage
      {
        double         begin, end;
        LoadAmplitudes at_begin, at_end;
      };

      const ElasticityProblem &problem;
      Loading                  proportional;
      /// Empty before the first one.
      std::optional<Stage> stage;
    };
  } // namespace internal
} // namespace NMM

#endif
